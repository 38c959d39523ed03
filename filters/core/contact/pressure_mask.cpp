// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/pressure_mask.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "mesh/geodesic_distance.h"

namespace palpate {
namespace {

// Rounding, as under a rotation of the mesh, must not decide what belongs to a mask: vertices just
// at the radius and normals at right angles (the edges of a box) do not.
constexpr double kEdgeOfRadius = 1 - 1e-9;
constexpr double kSmallestCosine = 1e-6;

/// Vertices that are reached from one along edges, by way of those that belong.
template <class Belongs>
std::vector<int> reachedFrom(const SurfaceMesh& mesh, int vertex, const Belongs& belongs) {
  std::vector<int> reached{vertex};
  std::vector<bool> seen(mesh.vertexCount(), false);
  seen[vertex] = true;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int f : mesh.trianglesOfVertex(reached[i]))
      for (int k = 0; k < 3; ++k) {
        const int v = mesh.triangles()(k, f);
        if (seen[v]) continue;
        seen[v] = true;
        if (belongs(v)) reached.push_back(v);
      }
  return reached;
}

}  // namespace

VertexMasks::VertexMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions)
    : mesh_(mesh), conditions_(conditions) {
  if (conditions.nodeCount() != mesh.vertexCount())
    throw std::invalid_argument("there are boundary types of " +
                                std::to_string(conditions.nodeCount()) +
                                " vertices for a surface of " + std::to_string(mesh.vertexCount()));
}

void VertexMasks::requireFree(int vertex) const {
  if (vertex < 0 || vertex >= mesh_.vertexCount())
    throw std::invalid_argument("there is no vertex " + std::to_string(vertex) +
                                " to put a pressure mask on");
  if (conditions_.isFixed(vertex))
    throw std::invalid_argument("vertex " + std::to_string(vertex) +
                                " is fixed: a pressure mask needs a free node");
}

PressureMasks::PressureMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             MaskShape shape, double radius, MaskDistance distance)
    : VertexMasks(mesh, conditions), shape_(shape), radius_(radius) {
  if (!(radius >= 0) || !std::isfinite(radius))
    throw std::invalid_argument("the radius of a pressure mask must be at least 0, not " +
                                std::to_string(radius));
  if (distance == MaskDistance::Geodesic) geodesic_ = std::make_shared<GeodesicDistances>(mesh);
}

Eigen::VectorXd PressureMasks::distancesFrom(int vertex) const {
  if (geodesic_) return geodesic_->from(vertex);
  return (mesh_.points().colwise() - mesh_.points().col(vertex)).colwise().norm().transpose();
}

VertexMask PressureMasks::at(int vertex) const {
  requireFree(vertex);
  const Eigen::VectorXd distance = distancesFrom(vertex);
  const Eigen::Vector3d normal = mesh_.vertexNormals().col(vertex);
  const auto isWithin = [&](int v) { return distance[v] < kEdgeOfRadius * radius_; };
  const auto value = [&](int v) {
    return maskValue(shape_, v == vertex ? 0 : distance[v] / radius_);
  };
  const std::vector<int> reached = reachedFrom(mesh_, vertex, [&](int v) {
    return isWithin(v) && mesh_.vertexNormals().col(v).dot(normal) > kSmallestCosine;
  });
  VertexMask mask;
  std::vector<double> values;
  std::vector<bool> isReached(mesh_.vertexCount(), false);
  double total = 0, onSupport = 0, beyond = 0;
  for (int v : reached) {
    isReached[v] = true;
    const double here = value(v), share = mesh_.vertexAreas()[v] * here;
    if (conditions_.isFixed(v)) onSupport += share;
    if (conditions_.isFixed(v) || here <= 0) continue;
    mask.nodes.push_back(v);
    values.push_back(here);
    total += share;
  }
  for (int v = 0; v < mesh_.vertexCount(); ++v)
    if (!isReached[v] && isWithin(v)) beyond += mesh_.vertexAreas()[v] * value(v);
  mask.density = Eigen::Map<Eigen::VectorXd>(values.data(), values.size()) / total;
  mask.supportShare = onSupport / (total + onSupport + beyond);
  mask.beyondShare = beyond / (total + onSupport + beyond);
  return mask;
}

}  // namespace palpate
