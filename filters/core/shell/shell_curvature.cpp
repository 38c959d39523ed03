// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_curvature.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <vector>

#include "mesh/triangle_sides.h"

namespace palpate::shell {
namespace {

/// An edge between two triangles.
struct Edge {
  int low, high;
  double angle;  ///< between their normals, negative where the surface is hollow
};

std::vector<Edge> edgesWithin(const SurfaceMesh& mesh) {
  std::vector<Edge> edges;
  forEachEdge(sortedSides(mesh.triangles()), [&](auto first, auto last) {
    if (last - first != 2) return;
    const Eigen::Vector3d
        here = mesh.triangleNormals().col(first->triangle),
        there = mesh.triangleNormals().col(first[1].triangle),
        middle = mesh.points()(Eigen::all, mesh.triangles().col(first->triangle)).rowwise().mean();
    const double angle = std::atan2(here.cross(there).norm(), here.dot(there));
    const bool isHollow = there.dot(middle - mesh.points().col(first->low)) > 0;
    edges.push_back({first->low, first->high, isHollow ? -angle : angle});
  });
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
