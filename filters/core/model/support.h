// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate {

class BoundaryConditions;
class SurfaceMesh;

/// The rigid motion that a body's scalar displacement constraints resist least.
struct RigidMotion {
  double resistance;  ///< smallest singular value of the constraint rows over the motions, scaled
                      ///< to lengths of the body; below kSmallestResistance the motion is free
  Eigen::Vector3d translation, rotation;  ///< unit vector of the six, about the constraints' middle

  /// "translation along (x, y, z)" or "rotation about the axis (x, y, z)".
  std::string describe() const;
};

constexpr double kSmallestResistance = 1e-6;

/// Displacements of points that move rigidly: three unit translations along the axes, then turns
/// about them through a middle, by an angle of one over a length.
/// @param points  3 by any, m.
/// @param length  m; what is returned has no unit.
/// @return 3 #points by 6.
Eigen::MatrixXd rigidMotions(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& middle,
                             double length);

/// @param points      3 by #constraints, where displacements are prescribed.
/// @param directions  3 by #constraints, unit vectors along which they are.
/// @param bodySize    a length that scales rotations, such as the body's bounding-box diagonal.
/// @param axes        3 by any, unit vectors about which rotations are prescribed somewhere.
RigidMotion leastResistedMotion(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& directions,
                                double bodySize, const Eigen::Matrix3Xd& axes = {});

/// @param nodes  fixed nodes, all three directions of each.
/// @throws std::invalid_argument naming the body and the motion if the nodes leave a rigid
///         motion of any body free.
void requireSupport(const SurfaceMesh& mesh, const BoundaryConditions& conditions);

/// Width of the widest connected set of fixed nodes, over the mean edge length within it: its
/// extent along its second principal axis. Supports narrower than about 3 are too small for the
/// mesh.
/// @return the smallest over the bodies that have fixed nodes; infinity if none has.
double supportWidthInEdges(const SurfaceMesh& mesh, const BoundaryConditions& conditions);

/// Splits smooth patches at the rim of the support, the triangles with three fixed corners, so that
/// its traction ends there and not half an edge beyond.
/// @param smoothPatches  #F.
/// @return #F patch numbers, counted from 0.
Eigen::VectorXi splitAtSupport(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               const Eigen::VectorXi& smoothPatches);

}  // namespace palpate
