// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/reciprocity.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "mesh/surface_mesh.h"

namespace palpate {

template <class Scalar>
double makeReciprocal(Scalar* matrix, const BoundaryConditions& conditions,
                      const Eigen::VectorXd& areas, const std::vector<int>& columnNodes,
                      bool symmetrise) {
  using Block = Eigen::Map<Eigen::Matrix<Scalar, 3, 3>, 0, Eigen::OuterStride<>>;
  const Eigen::Index rows = 3 * Eigen::Index(areas.size());
  std::vector<int> columns;
  for (std::size_t c = 0; c < columnNodes.size(); ++c)
    if (!conditions.isFixed(columnNodes[c])) columns.push_back(static_cast<int>(c));
  const auto block = [&](int row, int column) {
    return Block(matrix + 3 * columnNodes[row] + 3 * rows * column, Eigen::OuterStride<>(rows));
  };

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
  return all > 0 ? std::sqrt(antisymmetric / all) : 0;
}

template double makeReciprocal(double*, const BoundaryConditions&, const Eigen::VectorXd&,
                               const std::vector<int>&, bool);
template double makeReciprocal(float*, const BoundaryConditions&, const Eigen::VectorXd&,
                               const std::vector<int>&, bool);

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
