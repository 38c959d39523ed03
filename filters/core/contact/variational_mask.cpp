// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/variational_mask.h"

#include <algorithm>
#include <cmath>
#include <Eigen/SparseCholesky>
#include <numeric>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Integrals of grad phi_i . grad phi_j over a triangle.
Eigen::Matrix3d gradientProducts(const SurfaceMesh& mesh, int triangle) {
  Eigen::Matrix3d opposite;
  for (int k = 0; k < 3; ++k)
    opposite.col(k) = mesh.points().col(mesh.triangles()((k + 2) % 3, triangle)) -
                      mesh.points().col(mesh.triangles()((k + 1) % 3, triangle));
  return opposite.transpose() * opposite / (4 * mesh.triangleAreas()[triangle]);
}

/// The values at a triangle's corners where those at the fixed ones are the mean of the others.
Eigen::Matrix3d withFixedAtTheMean(const Eigen::Vector3i& numbers) {
  const Eigen::Vector3d isFree = (numbers.array() >= 0).cast<double>();
  Eigen::Matrix3d values = isFree.asDiagonal();
  for (int k = 0; k < 3; ++k)
    if (numbers[k] < 0) values.row(k) = isFree.transpose() / isFree.sum();
  return values;
}

}  // namespace

/// A^-1 over some vertices.
struct VariationalMasks::Factors {
  Factors(const SurfaceMesh& mesh, std::vector<int> vertices, MaskPenalty penalty, double length);
  /// @param loads  one a vertex of these.
  Eigen::VectorXd solve(const Eigen::VectorXd& loads) const {
    const Eigen::VectorXd first = inverse.solve(loads);
    return first + inverse.solve(loads - matrix * first);
  }

  std::vector<int> vertices;
  std::vector<int> numbers;  ///< #V, -1 for others
  Sparse matrix;
  Eigen::SimplicialLDLT<Sparse> inverse;
};

VariationalMasks::Factors::Factors(const SurfaceMesh& mesh, std::vector<int> of,
                                   MaskPenalty penalty, double length)
    : vertices(std::move(of)), numbers(mesh.vertexCount(), -1) {
  const int count = static_cast<int>(vertices.size());
  Eigen::VectorXd areas(count);
  for (int i = 0; i < count; ++i) {
    numbers[vertices[i]] = i;
    areas[i] = mesh.vertexAreas()[vertices[i]];
  }
  std::vector<Eigen::Triplet<double>> mass, stiffness;
  Eigen::VectorXd onDiagonal = areas;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    Eigen::Vector3i at;
    for (int k = 0; k < 3; ++k) at[k] = numbers[mesh.triangles()(k, f)];
    if (at.maxCoeff() < 0) continue;
    const Eigen::Matrix3d values = withFixedAtTheMean(at);
    const Eigen::Matrix3d products = values.transpose() * gradientProducts(mesh, f) * values;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if (at[i] < 0 || at[j] < 0) continue;
        stiffness.emplace_back(at[i], at[j], products(i, j));
        if (i == j) continue;
        mass.emplace_back(at[i], at[j], mesh.triangleAreas()[f] / 12);
        onDiagonal[at[i]] -= mesh.triangleAreas()[f] / 12;
      }
  }
  for (int i = 0; i < count; ++i) mass.emplace_back(i, i, onDiagonal[i]);
  Sparse penalties(count, count);
  penalties.setFromTriplets(stiffness.begin(), stiffness.end());
  matrix.resize(count, count);
  matrix.setFromTriplets(mass.begin(), mass.end());
  if (penalty == MaskPenalty::Gradient)
    matrix += length * length * penalties;
  else
    matrix +=
        std::pow(length, 4) * Sparse(penalties * areas.cwiseInverse().asDiagonal() * penalties);
  inverse.compute(matrix);
  if (inverse.info() != Eigen::Success)
    throw std::invalid_argument("the variational masks' matrix is singular: is there a sliver?");
}

