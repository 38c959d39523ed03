// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/reciprocity.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <type_traits>

#include "mesh/surface_mesh.h"

namespace palpate {

namespace {

/// What plain symmetrisation takes from f^T S, and how it is given back: S' = mean + (r v^T + v
/// r^T) / size with r = (S^T f - S f) / 2 and v = f / area.
class KeptForce {
 public:
  /// @param columns  the free nodes' positions among columnNodes.
  template <class Scalar>
  KeptForce(const Eigen::Matrix3Xd& force, const Scalar* matrix,
            const BoundaryConditions& conditions, const Eigen::VectorXd& areas,
            const std::vector<int>& columnNodes, const std::vector<int>& columns)
      : force_(Eigen::Matrix3Xd::Zero(3, areas.size())), spread_(force_), lost_(force_) {
    for (int c : columns) force_.col(columnNodes[c]) = force.col(columnNodes[c]);
    for (int node = 0; node < areas.size(); ++node) {
      if (conditions.isFixed(node)) continue;
      isComplete_ = isComplete_ && force_.col(node) == force.col(node);
      spread_.col(node) = force_.col(node) / areas[node];
    }
    size_ = force_.cwiseProduct(spread_).sum();
    isComplete_ = isComplete_ && size_ > 0;
    if (!isComplete_) return;
    for (int c : columns)
      for (int j = 0; j < 3; ++j) {
        const int node = columnNodes[c];
        const Eigen::VectorXd column = columnOf(matrix, c, j).template cast<double>();
        lost_(j, node) += force_.reshaped().dot(column) / areas[node] / 2;
        lost_.reshaped() -= column * (spread_(j, node) / 2);
      }
    for (int node = 0; node < areas.size(); ++node)
      if (conditions.isFixed(node)) lost_.col(node).setZero();
  }

  template <class Scalar>
  void giveBack(Scalar* matrix, const Eigen::VectorXd& areas, const std::vector<int>& columnNodes,
                const std::vector<int>& columns, double share) const {
    if (!isComplete_) return;
    for (int c : columns)
      for (int j = 0; j < 3; ++j) {
        const int node = columnNodes[c];
        columnOf(matrix, c, j) += ((lost_.reshaped() * force_(j, node) +
                                    spread_.reshaped() * (lost_(j, node) * areas[node])) /
                                   (size_ / share))
                                      .template cast<Scalar>();
      }
  }

 private:
  template <class Scalar>
  auto columnOf(Scalar* matrix, int c, int j) const {
    using Vector = Eigen::Matrix<std::remove_const_t<Scalar>, Eigen::Dynamic, 1>;
    using Column = std::conditional_t<std::is_const_v<Scalar>, const Vector, Vector>;
    return Eigen::Map<Column>(matrix + force_.size() * (3 * Eigen::Index(c) + j), force_.size());
  }

