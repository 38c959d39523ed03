// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate::shell {

using Matrix18d = Eigen::Matrix<double, 18, 18>;

/// Stiffness of a flat triangle of a thin shell: its membrane (membraneStiffness, OPT) and its
/// bending (plateStiffness, DKT) side by side, turned into space. Six degrees of freedom a corner,
/// displacement and then rotation, both along x, y, z; the rotation about the normal is the
/// membrane's drilling rotation, so that no stiffness need be made up for it. Exactly the six rigid
/// motions have no energy.
///
/// The thickness t is linear between the corners: the membrane has its mean, bending that of t^3.
/// @param corners    3 by 3, a column a corner; area above zero.
/// @param thickness  at the corners, in the unit of length.
/// @param nu         Poisson's ratio.
/// @return symmetric, per Young's modulus: in units of length between displacements.
Matrix18d shellStiffness(const Eigen::Matrix3d& corners, const Eigen::Vector3d& thickness,
                         double nu);

/// Plane stress, 1 / (1 - nu^2) (xx + nu yy, ..., (1 - nu) / 2 xy), of (xx, yy, 2 xy), per E.
Eigen::Matrix3d planeStress(double nu);

}  // namespace palpate::shell
