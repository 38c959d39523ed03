// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_map.h"

#include <algorithm>

#include "mesh/surface_locator.h"
#include "sentence.h"

namespace palpate {
namespace {

/// Among the triangles that face a way, in any order; the nearest of all if none does.
SurfacePoint nearestFacing(const SurfaceMesh& mesh, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& normal, const SurfacePoint& otherwise) {
  NearestPoint query(mesh, place);
  bool isAny = false;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (mesh.triangleNormals().col(f).dot(normal) > 0) {
      query.visit(f);
      isAny = true;
    }
  return isAny ? query.point() : otherwise;
}

}  // namespace

SurfaceMap mapOnto(const std::shared_ptr<const SurfaceMesh>& mesh, const Eigen::Matrix3Xd& points,
                   const Eigen::Matrix3Xd& normals) {
  if (points.cols() != normals.cols())
    refuse("there are ", points.cols(), " points and normals of ", normals.cols());
  const SurfaceLocator locator(mesh);
  SurfaceMap map;
  map.places.reserve(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d place = points.col(i), normal = normals.col(i);
    SurfacePoint nearest = locator.nearest(place);
    if (mesh->triangleNormals().col(nearest.triangle).dot(normal) < 0)
      nearest = nearestFacing(*mesh, place, normal, nearest);
    map.largestDistance = std::max(map.largestDistance, (placeOf(*mesh, nearest) - place).norm());
    map.places.push_back(nearest);
  }
  return map;
}

}  // namespace palpate
