// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/curved_refinement.h"

#include <algorithm>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace palpate {
namespace {

/// Unit normal of a vertex over one smooth patch, exact on spheres (N. Max, "Weights for computing
/// vertex normals from facet normals", 1999).
Eigen::Vector3d patchNormal(const SurfaceMesh& mesh, const Eigen::VectorXi& patches, int vertex,
                            int patch) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int f : mesh.trianglesOfVertex(vertex)) {
    if (patches[f] != patch) continue;
    const Eigen::Vector3i corner = mesh.triangles().col(f);
    const int k = corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
    const Eigen::Vector3d at = mesh.points().col(vertex),
                          a = mesh.points().col(corner[(k + 1) % 3]) - at,
                          b = mesh.points().col(corner[(k + 2) % 3]) - at;
    sum += a.cross(b) / (a.squaredNorm() * b.squaredNorm());
  }
  return sum.normalized();
}

/// The middle of the cubic edge; a straight one without a patch.
Eigen::Vector3d edgeMiddle(const SurfaceMesh& mesh, const Eigen::VectorXi& patches, int a, int b,
                           std::optional<int> patch) {
  const Eigen::Vector3d pa = mesh.points().col(a), pb = mesh.points().col(b);
  Eigen::Vector3d middle = (pa + pb) / 2;
  if (!patch) return middle;
  const Eigen::Vector3d na = patchNormal(mesh, patches, a, *patch),
                        nb = patchNormal(mesh, patches, b, *patch);
  return middle - ((pb - pa).dot(na) * na + (pa - pb).dot(nb) * nb) / 8;
}

struct Edge {
  std::optional<int> patch;  ///< none between two
  int vertex;
};
using Ends = std::pair<int, int>;
using Edges = std::map<Ends, Edge>;

/// The ends of a triangle's edge after its corner k, ascending.
Ends endsOf(const SurfaceMesh& mesh, int triangle, int k) {
  const int a = mesh.triangles()(k, triangle), b = mesh.triangles()((k + 1) % 3, triangle);
  return {std::min(a, b), std::max(a, b)};
}

Edges findEdges(const SurfaceMesh& mesh, const Eigen::VectorXi& patches) {
  Edges edges;
  int next = mesh.vertexCount();
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [edge, isNew] = edges.try_emplace(endsOf(mesh, f, k), Edge{patches[f], next});
      if (isNew)
        ++next;
      else if (edge->second.patch != patches[f])
        edge->second.patch.reset();
    }
  return edges;
}

}  // namespace

RemeshedSurface refineCurved(const SurfaceMesh& mesh,
                             const std::vector<unsigned char>& boundaryTypes,
                             const Eigen::VectorXi& smoothPatches) {
  if (static_cast<int>(boundaryTypes.size()) != mesh.vertexCount() ||
      smoothPatches.size() != mesh.triangleCount())
    throw std::invalid_argument(
        "refinement takes a boundary type for each vertex and a smooth patch for each triangle");
  const Edges edges = findEdges(mesh, smoothPatches);
  RemeshedSurface fine;
  fine.points.resize(3, mesh.vertexCount() + edges.size());
  fine.points.leftCols(mesh.vertexCount()) = mesh.points();
  fine.boundaryTypes = boundaryTypes;
  fine.boundaryTypes.resize(fine.points.cols());
  for (const auto& [ends, edge] : edges) {
    fine.points.col(edge.vertex) =
        edgeMiddle(mesh, smoothPatches, ends.first, ends.second, edge.patch);
    fine.boundaryTypes[edge.vertex] = boundaryTypes[ends.first] && boundaryTypes[ends.second];
  }
  fine.triangles.resize(3, 4 * mesh.triangleCount());
  fine.smoothPatches.resize(4 * mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Eigen::Vector3i corner = mesh.triangles().col(f);
    Eigen::Vector3i middle;  // of the edge after each corner
    for (int k = 0; k < 3; ++k) middle[k] = edges.at(endsOf(mesh, f, k)).vertex;
    for (int k = 0; k < 3; ++k)
      fine.triangles.col(4 * f + k) << corner[k], middle[k], middle[(k + 2) % 3];
    fine.triangles.col(4 * f + 3) = middle;
    fine.smoothPatches.segment<4>(4 * f).setConstant(smoothPatches[f]);
  }
  return fine;
}

}  // namespace palpate
