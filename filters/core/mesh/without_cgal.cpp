// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What remains of this room's CGAL sources when the library is built without it.

#include <stdexcept>

#include "mesh/mesh_defects.h"
#include "mesh/polygon_file.h"
#include "mesh/repair.h"
#include "mesh/wall_thickness.h"

namespace palpate {

std::vector<MeshDefect> findSelfIntersections(const SurfaceMesh&, std::size_t) {
  return {};
}

WallRatio largestWallRatio(const SurfaceMesh&) {
  return {};
}

PolygonSoup readOffFile(const std::string&) {
  throw std::runtime_error("OFF files need CGAL, which this build of Palpate was made without");
}

PolygonSoup readPlyFile(const std::string&) {
  throw std::runtime_error("PLY files need CGAL, which this build of Palpate was made without");
}

RepairedSurface repairSurface(const Eigen::Matrix3Xd&, const Eigen::Matrix3Xi&,
                              const ProgressCallback&) {
  throw std::runtime_error("repair needs CGAL, which this build of Palpate was made without");
}

}  // namespace palpate
