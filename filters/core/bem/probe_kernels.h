// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <Eigen/Core>

#include "bem/kelvin.h"

namespace palpate::bem {

/// Displacement (3), its gradient (9: du_i/dx_k at 3 i + k) and mean stress (1) at a point, by
/// components of a vector.
using ProbeBlock = Eigen::Matrix<double, 13, 3>;

/// What a traction and a displacement of a piece of surface contribute at a point inside
/// (Somigliana 1886: u = integral of U t - T u), and to its derivatives there.
struct ProbeKernels {
  ProbeBlock ofTraction, ofDisplacement;
};

/// Kelvin's solution and its derivatives with respect to the point, with s = r . n and c = 1 - 2 nu
///   dU_ij/dr_k = A {[delta_ik r_j + delta_jk r_i - (3 - 4 nu) delta_ij r_k] / r^3
///                   - 3 r_i r_j r_k / r^5},                        A = 1 / (16 pi G (1 - nu)),
///   dT_ij/dr_k = -B {c delta_ij (n_k / r^3 - 3 s r_k / r^5)
///                    + 3 [n_k r_i r_j + s (delta_ik r_j + delta_jk r_i)] / r^5
///                    - 15 s r_i r_j r_k / r^7
///                    - c [(delta_ik n_j - delta_jk n_i) / r^3
///                         - 3 (r_i n_j - r_j n_i) r_k / r^5]},     B = 1 / (8 pi (1 - nu)).
/// The mean stress is E / (3 c) times the divergence, whose kernels have c as a factor: it cancels,
/// so that nothing is lost up to nu = 0.5.
/// @param r             surface point minus point, m, not zero.
/// @param normal        out of the material, unit.
/// @param shearModulus  G, Pa.
inline ProbeKernels probeKernels(const Eigen::Vector3d& r, const Eigen::Vector3d& normal,
                                 double shearModulus, double poissonRatio) {
  constexpr double pi = 3.14159265358979323846;
  const double a = 1 / (16 * pi * shearModulus * (1 - poissonRatio));
  const double b = 1 / (8 * pi * (1 - poissonRatio));
  const double c = 1 - 2 * poissonRatio, s = r.dot(normal);
  const double r2 = r.squaredNorm(), r3 = r2 * std::sqrt(r2), r5 = r3 * r2, r7 = r5 * r2;
  ProbeKernels kernels;
  kernels.ofTraction.topRows<3>() = kelvinDisplacement(r, shearModulus, poissonRatio);
  kernels.ofDisplacement.topRows<3>() = -kelvinTraction(r, normal, poissonRatio);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const double ij = i == j, ik = i == k, jk = j == k;
        const double pair = ik * r[j] + jk * r[i], all = r[i] * r[j] * r[k];
        const double skew = r[i] * normal[j] - r[j] * normal[i];
        const double dU = a * ((pair - (3 - 4 * poissonRatio) * ij * r[k]) / r3 - 3 * all / r5);
        const double dT =
            -b * (c * ij * (normal[k] / r3 - 3 * s * r[k] / r5) +
                  3 * (normal[k] * r[i] * r[j] + s * pair) / r5 - 15 * s * all / r7 -
                  c * ((ik * normal[j] - jk * normal[i]) / r3 - 3 * skew * r[k] / r5));
        kernels.ofTraction(3 + 3 * i + k, j) = -dU;
        kernels.ofDisplacement(3 + 3 * i + k, j) = dT;
      }
  const double young = 2 * shearModulus * (1 + poissonRatio);
  kernels.ofTraction.row(12) = 2 * a * young / 3 * r.transpose() / r3;
  kernels.ofDisplacement.row(12) = -2 * b * young / 3 * (normal / r3 - 3 * s * r / r5).transpose();
  return kernels;
}

}  // namespace palpate::bem
