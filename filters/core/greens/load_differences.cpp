// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/load_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

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

LoadDifferences compareUnderLoads(const std::vector<ComparedMesh>& meshes,
                                  const GreensFunctions& shared, const SpreadLoads& loads) {
  std::vector<int> rows;
  for (int row : shared.info().conditions.freeNodes())
    if (std::all_of(meshes.begin(), meshes.end(),
                    [&](const ComparedMesh& m) { return m.vertices[row] >= 0; }))
      rows.push_back(row);
  Eigen::VectorXd weights(3 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    weights.segment<3>(3 * i).setConstant(shared.vertexArea(rows[i]));
  LoadDifferences differences;
  for (int vertex : loads.vertices) {
    std::vector<Eigen::MatrixX3d> answers;
    for (const ComparedMesh& m : meshes) {
      std::vector<int> there;
      for (int row : rows) there.push_back(m.vertices[row]);
      auto answer = respond(m.greens, m.mesh, m.vertices[vertex], loads.length, there);
      if (answer) answers.push_back(std::move(*answer));
    }
    if (answers.size() < meshes.size()) continue;
    Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(3 * rows.size(), 3);
    for (std::size_t i = 0; i < meshes.size(); ++i) sum += meshes[i].factor * answers[i];
    const Eigen::Index at = 3 * (std::lower_bound(rows.begin(), rows.end(), vertex) - rows.begin());
    const auto middle = [&](const Eigen::MatrixX3d& m) { return m.middleRows<3>(at).norm(); };
    differences.field.push_back(relative(sum, answers[0], weights));
    differences.contact.push_back(middle(sum) / middle(answers[0]));
    differences.fieldGrowth.push_back(relative(answers[0], answers[1], weights));
    differences.contactGrowth.push_back(middle(answers[0]) / middle(answers[1]));
  }
  return differences;
}

LoadDifferences compareUnderLoads(const GreensFunctions& finer, const SurfaceMesh& finerMesh,
                                  const GreensFunctions& coarser, const SurfaceMesh& coarserMesh,
                                  const std::vector<int>& vertices, const SpreadLoads& loads) {
  std::vector<int> own(coarserMesh.vertexCount());
  std::iota(own.begin(), own.end(), 0);
  return compareUnderLoads({{finer, finerMesh, vertices, 1}, {coarser, coarserMesh, own, -1}},
                           coarser, loads);
}

LoadDifferences compareUnderLoads(const GreensFunctions& finer, const SurfaceMesh& finerMesh,
                                  const GreensFunctions& coarser, const SurfaceMesh& coarserMesh,
                                  const SpreadLoads& loads) {
  std::vector<int> vertices(coarserMesh.vertexCount());
  std::iota(vertices.begin(), vertices.end(), 0);
  return compareUnderLoads(finer, finerMesh, coarser, coarserMesh, vertices, loads);
}

}  // namespace palpate
