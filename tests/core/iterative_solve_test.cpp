// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/iterative_solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/LU>
#include <numeric>
#include <random>

#include "bem/exchanged_system.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

/// Diagonal blocks of different size, far apart from their rows' numbers, and some noise.
struct System {
  explicit System(int blocks, int columnCount, int gap = 5)
      : size(3 * blocks), columns(columnCount), stride(size + gap), rows(size) {
    std::iota(rows.begin(), rows.end(), 0);
    std::shuffle(rows.begin(), rows.end(), std::mt19937(1));
    std::srand(1);
    Eigen::MatrixXd noise = Eigen::MatrixXd::Random(size, size) * (0.5 / std::sqrt(size));
    a.resize(size, size);
    for (int r = 0; r < size; ++r) {
      noise(r, r) += 1;
      const double scale = std::exp2((r / 3) % 5 - 2);
      a.row(rows[r]) = scale * noise.row(r);
    }
    b = Eigen::MatrixXd::Random(size, columns);
    matrix = AlignedBuffer<double>(std::size_t(stride) * size);
    right = AlignedBuffer<double>(std::size_t(stride) * std::max(columns, 1));
    std::fill_n(matrix.data(), matrix.size(), 1e300);  // what lies between columns is not looked at
    view(matrix, size) = a;
    view(right, columns) = b;
  }
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> view(const AlignedBuffer<double>& buffer,
                                                            int count) const {
    return {const_cast<double*>(buffer.data()), size, count, Eigen::OuterStride<>(stride)};
  }
  SolveReport solve(const IterativeSettings& settings = {}, const Progress& progress = {}) {
    return solveIterativeInPlace(matrix, size, stride, rows, right, columns, settings, progress);
  }
  int size, columns, stride;
  std::vector<int> rows;
  Eigen::MatrixXd a, b;
  AlignedBuffer<double> matrix, right;
};

TEST(IterativeSolve, MeetsItsToleranceForEveryRightHandSide) {
  for (int columns : {0, 1, 7, 64, 65, 150})
    for (double tolerance : {1e-3, 1e-6, 1e-10}) {
      System system(40, columns);
      IterativeSettings settings;
      settings.tolerance = tolerance;
      const SolveReport report = system.solve(settings);
      EXPECT_LE(report.residual, tolerance);
      const Eigen::MatrixXd x = system.view(system.right, columns);
      double worst = 0;
      for (int c = 0; c < columns; ++c)
        worst = std::max(worst,
                         (system.a * x.col(c) - system.b.col(c)).norm() / system.b.col(c).norm());
      EXPECT_NEAR(worst, report.residual, 1e-12);
      EXPECT_EQ(report.refinementSteps > 0, columns > 0);
      EXPECT_EQ(system.view(system.matrix, system.size), system.a) << "the matrix is kept";
    }
}

TEST(IterativeSolve, SolvesARightHandSideOfZerosAndOneThatIsAColumn) {
  System system(20, 3);
  system.view(system.right, 3).col(0).setZero();
  system.view(system.right, 3).col(1) = system.a.col(4);
  system.solve();
  const Eigen::MatrixXd x = system.view(system.right, 3);
  EXPECT_EQ(x.col(0).norm(), 0);
  EXPECT_LT((x.col(1) - Eigen::VectorXd::Unit(60, 4)).norm(), 1e-7);
}

TEST(IterativeSolve, GoesOnWhereItRestarts) {
  System system(60, 4), whole(60, 4);
  IterativeSettings few;
  few.restart = 5;
  const SolveReport restarted = system.solve(few), kept = whole.solve();
  EXPECT_LE(restarted.residual, few.tolerance);
  EXPECT_GT(restarted.refinementSteps, kept.refinementSteps);
}

TEST(IterativeSolve, RefusesWhatItCannotReach) {
  System system(60, 2);
  IterativeSettings settings;
  settings.mostProducts = 3;
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { system.solve(settings); }, "direct solver"));
  System singular(20, 2);
  for (int j = 0; j < 3; ++j) singular.view(singular.matrix, 60)(singular.rows[6], 6 + j) = 0;
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { singular.solve(); }, "unknown 2"));
}

TEST(IterativeSolve, StopsOnRequest) {
  System system(40, 5);
  EXPECT_THROW(system.solve({}, Progress([](double, const char*) { return false; })), Aborted);
}

class BoundaryElementSystem : public testing::TestWithParam<Collocation> {};

TEST_P(BoundaryElementSystem, IsSolvedInFewProducts) {
  for (double poissonRatio : {0.3, 0.49})
    for (int shape = 0; shape < 2; ++shape) {
      const bool isSphere = shape == 0;
      const ElasticModel model =
          isSphere ? makeModel(icosphere(3), cap, 1e4, poissonRatio)
                   : makeModel(
                         box({1, 1, 1}, {6, 6, 6}),
                         [](const Eigen::Vector3d& x) { return x.z() == 0; }, 1e4, poissonRatio);
      BoundaryElementOptions options;
      options.collocation = GetParam();
      options.columns = {model.conditions().freeNodes().back()};
      const auto direct = computeGreens(model, options);
      options.solver = LinearSolver::Iterative;
      const auto iterative = computeGreens(model, options);
      const Eigen::VectorXi node = Eigen::VectorXi::Constant(1, options.columns[0]);
      Eigen::VectorXd one = Eigen::VectorXd::Zero(3 * model.mesh().vertexCount()), other = one;
      direct->accumulate(node, Eigen::Vector3d(1, 2, 3), one);
      iterative->accumulate(node, Eigen::Vector3d(1, 2, 3), other);
      // The residual of 1e-9 times the condition number, some 1e3.
      EXPECT_LT((one - other).norm(), 1e-6 * one.norm()) << poissonRatio << " " << shape;
      EXPECT_LE(iterative->info().diagnostics.solverResidual, 1e-9);
      EXPECT_EQ(iterative->info().diagnostics.conditionEstimate, -1);
      EXPECT_NE(iterative->info().source.find("iterative"), std::string::npos);
    }
}
INSTANTIATE_TEST_SUITE_P(Of, BoundaryElementSystem,
                         testing::Values(Collocation::Averaged, Collocation::Vertex));

TEST(BoundaryElements, RefuseToIterateInFloat) {
  const ElasticModel model = makeModel(icosphere(1), cap, 1e4, 0.3);
  BoundaryElementOptions options;
  options.solver = LinearSolver::Iterative;
  for (Precision precision : {Precision::Float, Precision::Mixed}) {
    options.precision = precision;
    EXPECT_TRUE(isRefused<std::invalid_argument>([&] { computeGreens(model, options); }, "double"));
  }
}

}  // namespace
}  // namespace palpate::test