  Eigen::Matrix3Xd force_, spread_, lost_;  // 3 by #nodes, zero where fixed
  double size_ = 0;
  bool isComplete_ = true;
};

}  // namespace

template <class Scalar>
double makeReciprocal(Scalar* matrix, const BoundaryConditions& conditions,
                      const Eigen::VectorXd& areas, const std::vector<int>& columnNodes,
                      bool symmetrise, const std::vector<Eigen::Matrix3Xd>& kept,
                      double keptShare) {
  using Block = Eigen::Map<Eigen::Matrix<Scalar, 3, 3>, 0, Eigen::OuterStride<>>;
  const Eigen::Index rows = 3 * Eigen::Index(areas.size());
  std::vector<int> columns;
  for (std::size_t c = 0; c < columnNodes.size(); ++c)
    if (!conditions.isFixed(columnNodes[c])) columns.push_back(static_cast<int>(c));
  const auto block = [&](int row, int column) {
    return Block(matrix + 3 * columnNodes[row] + 3 * rows * column, Eigen::OuterStride<>(rows));
  };

  std::vector<KeptForce> forces;
  if (symmetrise)
    for (const Eigen::Matrix3Xd& force : kept)
      forces.emplace_back(force, matrix, conditions, areas, columnNodes, columns);

  double antisymmetric = 0, all = 0;
  constexpr std::size_t tile = 32;  // pairs of tiles of rows and columns stay in cache
  for (std::size_t iTile = 0; iTile < columns.size(); iTile += tile)
    for (std::size_t jTile = iTile; jTile < columns.size(); jTile += tile)
      for (std::size_t i = iTile; i < std::min(iTile + tile, columns.size()); ++i)
        for (std::size_t j = std::max(i, jTile); j < std::min(jTile + tile, columns.size()); ++j) {
          const int p = columns[i], q = columns[j];
          const double ap = areas[columnNodes[p]], aq = areas[columnNodes[q]];
          Block pq = block(p, q), qp = block(q, p);
          const Eigen::Matrix3d s = pq.template cast<double>() / aq;
          const Eigen::Matrix3d t = qp.template cast<double>().transpose() / ap;
          const double count = i == j ? 1 : 2;
          antisymmetric += count * (s - t).squaredNorm();
          all += i == j ? s.squaredNorm() : s.squaredNorm() + t.squaredNorm();
          if (!symmetrise) continue;
          const Eigen::Matrix3d mean = (s + t) / 2;
          pq = (mean * aq).template cast<Scalar>();
          qp = (mean.transpose() * ap).template cast<Scalar>();
        }
  for (const KeptForce& force : forces)
    force.giveBack(matrix, areas, columnNodes, columns, keptShare);
  return all > 0 ? std::sqrt(antisymmetric / all) : 0;
}

template double makeReciprocal(double*, const BoundaryConditions&, const Eigen::VectorXd&,
                               const std::vector<int>&, bool, const std::vector<Eigen::Matrix3Xd>&,
                               double);
template double makeReciprocal(float*, const BoundaryConditions&, const Eigen::VectorXd&,
                               const std::vector<int>&, bool, const std::vector<Eigen::Matrix3Xd>&,
                               double);

std::vector<Eigen::Matrix3Xd> unitPressures(const SurfaceMesh& mesh) {
  std::vector<Eigen::Matrix3Xd> forces(mesh.bodyCount(),
                                       Eigen::Matrix3Xd::Zero(3, mesh.vertexCount()));
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int v : mesh.triangles().col(f))
      forces[mesh.bodyOfVertex(v)].col(v) +=
          mesh.triangleAreas()[f] / 3 * mesh.triangleNormals().col(f);
  return forces;
}

namespace {

/// omega -> omega x r.
Eigen::Matrix3d rotationAt(const Eigen::Vector3d& r) {
  Eigen::Matrix3d m;
  m << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return m;
}

double bodyRockingCompliance(const GreensFunctions& greens, const SurfaceMesh& mesh,
                             const std::vector<int>& freeNodes) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int node : freeNodes) middle += mesh.points().col(node) / double(freeNodes.size());
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Matrix3d> rotation;
  for (int node : freeNodes) {
    rotation.push_back(rotationAt(mesh.points().col(node) - middle));
    inertia += greens.vertexArea(node) * rotation.back().transpose() * rotation.back();
  }
  const Eigen::Matrix3d inverse = inertia.inverse();
  Eigen::Matrix3d compliance;
  Eigen::VectorXd weights(3 * freeNodes.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < freeNodes.size(); ++i)
      weights.segment<3>(3 * i) = rotation[i] * inverse.col(axis);
    Eigen::VectorXd response = Eigen::VectorXd::Zero(3 * greens.nodeCount());
    greens.accumulate(nodeList(freeNodes), weights, response);
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < freeNodes.size(); ++i)
      turned += greens.vertexArea(freeNodes[i]) * rotation[i].transpose() *
                response.segment<3>(3 * freeNodes[i]);
    compliance.col(axis) = inverse * turned;
  }
  const Eigen::Matrix3d symmetric = (compliance + compliance.transpose()) / 2;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvalues().maxCoeff();
}

}  // namespace

double rockingCompliance(const GreensFunctions& greens, const SurfaceMesh& mesh) {
  double largest = -1;
  for (int body = 0; body < mesh.bodyCount(); ++body) {
    std::vector<int> freeNodes;
    bool complete = true;
    for (int node = 0; node < mesh.vertexCount(); ++node) {
      if (mesh.bodyOfVertex(node) != body || greens.isFixed(node)) continue;
      freeNodes.push_back(node);
      complete = complete && greens.hasColumn(node);
    }
    if (complete && freeNodes.size() > 2)
      largest = std::max(largest, bodyRockingCompliance(greens, mesh, freeNodes));
  }
  return largest;
}

}  // namespace palpate
