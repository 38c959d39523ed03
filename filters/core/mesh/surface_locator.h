// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <optional>

#include "mesh/surface_point.h"
#include "mesh/triangle_tree.h"

namespace palpate {

/// Finds places on a surface by a tree of boxes that is built once. Queries neither allocate nor
/// lock, and are safe from several threads.
class SurfaceLocator {
 public:
  explicit SurfaceLocator(std::shared_ptr<const SurfaceMesh> mesh);

  const SurfaceMesh& mesh() const { return *mesh_; }

  /// The point nearest to a place.
  /// @param place  finite, in the mesh's frame and unit.
  SurfacePoint nearest(const Eigen::Vector3d& place) const noexcept;

  /// Where a segment first goes into the material, if it does, however long it is and however much
  /// of the body it passes. A crossing within 1e-12 of the body's diagonal of an end counts.
  /// @param from, to  finite.
  std::optional<SurfacePoint> firstEntry(const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& to) const noexcept;

  /// Whether a place is within the material; in a cavity it is not.
  bool isInside(const Eigen::Vector3d& place) const noexcept;

 private:
  std::shared_ptr<const SurfaceMesh> mesh_;
  TriangleTree tree_;
};

}  // namespace palpate
