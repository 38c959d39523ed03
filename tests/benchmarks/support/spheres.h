// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "greens/greens_functions.h"
#include "model/elastic_model.h"

namespace palpate::bench {

/// A unit sphere with its lowest tenth fixed.
/// @param vertices  12, 42, 162, 642, 2562: an icosahedron refined; else about as many, in rings.
ElasticModel sphereModel(int vertices);

/// Its Green's functions in double, computed once.
std::shared_ptr<const GreensFunctions> sphereGreens(int vertices);

/// The same number of random numbers in the shape of Green's functions: what consumers' speed
/// depends on, at no cost.
/// @param nodes  all free, all columns stored.
template <class Scalar>
std::shared_ptr<const GreensFunctions> randomGreens(int nodes);

/// `count` free nodes without repetition, in a fixed random order.
std::vector<int> scatteredFreeNodes(const GreensFunctions& greens, int count);

}  // namespace palpate::bench
