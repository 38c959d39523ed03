// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <numeric>
#include <vector>

#include "imported/imported_greens_functions.h"
#include "support/solids.h"

namespace palpate::test {

/// A reference problem of what a matrix is given of.
inline ElasticModel givenModel(
    const Shape& shape, const Place& fixed = [](auto&&) { return false; }) {
  const auto mesh = shape.sheet();
  return ElasticModel(mesh, Material(1, 0), BoundaryConditions(fixedWhere(shape, fixed)),
                      Eigen::VectorXi::Zero(mesh->triangleCount()), Domain::Given);
}

/// A frame of springs along the edges of tetrahedra, of stiffness 1 over their length: loose.
inline Eigen::MatrixXd trussStiffness(const Solid& solid) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * solid.points.cols(), solid.points.size());
  for (const auto& cell : solid.tetrahedra.colwise())
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const int a = cell[i], b = cell[j];
        const Eigen::Vector3d along = solid.points.col(a) - solid.points.col(b);
        const Eigen::Matrix3d spring = along * along.transpose() / std::pow(along.norm(), 3);
        stiffness.block<3, 3>(3 * a, 3 * a) += spring;
        stiffness.block<3, 3>(3 * b, 3 * b) += spring;
        stiffness.block<3, 3>(3 * a, 3 * b) -= spring;
        stiffness.block<3, 3>(3 * b, 3 * a) -= spring;
      }
  return stiffness;
}

/// The same numbers as entries.
inline std::vector<GivenMatrix::Entry> entriesOf(const Eigen::MatrixXd& matrix) {
  std::vector<GivenMatrix::Entry> entries;
  for (int j = 0; j < matrix.cols(); ++j)
    for (int i = 0; i < matrix.rows(); ++i)
      if (matrix(i, j) != 0) entries.emplace_back(i, j, matrix(i, j));
  return entries;
}

inline GivenMatrix given(const Eigen::MatrixXd& matrix) {
  return GivenMatrix(matrix, "test", "given");
}

inline NodeTable nodesAt(const Eigen::Matrix3Xd& points) {
  NodeTable nodes;
  nodes.points = points;
  return nodes;
}

inline std::vector<int> nodesUpTo(int count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The force compliance S_ij = Xi_ij / a_j between some nodes.
inline Eigen::MatrixXd forceCompliance(const GreensFunctions& greens,
                                       const std::vector<int>& nodes) {
  Eigen::MatrixXd compliance(3 * nodes.size(), 3 * nodes.size());
  greens.gather(nodeList(nodes), nodeList(nodes), compliance.data());
  for (std::size_t j = 0; j < nodes.size(); ++j)
    compliance.middleCols<3>(3 * j) /= greens.vertexArea(nodes[j]);
  return compliance;
}

inline bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

inline std::shared_ptr<const GreensFunctions> imported(const ElasticModel& model, MatrixKind kind,
                                                       const Eigen::MatrixXd& matrix,
                                                       const NodeTable& nodes = {},
                                                       const ImportOptions& options = {}) {
  return importGreensFunctions(model, kind, given(matrix), nodes, options).greens.take();
}

/// A frame of springs in the unit cube with a point inside, its base held.
struct Truss {
  Solid solid = kuhnBox({1, 1, 1}, {2, 2, 2});
  Eigen::MatrixXd stiffness = trussStiffness(solid);
  ElasticModel model = givenModel(boundaryOf(solid.mesh()), base);
  NodeTable nodes = nodesAt(solid.points);

  /// The rows of some vertices of its surface.
  std::vector<int> rowsOf(const std::vector<int>& vertices) const {
    std::vector<int> rows;
    for (int v : vertices)
      for (int p = 0; p < solid.points.cols(); ++p)
        if (solid.points.col(p) == model.mesh().points().col(v))
          for (int c = 0; c < 3; ++c) rows.push_back(3 * p + c);
    return rows;
  }
};

}  // namespace palpate::test
