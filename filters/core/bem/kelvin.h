// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate::bem {

/// Kelvin's solution: the displacement at distance r from a unit point force in infinite space,
///   U_ij = [(3 - 4 nu) delta_ij + r,i r,j] / (16 pi G (1 - nu) r),   load i, response j
/// (Thomson 1848; the kernel of [JP01] eq. 8).
/// @param r             response point minus load point, metres, not zero.
/// @param shearModulus  G, Pa.
/// @return metres per newton.
inline Eigen::Matrix3d kelvinDisplacement(const Eigen::Vector3d& r, double shearModulus,
                                          double poissonRatio) {
  const double distance = r.norm();
  const Eigen::Vector3d e = r / distance;
  return ((3 - 4 * poissonRatio) * Eigen::Matrix3d::Identity() + e * e.transpose()) /
         (16 * 3.14159265358979323846 * shearModulus * (1 - poissonRatio) * distance);
}

/// The traction of that solution on a plane through the response point,
///   T_ij = -{dr/dn [(1 - 2 nu) delta_ij + 3 r,i r,j] - (1 - 2 nu)(r,i n_j - r,j n_i)}
///          / (8 pi (1 - nu) r^2),   load i, response j.
/// @param normal  unit normal at the response point.
/// @return 1/m^2.
inline Eigen::Matrix3d kelvinTraction(const Eigen::Vector3d& r, const Eigen::Vector3d& normal,
                                      double poissonRatio) {
  const double distance = r.norm(), c = 1 - 2 * poissonRatio;
  const Eigen::Vector3d e = r / distance;
  const Eigen::Matrix3d symmetric =
      e.dot(normal) * (c * Eigen::Matrix3d::Identity() + 3 * e * e.transpose());
  const Eigen::Matrix3d skew = c * (e * normal.transpose() - normal * e.transpose());
  return -(symmetric - skew) /
         (8 * 3.14159265358979323846 * (1 - poissonRatio) * distance * distance);
}

}  // namespace palpate::bem
