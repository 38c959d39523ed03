// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "contact/rigid_shape.h"
#include "mesh/surface_locator.h"

namespace palpate {

/// A body bounded by triangles. The sign of the distance follows from the angle-weighted normal at
/// the nearest point (J. A. Baerentzen and H. Aanaes, "Signed distance computation using the angle
/// weighted pseudonormal", IEEE Trans. Vis. Comput. Graph. 11 (2005)).
class MeshShape final : public RigidShape {
 public:
  explicit MeshShape(std::shared_ptr<const SurfaceMesh> mesh);

  Proximity proximity(const Eigen::Vector3d& place) const noexcept override;
  /// By descent along the distance's gradient on the triangle, to a thousandth of its size: the
  /// deepest point near where the distance is least of the corners and the middle (M. Macklin et
  /// al., "Local Optimization for Robust Signed Distance Field Collision", PACMCGIT 3 (2020)).
  Eigen::Vector3d deepest(const Eigen::Matrix3d& corners) const noexcept override;
  double reach() const noexcept override { return reach_; }
  /// 0 if normals on both sides of a convex edge differ by more than 30 degrees; else the least of
  /// the radii by which they turn between the triangles' centres.
  double smallestRadius() const noexcept override { return smallestRadius_; }
  /// Some of many vertices.
  int coreCount() const noexcept override { return std::min(kMostCorePoints, vertexCount()); }
  Eigen::Vector3d core(int k) const noexcept override {
    return locator_.mesh().points().col(std::int64_t(k) * vertexCount() / coreCount());
  }
  bool isFaceted() const noexcept override { return true; }
  /// Interpolated between the corners' normals, angle-weighted over a smooth patch each; on the
  /// patch's rim the proximity's own.
  Eigen::Vector3d smoothNormal(const Proximity& near) const noexcept override;

 private:
  static constexpr int kMostCorePoints = 500;
  int vertexCount() const noexcept { return locator_.mesh().vertexCount(); }
  Eigen::Vector3d pseudonormal(const SurfacePoint& point) const noexcept;

  SurfaceLocator locator_;
  Eigen::Matrix3Xd vertexNormals_;  ///< angle-weighted, #V
  Eigen::Matrix3Xd edgeNormals_;    ///< 3 #F: of the edge opposite to each corner
  Eigen::Matrix3Xd cornerNormals_;  ///< 3 #F: of a patch at its corner
  std::vector<char> isSharp_;       ///< 3 #F: whether another patch lies beyond that edge
  double reach_, smallestRadius_;
};

}  // namespace palpate
