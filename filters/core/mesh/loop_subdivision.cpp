// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/loop_subdivision.h"

#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <array>
#include <map>

#include "mesh/open_mesh_surface.h"
#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

/// A new vertex has just two old neighbours: the ends of its edge.
Eigen::Matrix2Xi findParents(const OpenMeshSurface& mesh, int oldCount) {
  Eigen::Matrix2Xi parents(2, mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    parents.col(v.idx()).setConstant(v.idx());
    if (v.idx() < oldCount) continue;
    int found = 0;
    for (const auto neighbour : mesh.vv_range(v))
      if (neighbour.idx() < oldCount) parents(found++, v.idx()) = neighbour.idx();
    if (parents(0, v.idx()) > parents(1, v.idx()))
      std::swap(parents(0, v.idx()), parents(1, v.idx()));
  }
  return parents;
}

/// The vertices that a fine triangle descends from are those of its coarse triangle.
std::vector<int> findParentTriangles(const SubdivisionLevel& level,
                                     const Eigen::Matrix3Xi& coarse) {
  std::map<std::array<int, 3>, int> triangleOf;
  for (Eigen::Index f = 0; f < coarse.cols(); ++f) {
    std::array<int, 3> key{coarse(0, f), coarse(1, f), coarse(2, f)};
    std::sort(key.begin(), key.end());
    triangleOf[key] = static_cast<int>(f);
  }
  std::vector<int> parent;
  for (Eigen::Index f = 0; f < level.triangles.cols(); ++f) {
    std::vector<int> ancestors;
    for (int k = 0; k < 3; ++k)
      for (int end : level.parents.col(level.triangles(k, f))) ancestors.push_back(end);
    std::sort(ancestors.begin(), ancestors.end());
    ancestors.erase(std::unique(ancestors.begin(), ancestors.end()), ancestors.end());
    parent.push_back(triangleOf.at({ancestors[0], ancestors[1], ancestors[2]}));
  }
  return parent;
}

}  // namespace

SubdivisionLevel subdivideLoop(const SurfaceMesh& surface) {
  OpenMeshSurface mesh = toOpenMesh(surface.points(), surface.triangles());
  OpenMesh::Subdivider::Uniform::LoopT<OpenMeshSurface, double> loop;
  std::size_t valence = 0;
  for (const auto v : mesh.vertices()) valence = std::max<std::size_t>(valence, mesh.valence(v));
  loop.init_weights(valence + 1);  // its own table ends at 50 and is not checked
  loop.attach(mesh);
  loop(1);
  loop.detach();

  SubdivisionLevel level;
  level.points.resize(3, mesh.n_vertices());
  for (const auto v : mesh.vertices())
    level.points.col(v.idx()) = Eigen::Map<const Eigen::Vector3d>(mesh.point(v).data());
  level.triangles.resize(3, mesh.n_faces());
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.fv_range(f)) level.triangles(k++, f.idx()) = v.idx();
  }
  level.parents = findParents(mesh, surface.vertexCount());
  level.parentTriangle = findParentTriangles(level, surface.triangles());
  return level;
}

}  // namespace palpate
