// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What remains of this room's CGAL sources when the library is built without it.

#include <stdexcept>

#include "mesh/geodesic_distance.h"
#include "mesh/mesh_defects.h"
#include "mesh/polygon_file.h"
#include "mesh/remeshing.h"
#include "mesh/repair.h"
#include "mesh/tetrahedralization.h"
#include "mesh/triangle_tree.h"
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

RemeshedSurface remeshIsotropic(const Eigen::Matrix3Xd&, const Eigen::Matrix3Xi&,
                                const std::vector<unsigned char>&, const Eigen::VectorXi&, double,
                                int, const ProgressCallback&) {
  throw std::runtime_error("remeshing needs CGAL, which this build of Palpate was made without");
}

Tetrahedralization tetrahedralize(const SurfaceMesh&, double, const ProgressCallback&) {
  throw std::runtime_error(
      "cutting a surface's inside into tetrahedra needs CGAL, which this build of Palpate was made "
      "without: give a volume mesh");
}

struct GeodesicDistances::Shell {};

GeodesicDistances::GeodesicDistances(const SurfaceMesh& mesh) : mesh_(mesh) {
  throw std::runtime_error(
      "distances along the surface (geodesic masks) need CGAL, which this build of Palpate was "
      "made "
      "without");
}
GeodesicDistances::~GeodesicDistances() = default;
Eigen::VectorXd GeodesicDistances::from(int) const {
  return {};
}

struct TriangleTree::Boxes {
  template <class Query>
  void ask(Query& query) const {
    for (int f = 0; f < mesh->triangleCount(); ++f) query.visit(f);
  }
  std::shared_ptr<const SurfaceMesh> mesh;
};

TriangleTree::TriangleTree(std::shared_ptr<const SurfaceMesh> mesh)
    : boxes_(new Boxes{std::move(mesh)}) {}
TriangleTree::~TriangleTree() = default;
double TriangleTree::bytesPerTriangle() noexcept {
  return 0;
}

void TriangleTree::ask(NearestPoint& query) const noexcept {
  boxes_->ask(query);
}
void TriangleTree::ask(FirstCrossing& query) const noexcept {
  boxes_->ask(query);
}

}  // namespace palpate
