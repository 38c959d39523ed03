// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/LU>
#include <random>

#include "identification/robust_statistics.h"
#include "progress.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// y = a + b x at x = 0, 0.1, ...
LeastSquaresProblem line(const Eigen::VectorXd& y) {
  LeastSquaresProblem problem;
  problem.start.setZero(2);
  problem.lower.setConstant(2, -kInfinity);
  problem.upper.setConstant(2, kInfinity);
  problem.groups = static_cast<int>(y.size()) / 3;
  problem.evaluate = [y](const Eigen::VectorXd& p, Eigen::VectorXd& residuals,
                         Eigen::MatrixXd* jacobian) {
    residuals.resize(y.size());
    if (jacobian) jacobian->resize(y.size(), 2);
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      residuals[i] = p[0] + p[1] * 0.1 * i - y[i];
      if (jacobian) jacobian->row(i) << 1, 0.1 * i;
    }
  };
  return problem;
}

Eigen::VectorXd onLine(int count) {
  Eigen::VectorXd y(count);
  for (int i = 0; i < count; ++i) y[i] = 2 - 3 * 0.1 * i;
  return y;
}

TEST(LeastSquares, ALineIsFoundWithTheCovarianceOfItsNormalEquations) {
  const LeastSquaresProblem problem = line(onLine(12));
  const LeastSquaresSolution solution = solveLeastSquares(problem);
  EXPECT_NEAR(solution.parameters[0], 2, 1e-9);
  EXPECT_NEAR(solution.parameters[1], -3, 1e-9);
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  problem.evaluate(solution.parameters, residuals, &jacobian);
  const Eigen::MatrixXd expected = (jacobian.transpose() * jacobian).inverse();
  EXPECT_LE((solution.covariance - expected).norm(), 1e-10 * expected.norm());
}

TEST(LeastSquares, ACurvedValleyIsFollowedToItsEnd) {
  LeastSquaresProblem problem = line(Eigen::VectorXd::Zero(3));
  problem.start << -1.2, 1;
  problem.evaluate = [](const Eigen::VectorXd& p, Eigen::VectorXd& residuals,
                        Eigen::MatrixXd* jacobian) {
    residuals = Eigen::Vector3d(10 * (p[1] - p[0] * p[0]), 1 - p[0], 0);
    if (!jacobian) return;
    jacobian->setZero(3, 2);
    *jacobian << -20 * p[0], 10, -1, 0, 0, 0;
  };
  const LeastSquaresSolution solution = solveLeastSquares(problem);
  EXPECT_NEAR(solution.parameters[0], 1, 1e-6);
  EXPECT_NEAR(solution.parameters[1], 1, 1e-6);
}

TEST(LeastSquares, ABoundHoldsAndTheCovarianceIsWithoutIt) {
  LeastSquaresProblem problem = line(onLine(12));
  problem.lower[1] = -1;
  const LeastSquaresSolution solution = solveLeastSquares(problem);
  EXPECT_DOUBLE_EQ(solution.parameters[1], -1);
  EXPECT_EQ(solution.heldCovariance(1, 1), 0);
  EXPECT_NEAR(solution.heldCovariance(0, 0), 1.0 / 12, 1e-12);
  const Eigen::MatrixXd free = solveLeastSquares(line(onLine(12))).covariance;
  EXPECT_LE((solution.covariance - free).norm(), 1e-12);
}

TEST(LeastSquares, RobustLossesPassOverGrossErrors) {
  Eigen::VectorXd y = onLine(60);
  y.segment<3>(30).setConstant(50);
  LeastSquaresProblem problem = line(y);
  EXPECT_GT((solveLeastSquares(problem).parameters - Eigen::Vector2d(2, -3)).norm(), 0.5);
  problem.scale = 1e-3;
  for (RobustLoss loss : {RobustLoss::Huber, RobustLoss::Cauchy}) {
    problem.loss = loss;
    EXPECT_LE((solveLeastSquares(problem).parameters - Eigen::Vector2d(2, -3)).norm(), 1e-3);
  }
}

TEST(LeastSquares, WhatIsNotSeenHasNoCovarianceButAName) {
  LeastSquaresProblem problem = line(onLine(12));
  problem.evaluate = [](const Eigen::VectorXd& p, Eigen::VectorXd& residuals,
                        Eigen::MatrixXd* jacobian) {
    residuals.setConstant(12, p[0] + p[1] - 1);
    if (jacobian) jacobian->setOnes(12, 2);
  };
  const LeastSquaresSolution solution = solveLeastSquares(problem);
  EXPECT_EQ(solution.covariance.size(), 0);
  EXPECT_NEAR(std::abs(solution.weakest[0]), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(solution.weakest[0] + solution.weakest[1], 0, 1e-9);
}

TEST(LeastSquares, ResidualsThatAreNotFiniteAreNoSolution) {
  LeastSquaresProblem problem = line(onLine(12));
  problem.evaluate = [](const Eigen::VectorXd&, Eigen::VectorXd& residuals,
                        Eigen::MatrixXd* jacobian) {
    residuals.setConstant(12, std::nan(""));
    if (jacobian) jacobian->setOnes(12, 2);
  };
  EXPECT_THROW(solveLeastSquares(problem), std::runtime_error);
}

TEST(LeastSquares, AbortsAndPassesOnWhatIsThrown) {
  LeastSquaresProblem problem = line(onLine(12));
  problem.goOn = [] { return false; };
  EXPECT_THROW(solveLeastSquares(problem), Aborted);
  problem = line(onLine(12));
  problem.evaluate = [](const Eigen::VectorXd&, Eigen::VectorXd&, Eigen::MatrixXd*) {
    throw std::out_of_range("from within");
  };
  EXPECT_TRUE(isRefused<std::out_of_range>([&] { solveLeastSquares(problem); }, "from within"));
}

TEST(LeastSquares, LossesHaveNames) {
  EXPECT_EQ(robustLossNamed("cauchy"), RobustLoss::Cauchy);
  EXPECT_TRUE(isRefused([] { robustLossNamed("l1"); }, "there is no loss 'l1': choose one of"));
}

TEST(RobustStatistics, QuantilesAreThoseOfTables) {
  EXPECT_NEAR(chiSquaredOf(0.05), 7.814727903251178, 1e-9);
  EXPECT_NEAR(chiSquaredOf(1e-3), 16.26623619623813, 1e-9);
}

TEST(RobustStatistics, AThirdOfWrongValuesChangesTheDeviationLittle) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 2);
  std::vector<double> sizes;
  for (int i = 0; i < 20000; ++i) sizes.push_back(std::abs(normal(random)));
  EXPECT_NEAR(medianDeviation(sizes), 2, 0.05);  // known to 1 %
  for (int i = 0; i < 6000; ++i) sizes[3 * i] = 1e6;
  EXPECT_LT(medianDeviation(sizes), 4);
}

}  // namespace
}  // namespace palpate::test
