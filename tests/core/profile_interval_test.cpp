// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/profile_interval.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/interval_coverage.h"

namespace palpate::test {
namespace {

// An end is found to 0.5 % of the quantile.
constexpr double kEnd = 0.006;

/// y_i = sum of J_ij p_j, measured with deviation 1.
LeastSquaresProblem linear(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& y) {
  LeastSquaresProblem problem;
  problem.start.setZero(jacobian.cols());
  problem.lower.setConstant(jacobian.cols(), -INFINITY);
  problem.upper = -problem.lower;
  problem.groups = static_cast<int>(y.size()) / 3;
  problem.evaluate = [=](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r = jacobian * p - y;
    if (j) *j = jacobian;
  };
  return problem;
}

Eigen::MatrixXd skewed() {
  Eigen::MatrixXd jacobian(6, 2);
  jacobian << 1, 0.5, 1, 1, 1, 1.5, 1, 2, 1, 2.5, 1, 3;
  return jacobian;
}

TEST(ProfileInterval, OfLinearResidualsIsOfTheStandardDeviation) {
  const LeastSquaresProblem problem =
      linear(skewed(), (Eigen::VectorXd(6) << 2, 1, 3, 2, 5, 4).finished());
  const LeastSquaresSolution solution = solveLeastSquares(problem);
  for (const Eigen::Vector2d& combination :
       {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1)}) {
    const double middle = combination.dot(solution.parameters),
                 reach = kNormal95 * std::sqrt(combination.dot(solution.covariance * combination));
    const Interval interval = profileInterval(problem, solution, combination);
    EXPECT_NEAR(interval.lower, middle - reach, kEnd * reach);
    EXPECT_NEAR(interval.upper, middle + reach, kEnd * reach);
  }
}

TEST(ProfileInterval, FollowsCurvedResiduals) {
  LeastSquaresProblem problem = linear(Eigen::MatrixXd::Ones(3, 1), Eigen::VectorXd::Zero(3));
  problem.evaluate = [](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r = Eigen::Vector3d(std::exp(p[0]) - 5, 0, 0);
    if (j) *j = Eigen::Vector3d(std::exp(p[0]), 0, 0);
  };
  const Interval interval =
      profileInterval(problem, solveLeastSquares(problem), Eigen::VectorXd::Ones(1));
  EXPECT_NEAR(std::exp(interval.lower), 5 - kNormal95, kEnd * kNormal95);
  EXPECT_NEAR(std::exp(interval.upper), 5 + kNormal95, kEnd * kNormal95);
}

// The sum of squares above that at the bound, of which the slope is not zero.
TEST(ProfileInterval, ReachesFromABoundToWhatTheDataAllow) {
  constexpr double kBeyond = 0.7, kBound = 1;
  LeastSquaresProblem problem = linear(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(kBound, 0, 0));
  problem.upper[0] = kBound - kBeyond;
  const Interval interval =
      profileInterval(problem, solveLeastSquares(problem), Eigen::VectorXd::Ones(1));
  EXPECT_DOUBLE_EQ(interval.upper, problem.upper[0]);
  EXPECT_NEAR(interval.lower, kBound - std::sqrt(kNormal95 * kNormal95 + kBeyond * kBeyond),
              kEnd * kNormal95);
}

TEST(ProfileInterval, EndsAtBoundsWhereTheDataAllowMore) {
  LeastSquaresProblem problem = linear(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.5, 0, 0));
  problem.lower[0] = -0.25;
  problem.upper[0] = 1.5;
  const Interval interval =
      profileInterval(problem, solveLeastSquares(problem), Eigen::VectorXd::Ones(1));
  EXPECT_DOUBLE_EQ(interval.lower, -0.25);
  EXPECT_DOUBLE_EQ(interval.upper, 1.5);
}

// Of a parameter at its bound the others' intervals take no more than the bound leaves it.
TEST(ProfileInterval, OfOneParameterKnowsTheBoundsOfOthers) {
  LeastSquaresProblem problem =
      linear(skewed(), (Eigen::VectorXd(6) << 2, 1, 3, 2, 5, 4).finished());
  const LeastSquaresSolution free = solveLeastSquares(problem);
  problem.lower[1] = problem.upper[1] = free.parameters[1];
  problem.lower[1] -= 1e-6;
  const LeastSquaresSolution held = solveLeastSquares(problem);
  const Interval interval = profileInterval(problem, held, Eigen::Vector2d::UnitX());
  const double reach = kNormal95 / std::sqrt(6.0);
  EXPECT_NEAR(interval.upper - interval.lower, 2 * reach, 2 * kEnd * reach);
}

TEST(ProfileInterval, OfMaterialsNearABoundHoldsTheTruthAsOftenAsItSays) {
  constexpr int kSets = 60;
  BentBar bar(0.48, false);
  int bounds = 0;
  std::vector<int> covered(2, 0);
  const std::vector<double> truth = bar.truth();
  for (unsigned set = 1; set <= kSets; ++set) {
    const MaterialIdentification result = bar.identified(set);
    bounds += result.parameters[1].isAtBound;
    for (int i = 0; i < 2; ++i) {
      const IdentifiedParameter& p = result.parameters[i];
      covered[i] += p.lower <= truth[i] && truth[i] <= p.upper;
      EXPECT_GT(p.deviation, 0);
      EXPECT_LT(p.lower, p.upper);
    }
  }
  EXPECT_GT(bounds, 0) << "else nothing is seen of bounds";
  for (int count : covered) EXPECT_GE(count, 46);  // less of a binomial of 90 %: 7e-4
}

}  // namespace
}  // namespace palpate::test
