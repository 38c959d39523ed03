// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/edge_subdivision.h"

#include <algorithm>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "mesh/surface_mesh.h"

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

/// What the middle of the cubic edge is off that of the straight one.
Eigen::Vector3d offset(const SurfaceMesh& mesh, const Eigen::VectorXi& patches, int a, int b,
                       int patch) {
  const Eigen::Vector3d edge = mesh.points().col(b) - mesh.points().col(a),
                        na = patchNormal(mesh, patches, a, patch),
                        nb = patchNormal(mesh, patches, b, patch);
  return (edge.dot(nb) * nb - edge.dot(na) * na) / 8;
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

/// The triangles cut in four, with the middles of the edges at the middles of their ends.
SubdivisionLevel splitTriangles(const SurfaceMesh& mesh, const Edges& edges) {
  const int old = mesh.vertexCount();
  SubdivisionLevel fine;
  fine.points.resize(3, old + edges.size());
  fine.points.leftCols(old) = mesh.points();
  fine.parents.resize(2, fine.points.cols());
  for (int v = 0; v < old; ++v) fine.parents.col(v).setConstant(v);
  for (const auto& [ends, edge] : edges) {
    fine.parents.col(edge.vertex) << ends.first, ends.second;
    fine.points.col(edge.vertex) =
        (mesh.points().col(ends.first) + mesh.points().col(ends.second)) / 2;
  }
  fine.triangles.resize(3, 4 * mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Eigen::Vector3i corner = mesh.triangles().col(f);
    Eigen::Vector3i middle;  // of the edge after each corner
    for (int k = 0; k < 3; ++k) middle[k] = edges.at(endsOf(mesh, f, k)).vertex;
    for (int k = 0; k < 3; ++k)
      fine.triangles.col(4 * f + k) << corner[k], middle[k], middle[(k + 2) % 3];
    fine.triangles.col(4 * f + 3) = middle;
    fine.parentTriangle.insert(fine.parentTriangle.end(), 4, f);
  }
  return fine;
}

}  // namespace

SubdivisionLevel subdivideFlat(const SurfaceMesh& mesh) {
  return splitTriangles(mesh, findEdges(mesh, Eigen::VectorXi::Zero(mesh.triangleCount())));
}

SubdivisionLevel subdivideCurved(const SurfaceMesh& mesh, const Eigen::VectorXi& smoothPatches) {
  if (smoothPatches.size() != mesh.triangleCount())
    throw std::invalid_argument("refinement takes a smooth patch for each triangle");
  const Edges edges = findEdges(mesh, smoothPatches);
  SubdivisionLevel fine = splitTriangles(mesh, edges);
  for (const auto& [ends, edge] : edges)
    if (edge.patch)
      fine.points.col(edge.vertex) +=
          offset(mesh, smoothPatches, ends.first, ends.second, *edge.patch);
  return fine;
}

}  // namespace palpate
