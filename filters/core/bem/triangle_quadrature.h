// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "bem/panel_integration.h"

namespace palpate::bem {

/// A symmetric rule for the mean of a function over a triangle.
struct TriangleRule {
  int degree;                    ///< of the polynomials that it integrates exactly
  Eigen::Matrix3Xd barycentric;  ///< 3 by #points
  Eigen::VectorXd weights;       ///< #points, their sum is 1
};

/// Rules with 3 (degree 2), 7 (degree 5) and 16 points (degree 8), from D. A. Dunavant, "High
/// degree efficient symmetrical Gaussian quadrature rules for the triangle", IJNME 21 (1985); the
/// first two are classical and known in closed form.
/// @throws std::invalid_argument for another number of points.
TriangleRule triangleRule(int pointCount);

/// The rules of seven and of three points, each with the distance from which it may be used so that
/// a whole boundary integral equation is met to `tolerance` of the field's size; nearer triangles
/// are integrated in closed form.
/// @param tolerance  relative; below 1e-13 it counts as 1e-13.
void choosePanelRules(double tolerance, PanelRule& nearRule, PanelRule& farRule);

}  // namespace palpate::bem
