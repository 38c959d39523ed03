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
/// Where triangles are chords of a curved surface, inclined to each other by phi, the rotation of
/// one in its plane is in part the bending of the next, and the membrane's beta_0, stiff as t
/// against bending's t^3, resists it: it locks. There beta_0 is at most (t / (h phi))^2 / 10, h^2
/// being twice the area. This is no part of either paper; a hemisphere of R / t = 250 yields 0.95
/// and 0.99 in place of 0.50 and 0.93 of what it should on 8^2 and 16^2 squares, and flat surfaces
/// are as they were.
/// @param corners      3 by 3, a column a corner; area above zero.
/// @param thickness    at the corners, in the unit of length.
/// @param nu           Poisson's ratio.
/// @param inclination  phi, radians (inclinations).
/// @return symmetric, per Young's modulus: in units of length between displacements.
Matrix18d shellStiffness(const Eigen::Matrix3d& corners, const Eigen::Vector3d& thickness,
                         double nu, double inclination);

/// Plane stress, 1 / (1 - nu^2) (xx + nu yy, ..., (1 - nu) / 2 xy), of (xx, yy, 2 xy), per E.
Eigen::Matrix3d planeStress(double nu);

}  // namespace palpate::shell
