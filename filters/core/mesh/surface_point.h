// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.h"

namespace palpate {

/// A place on the surface in surface coordinates.
struct SurfacePoint {
  int triangle;
  Eigen::Vector3d barycentric;  ///< none negative, sum 1
};

/// Where a point of the surface is in space.
inline Eigen::Vector3d placeOf(const SurfaceMesh& mesh, const SurfacePoint& point) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    place += point.barycentric[k] * mesh.points().col(mesh.triangles()(k, point.triangle));
  return place;
}

/// The point of the surface nearest to a place, by a search over all triangles. For many places
/// there is SurfaceLocator.
/// @throws std::invalid_argument if the place is not finite.
SurfacePoint nearestSurfacePoint(const SurfaceMesh& mesh, const Eigen::Vector3d& place);

}  // namespace palpate
