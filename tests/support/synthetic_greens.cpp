// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/synthetic_greens.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <numeric>

namespace palpate::test {

GreensFunctionsInfo SyntheticBody::info() const {
  std::vector<unsigned char> types(nodes, 0);
  for (int node : fixed) types[node] = 1;
  GreensFunctionsInfo info;
  info.conditions = BoundaryConditions(types);
  info.material = Material(youngsModulus, 0.3);
  std::mt19937 random(seed + 1000);
  std::uniform_real_distribution<double> area(0.5, 1.5);
  info.vertexAreas.resize(nodes);
  for (int node = 0; node < nodes; ++node) info.vertexAreas[node] = area(random);
  info.columnNodes = columns;
  if (columns.empty()) {
    info.columnNodes.resize(nodes);
    std::iota(info.columnNodes.begin(), info.columnNodes.end(), 0);
  }
  info.patchColumns = patchColumns;
  info.reciprocal = reciprocal;
  return info;
}

Eigen::MatrixXd SyntheticBody::matrix() const {
  const int size = 3 * nodes;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(size, size);
  for (double& entry : matrix.reshaped()) entry = normal(random);
  if (reciprocal) matrix = ((matrix + matrix.transpose()) / std::sqrt(2.0)).eval();
  // A random matrix of unit entries has a norm of about 2 sqrt(size).
  matrix *= 0.2 / std::sqrt(double(size));
  matrix.diagonal().array() += 1;
  const GreensFunctionsInfo about = info();
  for (int node = 0; node < nodes; ++node) {
    const bool isFixed = about.conditions.isFixed(node);
    if (isFixed) matrix.middleRows<3>(3 * node) *= youngsModulus;
    if (!isFixed) matrix.middleCols<3>(3 * node) *= about.vertexAreas[node] / youngsModulus;
  }
  return matrix;
}

template <class Scalar>
std::shared_ptr<const DenseGreensFunctions<Scalar>> denseGreens(GreensFunctionsInfo info,
                                                                const Eigen::MatrixXd& matrix,
                                                                const Eigen::MatrixXd& patches) {
  const Eigen::Index rows = matrix.rows();
  AlignedBuffer<Scalar> stored(rows * 3 * info.columnNodes.size());
  Scalar* target = stored.data();
  for (int node : info.columnNodes)
    for (double entry : matrix.middleCols<3>(3 * node).reshaped())
      *target++ = static_cast<Scalar>(entry);
  AlignedBuffer<Scalar> storedPatches(patches.size());
  std::copy_n(patches.data(), patches.size(), storedPatches.data());
  return std::make_shared<DenseGreensFunctions<Scalar>>(std::move(info), std::move(stored),
                                                        std::move(storedPatches));
}

template std::shared_ptr<const DenseGreensFunctions<double>> denseGreens(GreensFunctionsInfo,
                                                                         const Eigen::MatrixXd&,
                                                                         const Eigen::MatrixXd&);
template std::shared_ptr<const DenseGreensFunctions<float>> denseGreens(GreensFunctionsInfo,
                                                                        const Eigen::MatrixXd&,
                                                                        const Eigen::MatrixXd&);

std::shared_ptr<const GreensFunctions> syntheticGreens(const SyntheticBody& body) {
  return denseGreens(body.info(), body.matrix());
}

void makeTwins(GreensFunctionsInfo& info, Eigen::MatrixXd& matrix, int a, int b, double difference,
               std::mt19937& random) {
  const int n = info.conditions.nodeCount();
  const auto noise = [&](int rows) -> Eigen::MatrixXd {
    return difference * randomVectors(3 * n, random).reshaped(rows, 9 * n / rows);
  };
  info.vertexAreas[b] = info.vertexAreas[a];
  matrix.middleCols<3>(3 * b) = matrix.middleCols<3>(3 * a) + noise(3 * n);
  matrix.middleRows<3>(3 * b) = matrix.middleRows<3>(3 * a) + noise(3);
}

Eigen::MatrixXd selection(const std::vector<ConstraintSwitch>& switches, int nodeCount) {
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(3 * nodeCount, switches.size());
  for (std::size_t k = 0; k < switches.size(); ++k)
    e.block<3, 1>(3 * switches[k].node, k) = switches[k].direction;
  return e;
}

std::vector<std::vector<ConstraintSwitch>> randomSwitches(const std::vector<int>& nodes,
                                                          std::mt19937& random) {
  std::vector<std::vector<ConstraintSwitch>> switches;
  for (int node : nodes) {
    const int count = 1 + static_cast<int>(random() % 3);
    const Eigen::Matrix3d frame =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), randomDirection(random))
            .toRotationMatrix();
    switches.emplace_back();
    for (int k = 0; k < count; ++k)
      switches.back().push_back(
          {node, (frame.col(k) + 0.4 * randomDirection(random)).normalized()});
  }
  return switches;
}

