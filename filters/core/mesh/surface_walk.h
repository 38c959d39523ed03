// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "mesh/surface_point.h"

namespace palpate {

/// Walks straight on over a surface from face to face: at an edge the way turns with the surface
/// about the edge, as it would unfolded. At a rim it goes on along the rim with the part of the way
/// that points along it, and ends where both sides of a corner lead out. What every step costs is
/// bounded, whatever the triangles' shapes; a walk stays on the surface and in one of its shells,
/// and allocates nothing.
class SurfaceWalk {
 public:
  explicit SurfaceWalk(std::shared_ptr<const SurfaceMesh> mesh);

  const SurfaceMesh& mesh() const { return *mesh_; }

  /// A walk under way.
  struct Walker {
    SurfacePoint point;
    Eigen::Vector3d ahead;    ///< what is left of the way, in the plane of the point's triangle
    int enteredOver = -1;     ///< the corner opposite to the edge just crossed, or the rim met
    bool isCornered = false;  ///< met a rim that leads out over a corner, and has not moved since

    bool hasArrived() const { return ahead == Eigen::Vector3d::Zero(); }
  };

  /// @param way  turned into the plane of the point's triangle, its length kept; nothing is left of
  ///             it where it stands upright on the triangle or is not finite.
  Walker start(const SurfacePoint& point, const Eigen::Vector3d& way) const noexcept;

  /// Walks to the end of the way or to the next edge, and crosses that unless it is a rim.
  /// @return  the barycentric coordinates, in the triangle that it started in, of where it ends.
  Eigen::Vector3d step(Walker& walker) const noexcept;

  /// Walks until it has arrived or has taken as many steps as it may.
  Walker walk(const SurfacePoint& point, const Eigen::Vector3d& way, int mostSteps) const noexcept;

  /// The triangle beyond the edge opposite to a corner (0, 1, 2), -1 beyond a rim.
  int neighbour(int triangle, int corner) const { return across_[3 * triangle + corner].triangle; }

 private:
  struct Side {
    int triangle = -1, corner = -1;  ///< beyond the edge, and which of its corners is opposite
  };
  void meetRim(Walker& walker, int exit, const Eigen::Vector3d& end, double fraction,
               bool hasMoved) const noexcept;

  std::shared_ptr<const SurfaceMesh> mesh_;
  std::vector<Side> across_;  ///< of the edge opposite to each corner, 3 #F
};

}  // namespace palpate
