// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// What Coulomb's law asks of a contact point under the force f = K u, with f_n = -n . f pressing
/// it into the surface and f_t across.
enum class Friction {
  Sticks,  ///< |f_t| <= mu f_n
  Slips,   ///< it moves until |f_t| = mu f_n
  LetsGo,  ///< no place on the tangent plane bears a force: the probe is above the plane
};

struct CoulombSlip {
  Friction friction;
  Eigen::Vector3d displacement;  ///< d of the contact point, in the tangent plane; m
  double excess;                 ///< (|f_t| - mu f_n) / |f| before it; negative within the cone
};

/// The return mapping of a point that slides on its tangent plane: the displacement d after which
/// the force f(d) = K (u - d) is on the friction cone and across along the slip, f_t(d) = s d with
/// s >= 0 (maximum dissipation): d = (K_tt + s)^-1 f_t, where s > 0 solves s |d| = mu f_n(d). There
/// is one if the probe is below the tangent plane; without friction s = 0. Neither allocates nor
/// throws.
///
/// @param stiffness  K, N/m, symmetric positive definite.
/// @param normal     n, unit, out of the material.
/// @param stretch    u = x^H - x^C, m.
/// @param mu         >= 0.
CoulombSlip coulombSlip(const Eigen::Matrix3d& stiffness, const Eigen::Vector3d& normal,
                        const Eigen::Vector3d& stretch, double mu) noexcept;

}  // namespace palpate
