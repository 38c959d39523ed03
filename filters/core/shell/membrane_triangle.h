// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate::shell {

using Corners2d = Eigen::Matrix<double, 2, 3>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// Stiffness of a triangle against being stretched and sheared in its plane, with a drilling
/// rotation at each corner: OPT, the optimal member of the family of triangles that pass the patch
/// test (C. A. Felippa, "A study of optimal membrane triangles with drilling freedoms", Comput.
/// Methods Appl. Mech. Engrg. 192, 2003):
///     K = L E L^T / (A h) + 3/4 beta_0 T^T K_theta T,
/// with L of eq. 22 and T of eq. 16, and K_theta of the natural strains of eqs. 12 and 29 with the
/// numbers of eq. 42. The first part is exact for constant strain; the second answers to the
/// rotations' deviation from the one that goes with it, and makes the energy of in-plane bending of
/// a rectangle of two triangles that of a beam, at any aspect ratio.
/// @param corners      counter-clockwise, m.
/// @param plane        E, plane stress: of (xx, yy, 2 xy), Pa, times the thickness, N/m.
/// @param higherOrder  beta_0 > 0, optimalHigherOrder for the paper's triangle.
/// @return of (u_x, u_y, theta_z) of corner 0, then 1, then 2; symmetric, of rank six.
Matrix9d membraneStiffness(const Corners2d& corners, const Eigen::Matrix3d& plane,
                           double higherOrder);

/// The least beta_0, which keeps the rank at nu = 0.5 and -0.5, where the formula gives none.
constexpr double kLeastHigherOrder = 0.01;

/// (1 - 4 nu^2) / 2, eq. 42, or the least.
double optimalHigherOrder(double nu);

}  // namespace palpate::shell
