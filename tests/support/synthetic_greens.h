// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <random>
#include <vector>

#include "contact/capacitance_solver.h"
#include "greens/dense_greens_functions.h"

namespace palpate::test {

/// Green's functions of a made-up body, for tests of algebra alone.
struct SyntheticBody {
  int nodes = 12;
  std::vector<int> fixed = {};
  std::vector<int> columns = {};  ///< stored columns in order; all nodes if empty
  std::vector<PatchColumn> patchColumns = {};
  double youngsModulus = 1;
  bool reciprocal = false;  ///< symmetric force compliance between free nodes
  unsigned seed = 1;

  /// With random vertex areas between 0.5 and 1.5.
  GreensFunctionsInfo info() const;

  /// 3 #nodes by 3 #nodes: the identity and a random part of norm below one half, times the areas
  /// of free columns, so that any set of constraints is well-conditioned. In units of E: 1/E
  /// between free, E between fixed nodes.
  Eigen::MatrixXd matrix() const;
};

/// Stores the columns that `info` names of a 3 #nodes by 3 #nodes matrix.
template <class Scalar = double>
std::shared_ptr<const DenseGreensFunctions<Scalar>> denseGreens(
    GreensFunctionsInfo info, const Eigen::MatrixXd& matrix,
    const Eigen::MatrixXd& patchMatrix = {});

std::shared_ptr<const GreensFunctions> syntheticGreens(const SyntheticBody& body);

/// Makes free node b respond as free node a does but for a random difference, as two nodes
/// at nearly the same place.
void makeTwins(GreensFunctionsInfo& info, Eigen::MatrixXd& matrix, int a, int b, double difference,
               std::mt19937& random);

/// Xi[all rows, columns of all nodes].
Eigen::MatrixXd denseMatrix(const GreensFunctions& greens);

/// E, whose columns are node times direction.
Eigen::MatrixXd selection(const std::vector<ConstraintSwitch>& switches, int nodeCount);

/// One to three directions at each of some nodes, in general not at right angles.
std::vector<std::vector<ConstraintSwitch>> randomSwitches(const std::vector<int>& nodes,
                                                          std::mt19937& random);

/// All of them in one list.
std::vector<ConstraintSwitch> flat(const std::vector<std::vector<ConstraintSwitch>>& switches);

/// Solves a boundary value problem as one dense system of the 6n nodal values: v = Xi v_given, with
/// the switched components of the two given the other way round.
/// @param matrix  Xi, 3 #nodes by 3 #nodes.
BoundarySolution solveWholeSystem(const Eigen::MatrixXd& matrix,
                                  const BoundaryConditions& conditions,
                                  const BoundaryValues& values);

/// A unit vector, evenly distributed.
Eigen::Vector3d randomDirection(std::mt19937& random);

/// 3 by `count` components in [-1, 1].
Eigen::Matrix3Xd randomVectors(int count, std::mt19937& random);

/// `count` of 0 .. total - 1, in random order.
std::vector<int> randomSubset(int total, int count, std::mt19937& random);

/// |a - b| / |b|, Frobenius.
template <class A, class B>
double relativeDifference(const A& a, const B& b) {
  return (a - b).norm() / b.norm();
}

}  // namespace palpate::test
