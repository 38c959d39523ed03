// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpate {

/// The connected components of a closed triangle surface and how they nest.
struct Shells {
  std::vector<int> ofVertex;  ///< #V, shell of each vertex
  /// #shells, signed: positive where the normals point outwards, 0 where it is within rounding.
  std::vector<double> volume;
  std::vector<int> parent;         ///< #shells, the smallest shell around this one, or -1
  std::vector<int> depth;          ///< #shells, how many shells are around this one
  std::vector<int> firstTriangle;  ///< #shells, lowest-numbered triangle
  int count() const { return static_cast<int>(volume.size()); }
};

/// @param points     3 by #V.
/// @param triangles  3 by #F, a consistently oriented manifold without unused vertices; of volumes
///                   and nesting only what is closed tells anything.
Shells findShells(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);

/// What they enclose all together, cavities taken off.
/// @param points, triangles  as findShells takes them.
double enclosedVolume(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);

/// Signed solid angle of triangle (a, b, c) seen from x (van Oosterom & Strackee 1983), in
/// (-2 pi, 2 pi]; positive where the triangle's normal points away from x.
double solidAngle(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c);

}  // namespace palpate
