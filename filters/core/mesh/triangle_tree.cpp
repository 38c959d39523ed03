// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/triangle_tree.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include "mesh/cgal_surface.h"

namespace palpate {
namespace {

using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalSurface>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, Primitive>>;

double reach(const NearestPoint& query, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return query.distance(low, high);
}
double reach(const FirstCrossing& query, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return query.entrance(low, high);
}

struct NoQuery {};

/// Takes a query down the tree, nearer boxes first (the traversal traits of CGAL's tree). CGAL's
/// own queries would look their first guess up in a second tree and compute in intervals.
template <class Query>
struct Descent {
  using Priority = double;
  Query& query;

  bool go_further() const { return true; }
  void intersection(NoQuery, const Primitive& primitive) {
    query.visit(static_cast<int>(primitive.id().idx()));
  }
  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(NoQuery, const Node& node) const {
    const CGAL::Bbox_3& box = node.bbox();
    const double nearest =
        reach(query, {box.xmin(), box.ymin(), box.zmin()}, {box.xmax(), box.ymax(), box.zmax()});
    return {nearest < query.bound(), -nearest};
  }
  template <class Node>
  bool do_intersect(NoQuery none, const Node& node) const {
    return do_intersect_with_priority(none, node).first;
  }
};

}  // namespace

struct TriangleTree::Boxes {
  explicit Boxes(const SurfaceMesh& mesh)
      : surface(toCgal(mesh.points(), mesh.triangles())),
        tree(faces(surface).first, faces(surface).second, surface) {
    tree.build();
  }
  template <class Query>
  void ask(Query& query) const {
    Descent<Query> descent{query};
    tree.traversal_with_priority(NoQuery(), descent);
  }
  CgalSurface surface;
  Tree tree;
};

TriangleTree::TriangleTree(std::shared_ptr<const SurfaceMesh> mesh)
    : boxes_(std::make_unique<Boxes>(*mesh)) {}
TriangleTree::~TriangleTree() = default;

/// Of the surface and the tree together, as measured with CGAL 5.5 for 320 to 5120 triangles.
double TriangleTree::bytesPerTriangle() noexcept {
  return 152;
}

void TriangleTree::ask(NearestPoint& query) const noexcept {
  boxes_->ask(query);
}
void TriangleTree::ask(FirstCrossing& query) const noexcept {
  boxes_->ask(query);
}

}  // namespace palpate
