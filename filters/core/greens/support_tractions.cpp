// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/support_tractions.h"

#include <algorithm>
#include <set>

namespace palpate {
namespace {

/// The smooth patches that bear a fixed vertex's reaction.
std::set<int> bearingPatches(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             const Eigen::VectorXi& smoothPatches, int vertex) {
  std::set<int> all, bearing;
  for (int f : mesh.trianglesOfVertex(vertex)) {
    const auto corners = mesh.triangles().col(f);
    all.insert(smoothPatches[f]);
    if (std::all_of(corners.begin(), corners.end(), [&](int c) { return conditions.isFixed(c); }))
      bearing.insert(smoothPatches[f]);
  }
  return bearing.empty() ? all : bearing;
}

}  // namespace

Eigen::Matrix3Xd supportShares(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               const Eigen::VectorXi& smoothPatches) {
  Eigen::Matrix3Xd shares = Eigen::Matrix3Xd::Ones(3, mesh.triangleCount());
  for (int v : conditions.fixedNodes()) {
    const std::set<int> bearing = bearingPatches(mesh, conditions, smoothPatches, v);
    double area = 0;
    for (int f : mesh.trianglesOfVertex(v))
      if (bearing.count(smoothPatches[f]) > 0) area += mesh.triangleAreas()[f] / 3;
    for (int f : mesh.trianglesOfVertex(v))
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles()(k, f) == v)
          shares(k, f) = bearing.count(smoothPatches[f]) > 0 ? mesh.vertexAreas()[v] / area : 0;
  }
  return shares;
}

}  // namespace palpate
