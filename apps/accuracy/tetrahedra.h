// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "fem/solid_body.h"
#include "fem/solid_elements.h"
#include "greens/computed_greens_functions.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate::app {

/// Whether this program was built with what factors sparse matrices.
bool canUseTetrahedra();

/// Green's functions of a model by finite elements, in terms of the model's own vertex areas even
/// where its filling has other triangles: force compliances are those of the filling.
/// @throws as tetrahedralize and computeFiniteElementGreensFunctions; std::runtime_error if the
///         filling has vertices of its own on the surface.
ComputedGreensFunctions greensByTetrahedra(const ElasticModel& model, SolidElement element,
                                           bool reciprocal, const std::vector<int>& columns,
                                           const ProgressCallback& progress);

/// Of a body whose tetrahedra are given.
ComputedGreensFunctions greensOfFilling(const ElasticModel& model, const SolidBody& body,
                                        SolidElement element, bool reciprocal,
                                        const std::vector<int>& columns,
                                        const ProgressCallback& progress);

}  // namespace palpate::app
