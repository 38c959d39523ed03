// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/wall_thickness.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include <algorithm>
#include <vector>

#include "mesh/cgal_surface.h"
#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalSurface>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, Primitive>>;

double longestEdge(const SurfaceMesh& mesh, int f) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (mesh.points().col(mesh.triangles()(k, f)) -
                                 mesh.points().col(mesh.triangles()((k + 1) % 3, f)))
                                    .norm());
  return longest;
}

/// Distance from a triangle's centroid inwards to the first triangle that faces the other way.
double thicknessBelow(const SurfaceMesh& mesh, const Tree& tree, int f) {
  constexpr double facesAway = -0.5;
  const Eigen::Vector3d normal = mesh.triangleNormals().col(f);
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) centroid += mesh.points().col(mesh.triangles()(k, f)) / 3;
  const CgalKernel::Ray_3 ray(toCgal(centroid),
                              CgalKernel::Vector_3(-normal.x(), -normal.y(), -normal.z()));
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<Tree::Primitive_id> hits;
  tree.all_intersected_primitives(ray, std::back_inserter(hits));
  for (const Tree::Primitive_id& hit : hits) {
    const int other = static_cast<int>(hit.idx());
    const Eigen::Vector3d otherNormal = mesh.triangleNormals().col(other);
    if (other == f || normal.dot(otherNormal) > facesAway) continue;
    const Eigen::Vector3d corner = mesh.points().col(mesh.triangles()(0, other));
    nearest = std::min(nearest, (corner - centroid).dot(otherNormal) / -normal.dot(otherNormal));
  }
  return nearest;
}

}  // namespace

WallRatio largestWallRatio(const SurfaceMesh& mesh) {
  const CgalSurface surface = toCgal(mesh.points(), mesh.triangles());
  const Tree tree(faces(surface).first, faces(surface).second, surface);
  WallRatio largest{0, -1};
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const double ratio = longestEdge(mesh, f) / thicknessBelow(mesh, tree, f);
    if (ratio > largest.ratio) largest = {ratio, f};
  }
  return largest;
}

}  // namespace palpate
