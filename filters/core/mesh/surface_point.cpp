// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_point.h"

#include <stdexcept>

#include "mesh/triangle_queries.h"

namespace palpate {

SurfacePoint nearestSurfacePoint(const SurfaceMesh& mesh, const Eigen::Vector3d& place) {
  if (!place.allFinite()) throw std::invalid_argument("the point to touch is not a finite number");
  NearestPoint nearest(mesh, place);
  for (int f = 0; f < mesh.triangleCount(); ++f) nearest.visit(f);
  return nearest.point();
}

}  // namespace palpate
