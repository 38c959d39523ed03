// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_curvature.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <map>
#include <utility>
#include <vector>

namespace palpate::shell {
namespace {

/// An edge between two triangles.
struct Edge {
  int low, high;
  double angle;  ///< between their normals, negative where the surface is hollow
};

std::vector<Edge> edgesWithin(const SurfaceMesh& mesh) {
  std::map<std::pair<int, int>, int> firstOf;
  std::vector<Edge> edges;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] =
          std::minmax({mesh.triangles()(k, f), mesh.triangles()((k + 1) % 3, f)});
      const auto [entry, isNew] = firstOf.insert({{low, high}, f});
      if (isNew) continue;
      const Eigen::Vector3d own = mesh.triangleNormals().col(f),
                            other = mesh.triangleNormals().col(entry->second),
                            opposite = mesh.points().col(mesh.triangles()((k + 2) % 3, f));
      const double angle = std::atan2(own.cross(other).norm(), own.dot(other));
      const bool isHollow = other.dot(opposite - mesh.points().col(low)) > 0;
      edges.push_back({low, high, isHollow ? -angle : angle});
    }
  return edges;
}

}  // namespace

Eigen::VectorXd inclinations(const SurfaceMesh& mesh) {
  Eigen::VectorXd atVertices = Eigen::VectorXd::Zero(mesh.vertexCount());
  for (const Edge& edge : edgesWithin(mesh))
    if (const double angle = std::abs(edge.angle); angle < kFold)
      for (int v : {edge.low, edge.high}) atVertices[v] = std::max(atVertices[v], angle);
  Eigen::VectorXd largest(mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    largest[f] = atVertices(mesh.triangles().col(f)).maxCoeff();
  return largest;
}

Eigen::VectorXd meanCurvatures(const SurfaceMesh& mesh) {
  // The integral of the mean curvature over an edge's surroundings is half its angle times its
  // length.
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(mesh.vertexCount());
  std::vector<bool> isFolded(mesh.vertexCount(), false);
  for (const Edge& edge : edgesWithin(mesh)) {
    const double length = (mesh.points().col(edge.high) - mesh.points().col(edge.low)).norm();
    for (int v : {edge.low, edge.high}) {
      sums[v] += edge.angle * length / 4;
      if (std::abs(edge.angle) > kFold) isFolded[v] = true;
    }
  }
  Eigen::VectorXd curvatures = Eigen::VectorXd::Zero(mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    double sum = 0, area = 0;
    bool anyFold = false;
    for (int v : mesh.triangles().col(f)) {
      sum += sums[v];
      area += mesh.vertexAreas()[v];
      anyFold = anyFold || isFolded[v];
    }
    if (!anyFold) curvatures[f] = std::abs(sum) / area;
  }
  return curvatures;
}

}  // namespace palpate::shell
