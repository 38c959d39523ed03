// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/load_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace palpate {
namespace {

constexpr double kLengthShare = 0.2;  // of the root of the free surface's area
constexpr double kLeastEdges = 2;
constexpr double kTie = 1e-9;  // relative, far above rounding

/// What vertices at `rows` do under three unit forces along the axes around a vertex: 3 #rows by 3,
/// m/N. None if the load needs a column that is missing.
std::optional<Eigen::MatrixX3d> respond(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                        int vertex, double length, const std::vector<int>& rows) {
  const Eigen::Vector3d middle = mesh.points().col(vertex);
  std::vector<int> nodes;
  std::vector<double> shares;
  double force = 0;
  for (int node = 0; node < mesh.vertexCount(); ++node) {
    if (greens.isFixed(node)) continue;
    const double share = 1 - (mesh.points().col(node) - middle).norm() / length;
    if (share <= 0) continue;
    if (!greens.hasColumn(node)) return std::nullopt;
    nodes.push_back(node);
    shares.push_back(share);
    force += greens.vertexArea(node) * share;
  }
  if (nodes.empty()) return std::nullopt;
  Eigen::MatrixX3d answer = Eigen::MatrixX3d::Zero(3 * rows.size(), 3);
  Eigen::VectorXd weights(3 * nodes.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      weights.segment<3>(3 * i) = shares[i] / force * Eigen::Vector3d::Unit(axis);
    greens.accumulate(nodeList(nodes), weights, nodeList(rows), answer.col(axis));
  }
  return answer;
}

/// Over the norm of a whole.
double relative(const Eigen::MatrixX3d& part, const Eigen::MatrixX3d& whole,
                const Eigen::VectorXd& weights) {
  const auto norm = [&](const Eigen::MatrixX3d& m) {
    return std::sqrt(weights.dot(m.rowwise().squaredNorm()));
  };
  return norm(part) / norm(whole);
}

}  // namespace

double LoadDifferences::mean(const std::vector<double>& differences) {
  if (differences.empty()) return -1;
  const Eigen::Map<const Eigen::VectorXd> d(differences.data(), differences.size());
  return std::sqrt(d.squaredNorm() / static_cast<double>(d.size()));
}

double LoadDifferences::most(const std::vector<double>& differences) {
  if (differences.empty()) return -1;
  std::vector<double> sorted = differences;
  std::sort(sorted.begin(), sorted.end());
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(0.95 * sorted.size()))];
}

SpreadLoads chooseSpreadLoads(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                              int count) {
  SpreadLoads loads;
  double area = 0;
  Eigen::VectorXd distance =
      Eigen::VectorXd::Constant(mesh.vertexCount(), std::numeric_limits<double>::max());
  const auto moveAway = [&](int from) {
    distance = distance.cwiseMin(
        (mesh.points().colwise() - mesh.points().col(from)).colwise().norm().transpose());
  };
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    if (conditions.isFixed(v))
      moveAway(v);
    else
      area += mesh.vertexAreas()[v];
  }
  loads.length = std::max(kLengthShare * std::sqrt(area), kLeastEdges * mesh.meanEdgeLength());
  for (int i = 0; i < count; ++i) {
    const double farthest = distance.maxCoeff();
    if (!(farthest > 0)) break;  // fixed vertices have the distance 0
    int next = 0;                // the first of those that are equally far, whatever the unit
    while (distance[next] < (1 - kTie) * farthest) ++next;
    loads.vertices.push_back(next);
    moveAway(next);
  }
  return loads;
}

LoadDifferences compareUnderLoads(const GreensFunctions& finer, const SurfaceMesh& finerMesh,
                                  const GreensFunctions& coarser, const SurfaceMesh& coarserMesh,
                                  const std::vector<int>& vertices, const SpreadLoads& loads) {
  std::vector<int> rows, finerRows;
  for (int row : coarser.info().conditions.freeNodes())
    if (vertices[row] >= 0) {
      rows.push_back(row);
      finerRows.push_back(vertices[row]);
    }
  Eigen::VectorXd weights(3 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    weights.segment<3>(3 * i).setConstant(coarser.vertexArea(rows[i]));
  LoadDifferences differences;
  for (int vertex : loads.vertices) {
    const auto fine = respond(finer, finerMesh, vertices[vertex], loads.length, finerRows);
    if (!fine) continue;
    const auto coarse = respond(coarser, coarserMesh, vertex, loads.length, rows);
    if (!coarse) continue;
    const Eigen::MatrixX3d difference = *fine - *coarse;
    differences.field.push_back(relative(difference, *fine, weights));
    const Eigen::Index at = 3 * (std::lower_bound(rows.begin(), rows.end(), vertex) - rows.begin());
    differences.contact.push_back(difference.middleRows<3>(at).norm() /
                                  fine->middleRows<3>(at).norm());
    differences.fieldGrowth.push_back(relative(*fine, *coarse, weights));
    differences.contactGrowth.push_back(fine->middleRows<3>(at).norm() /
                                        coarse->middleRows<3>(at).norm());
  }
  return differences;
}

LoadDifferences compareUnderLoads(const GreensFunctions& finer, const SurfaceMesh& finerMesh,
                                  const GreensFunctions& coarser, const SurfaceMesh& coarserMesh,
                                  const SpreadLoads& loads) {
  std::vector<int> vertices(coarserMesh.vertexCount());
  std::iota(vertices.begin(), vertices.end(), 0);
  return compareUnderLoads(finer, finerMesh, coarser, coarserMesh, vertices, loads);
}

}  // namespace palpate