VariationalMasks::VariationalMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                                   MaskPenalty penalty, double length, double tail)
    : VertexMasks(mesh, conditions), tail_(tail) {
  if (!(length > 0) || !(length <= mesh.diagonal()))
    throw std::invalid_argument(
        "the length of a variational mask must be above 0 and at most the surface's diagonal, " +
        std::to_string(mesh.diagonal()) + ", not " + std::to_string(length));
  if (!(tail >= 0) || !(tail < 0.5))
    throw std::invalid_argument("the tail of a variational mask must be 0 to 0.5, not " +
                                std::to_string(tail));
  const std::vector<int> free = conditions.freeNodes();
  free_ = std::make_unique<Factors>(mesh, free, penalty, length);
  supportShares_ = Eigen::VectorXd::Zero(mesh.vertexCount());
  if (static_cast<int>(free.size()) == mesh.vertexCount()) return;
  // Without a support, the mask around a vertex puts on the fixed ones the sum of a_u (A^-1)_uv. A
  // is symmetric: one solve gives it for all.
  std::vector<int> all(mesh.vertexCount());
  std::iota(all.begin(), all.end(), 0);
  Eigen::VectorXd onSupport = Eigen::VectorXd::Zero(mesh.vertexCount());
  for (int v : conditions.fixedNodes()) onSupport[v] = mesh.vertexAreas()[v];
  supportShares_ = Factors(mesh, all, penalty, length).solve(onSupport).cwiseMax(0).cwiseMin(1);
}

VariationalMasks::~VariationalMasks() = default;

double VariationalMasks::lengthForRadius(MaskPenalty penalty, double radius) {
  // The mask's centre sinks by 1 / (2 alpha), by the biharmonic by 1 / (2 sqrt 2 alpha), times
  // (1 - nu^2) / E: the integral of its Fourier transform, 1 / (1 + (alpha k)^2 or ^4), over pi.
  const double linear = maskKernel(MaskShape::Linear).halfSpaceCompliance();
  return radius / (2 * linear) / (penalty == MaskPenalty::Gradient ? 1 : std::sqrt(2.));
}

/// A^-1 of loads on the free vertices: #V, zero where fixed.
Eigen::VectorXd VariationalMasks::wholeSolution(const Eigen::VectorXd& loads) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(mesh_.vertexCount());
  whole(free_->vertices) = free_->solve(loads);
  return whole;
}

Eigen::VectorXd VariationalMasks::column(int vertex) const {
  requireFree(vertex);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(free_->vertices.size());
  load[free_->numbers[vertex]] = 1;
  return wholeSolution(load);
}

Eigen::VectorXd VariationalMasks::densityAt(const SurfacePoint& point) const {
  if (point.triangle < 0 || point.triangle >= mesh_.triangleCount())
    throw std::invalid_argument("there is no triangle " + std::to_string(point.triangle) +
                                " to load");
  Eigen::VectorXd load = Eigen::VectorXd::Zero(free_->vertices.size());
  for (int k = 0; k < 3; ++k) {
    const int number = free_->numbers[mesh_.triangles()(k, point.triangle)];
    if (number >= 0) load[number] = point.barycentric[k];
  }
  return wholeSolution(load);
}

Eigen::VectorXd VariationalMasks::smoothed(const Eigen::VectorXd& values) const {
  if (values.size() != mesh_.vertexCount())
    throw std::invalid_argument("a field on this surface has " +
                                std::to_string(mesh_.vertexCount()) + " values, not " +
                                std::to_string(values.size()));
  const Eigen::VectorXd areas = mesh_.vertexAreas()(free_->vertices);
  return wholeSolution(areas.cwiseProduct(values(free_->vertices)));
}

VertexMask VariationalMasks::at(int vertex) const {
  const Eigen::VectorXd whole = column(vertex);
  const auto share = [&](int v) { return mesh_.vertexAreas()[v] * whole[v]; };
  std::vector<int> nodes = free_->vertices;
  const auto isDenser = [&](int a, int b) { return std::abs(whole[a]) > std::abs(whole[b]); };
  std::sort(nodes.begin(), nodes.end(), isDenser);
  double left = 0, total = 0;
  while (nodes.size() > 1 && nodes.back() != vertex &&
         (left += std::abs(share(nodes.back()))) <= tail_)
    nodes.pop_back();
  for (int v : nodes) total += share(v);
  VertexMask mask;
  mask.density = whole(nodes) / total;
  mask.nodes = std::move(nodes);
  mask.supportShare = supportShares_[vertex];
  return mask;
}

}  // namespace palpate
