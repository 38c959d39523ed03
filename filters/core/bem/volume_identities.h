// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/body_surface.h"

namespace palpate::bem {

/// Betti's identity of a body with one auxiliary elastic state (w, t_w) that changes a volume,
///   sum over surface of  t_w . u - w . p = 0,
/// exact for every displacement u with traction p and for every Poisson's ratio.
///
/// Near nu = 1/2 the boundary integral equation loses the mean pressure on each shell: the
/// combination sum of a_i n_i . (equation at x_i) fades with 1 - 2 nu, below its own discretisation
/// error. Each shell's identity replaces that combination:
///   outer shell:  w = x - c (dilatation):  integral of n.u = (1 - 2 nu)/E integral of (x - c).p;
///   cavity:       w = grad(1/r) of a centre of dilatation inside the cavity, which is an elastic
///                 state of the material outside it, whatever nu.
struct VolumeIdentity {
  /// 3 by #v, factor of each vertex's displacement, including the scale `1 / rowNorm`.
  Eigen::Matrix3Xd displacement;
  /// 3 by #traction nodes, factor of each node's traction (it enters with a minus sign).
  Eigen::Matrix3Xd traction;
  /// #points by 3: unit weight vector over the scheme's collocation equations, which the identity
  /// replaces.
  Eigen::MatrixX3d weights;
};

/// One identity for each shell of the body. The weights of different shells are orthogonal.
std::vector<VolumeIdentity> volumeIdentities(const BodySurface& body,
                                             const CollocationScheme& scheme);

}  // namespace palpate::bem
