// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

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
  double reach() const noexcept override { return reach_; }

 private:
  Eigen::Vector3d pseudonormal(const SurfacePoint& point) const noexcept;

  SurfaceLocator locator_;
  Eigen::Matrix3Xd vertexNormals_;  ///< angle-weighted, #V
  Eigen::Matrix3Xd edgeNormals_;    ///< 3 #F: of the edge opposite to each corner
  double reach_;
};

}  // namespace palpate
