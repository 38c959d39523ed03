// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "shell/membrane_triangle.h"

namespace palpate::shell {

/// Stiffness of a triangle against being bent out of its plane: DKT, the discrete Kirchhoff
/// triangle (J.-L. Batoz, K.-J. Bathe, L.-W. Ho, "A study of three-node triangular plate bending
/// elements", Int. J. Numer. Methods Engrg. 15, 1980), section 3. Rotations of the normal are
/// quadratic, and it stays normal to the middle plane at corners and, along the sides, at their
/// middles, where the deflection is cubic along the side:
///     K = integral of B^T D B,   B the curvatures (w_xx, w_yy, 2 w_xy) of those rotations.
/// There is no shear to lock in, however thin the plate. Constant curvature is exact.
/// @param corners  counter-clockwise, m.
/// @param bending  D of (xx, yy, 2 xy), N m: E t^3 / 12 of plane stress.
/// @return of (w, theta_x, theta_y) of corner 0, then 1, then 2, with theta_x = w_y and
///         theta_y = -w_x; symmetric, of rank six.
Matrix9d plateStiffness(const Corners2d& corners, const Eigen::Matrix3d& bending);

}  // namespace palpate::shell