std::vector<ConstraintSwitch> flat(const std::vector<std::vector<ConstraintSwitch>>& switches) {
  std::vector<ConstraintSwitch> all;
  for (const auto& ofNode : switches) all.insert(all.end(), ofNode.begin(), ofNode.end());
  return all;
}

Eigen::MatrixXd denseMatrix(const GreensFunctions& greens) {
  std::vector<int> all(greens.nodeCount());
  std::iota(all.begin(), all.end(), 0);
  greens.requireColumns(nodeList(all));
  Eigen::MatrixXd matrix(3 * all.size(), 3 * all.size());
  greens.gather(nodeList(all), nodeList(all), matrix.data());
  return matrix;
}

BoundarySolution solveWholeSystem(const Eigen::MatrixXd& matrix,
                                  const BoundaryConditions& conditions,
                                  const BoundaryValues& values) {
  const int n = conditions.nodeCount();
  // Unknowns: v, then v_given. First the equations v - Xi v_given = 0, then what is known.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(6 * n);
  system.topLeftCorner(3 * n, 3 * n).setIdentity();
  system.topRightCorner(3 * n, 3 * n) = -matrix;
  for (int node = 0; node < n; ++node) {
    const Eigen::Vector3d given =
        values.given.size() ? Eigen::Vector3d(values.given.col(node)) : Eigen::Vector3d::Zero();
    Eigen::Matrix3Xd switched(3, 0);
    int row = 3 * n + 3 * node;
    for (std::size_t k = 0; k < values.switches.size(); ++k) {
      if (values.switches[k].node != node) continue;
      switched.conservativeResize(3, switched.cols() + 1);
      switched.rightCols<1>() = values.switches[k].direction;
      system.block<1, 3>(row, 3 * node) = values.switches[k].direction.transpose();
      right[row++] = values.prescribed[k];
    }
    // The rest of what is given lies across the switched directions.
    Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
    if (switched.cols() > 0)
      across = Eigen::HouseholderQR<Eigen::Matrix3Xd>(switched).householderQ();
    for (Eigen::Index c = switched.cols(); c < 3; ++c, ++row) {
      system.block<1, 3>(row, 3 * n + 3 * node) = across.col(c).transpose();
      right[row] = across.col(c).dot(given);
    }
  }
  const Eigen::VectorXd solved = system.partialPivLu().solve(right);
  BoundarySolution solution;
  solution.displacement = solved.head(3 * n).reshaped(3, n);
  solution.traction = solved.tail(3 * n).reshaped(3, n);
  for (int node = 0; node < n; ++node)
    if (conditions.isFixed(node)) solution.displacement.col(node).swap(solution.traction.col(node));
  return solution;
}

Eigen::Vector3d randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Eigen::Matrix3Xd randomVectors(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::Matrix3Xd vectors(3, count);
  for (double& entry : vectors.reshaped()) entry = uniform(random);
  return vectors;
}

std::vector<int> randomSubset(int total, int count, std::mt19937& random) {
  std::vector<int> all(total);
  std::iota(all.begin(), all.end(), 0);
  std::shuffle(all.begin(), all.end(), random);
  all.resize(count);
  return all;
}

}  // namespace palpate::test
