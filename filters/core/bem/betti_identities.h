// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/collocation_scheme.h"

namespace palpate::bem {

/// Betti's identity of a body with one auxiliary elastic state (w, t_w),
///   integral over the surface of  t_w . u - w . p = 0,
/// exact for every displacement u with its traction p, and the combination of the system's
/// equations that it replaces because the discrete equations lose just this piece of information.
///
/// *Volume.* Near nu = 1/2 the boundary integral equation loses the mean pressure on each shell:
/// the combination sum of a_i n_i . (equation i) fades with 1 - 2 nu, below its own discretisation
/// error.
///   outer shell:  w = x - c (dilatation):  integral of n.u = (1 - 2 nu)/E integral of (x - c).p;
///   cavity:       w = grad(1/r) of a centre of dilatation inside the cavity, which is an elastic
///                 state of the material outside it, whatever nu.
/// *Equilibrium.* H has the six rigid motions on its right null space, so six combinations of the
/// equations hold tractions alone, and hold them in equilibrium only up to the discretisation
/// error, which a slender body magnifies:  w = rigid motion, t_w = 0:  integral of w.p = 0.
struct BettiIdentity {
  Eigen::Matrix3Xd displacement;  ///< 3 by #v, factor of each vertex's displacement
  Eigen::Matrix3Xd traction;  ///< 3 by #traction nodes, factor of each traction, with minus sign
  Eigen::MatrixX3d weights;   ///< #equations by 3, the combination of equations it replaces
};

/// One volume identity for each shell, and in averaged collocation of an interior domain the six of
/// equilibrium. Their weights are orthonormal.
std::vector<BettiIdentity> bettiIdentities(const BodySurface& body,
                                           const CollocationScheme& scheme);

}  // namespace palpate::bem
