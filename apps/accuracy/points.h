// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "accuracy/body_levels.h"
#include "accuracy/query.h"

namespace palpate::app {

/// Free vertices of the first level far from the support and from each other, whose masks no rim
/// cuts off, as points of the finest level.
/// @throws std::invalid_argument where there is none.
std::vector<SurfacePoint> spreadPoints(const BodyLevels& body, double radius);

/// The points of the finest level that are nearest to places.
/// @param places  x y z of each.
/// @throws std::invalid_argument for a place that is off the surface as it is and off its finest
///         level, by more than a quarter of the former's edges.
std::vector<SurfacePoint> pointsAt(const BodyLevels& body, const std::vector<double>& places);

/// The widest radius of masks at all of these points that no rim cuts off, m.
double widestWholeMask(const BodyLevels& body, const std::vector<LevelledPoint>& points);

}  // namespace palpate::app
