// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// A body cut into tetrahedra that share whole faces, edges and corners.
class TetrahedralMesh {
 public:
  /// @param points      3 by #N, m; each belongs to a tetrahedron.
  /// @param tetrahedra  4 by #T, indices of points; turned inside out where their volume is
  ///                    negative.
  /// @throws std::invalid_argument naming the first tetrahedron or point that is out of range, not
  ///         finite, unused, twice there, or flat: of a volume below 1e-12 of its longest edge
  ///         cubed; or the first of which a face is shared by more than two, or by two on
  ///         the same side of it.
  TetrahedralMesh(Eigen::Matrix3Xd points, Eigen::Matrix4Xi tetrahedra);

  int pointCount() const { return static_cast<int>(points_.cols()); }
  int cellCount() const { return static_cast<int>(tetrahedra_.cols()); }
  const Eigen::Matrix3Xd& points() const { return points_; }
  /// Faces seen from outside are (1, 2, 3), (0, 3, 2), (0, 1, 3) and (0, 2, 1) of a column.
  const Eigen::Matrix4Xi& tetrahedra() const { return tetrahedra_; }
  /// #T, m^3.
  const Eigen::VectorXd& volumes() const { return volumes_; }
  /// 3 by #F: the faces that belong to one tetrahedron alone, counter-clockwise seen from outside.
  const Eigen::Matrix3Xi& boundary() const { return boundary_; }
  /// Of all angles between two faces of a tetrahedron the smallest, degrees.
  double smallestDihedralAngle() const;

 private:
  void findBoundary();

  Eigen::Matrix3Xd points_;
  Eigen::Matrix4Xi tetrahedra_;
  Eigen::VectorXd volumes_;
  Eigen::Matrix3Xi boundary_;
};

}  // namespace palpate
