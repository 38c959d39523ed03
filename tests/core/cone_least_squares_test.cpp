// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/cone_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <stdexcept>

namespace palpate {
namespace {

/// Loads of random axes that random values are seen of.
struct Problem {
  Problem(int values, int count, double friction, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto draw = [&] { return normal(random); };
    loads.friction = friction;
    loads.response = Eigen::MatrixXd::NullaryExpr(values, 3 * count, draw);
    loads.axes = Eigen::Matrix3Xd::NullaryExpr(3, count, draw);
    loads.axes.colwise().normalize();
    data = 10 * Eigen::VectorXd::NullaryExpr(values, draw);
  }
  Eigen::VectorXd residual(const ConeFit& fit) const {
    Eigen::VectorXd residual = data;
    for (int k = 0; k < loads.count(); ++k)
      residual -= loads.response.middleCols<3>(3 * k) * fit.force(k);
    return residual;
  }
  ConeLoads loads;
  Eigen::VectorXd data;
};

TEST(ConeLeastSquares, OptimalityHolds) {
  for (double friction : {0.0, 0.3, 1.0})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Problem problem(40, 25, friction, seed);
      const ConeFit fit = fitInCones(problem.loads, problem.data, 1e-7);
      ASSERT_TRUE(fit.isSettled);
      const Eigen::VectorXd residual = problem.residual(fit);
      EXPECT_NEAR(residual.squaredNorm(), fit.squares, 1e-9 * problem.data.squaredNorm());
      for (int k = 0; k < problem.loads.count(); ++k) {
        const Eigen::Vector3d axis = problem.loads.axes.col(k), force = fit.force(k),
                              gradient = problem.loads.response.middleCols<3>(3 * k).transpose() *
                                         residual;
        const double normal = force.dot(axis);
        EXPECT_GE(normal, 0);
        EXPECT_LE((force - normal * axis).norm(), friction * normal + 1e-12);
        // Of no ray of the cone does the sum get less, and the force is at right angles.
        const double along = gradient.dot(axis), across = (gradient - along * axis).norm();
        EXPECT_LE(along + friction * across, 1e-5 * problem.data.norm());
        EXPECT_NEAR(gradient.dot(force), 0, 1e-5 * problem.data.norm() * (1 + force.norm()));
      }
    }
}

TEST(ConeLeastSquares, ForcesWithinTheConesAreFoundExactly) {
  Problem problem(60, 10, 0.5, 7);
  const Eigen::Vector3d axis = problem.loads.axes.col(4),
                        force = 2 * axis + 0.4 * axis.unitOrthogonal();
  problem.data = problem.loads.response.middleCols<3>(12) * force;
  const ConeFit fit = fitInCones(problem.loads, problem.data, 1e-9);
  EXPECT_LT((fit.force(4) - force).norm(), 1e-6);
  EXPECT_LT(fit.squares, 1e-10);
  EXPECT_LE(fit.freedom(0.5), 3 * static_cast<int>(fit.loads().size()));
}

TEST(ConeLeastSquares, PullsAreNotExplained) {
  Problem problem(60, 1, 0.5, 3);
  problem.data = -problem.loads.response * problem.loads.axes.col(0);
  const ConeFit fit = fitInCones(problem.loads, problem.data, 1e-9);
  EXPECT_TRUE(fit.rays.empty());
  EXPECT_EQ(fit.squares, problem.data.squaredNorm());
}

TEST(ConeLeastSquares, LoadsThatAreTheSameShareTheForceInFiniteTime) {
  Problem problem(30, 6, 0.5, 5);
  problem.loads.axes.colwise() = Eigen::Vector3d::UnitZ();
  for (int k = 1; k < 6; ++k)
    problem.loads.response.middleCols<3>(3 * k) = problem.loads.response.leftCols<3>();
  problem.data = problem.loads.response.leftCols<3>() * Eigen::Vector3d(0.1, 0, 1);
  const ConeFit fit = fitInCones(problem.loads, problem.data, 1e-9);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 6; ++k) sum += fit.force(k);
  EXPECT_LT((sum - Eigen::Vector3d(0.1, 0, 1)).norm(), 1e-6);
}

TEST(ConeLeastSquares, RefusesSizesThatDoNotGoTogether) {
  const Problem problem(30, 6, 0.5, 5);
  EXPECT_THROW(fitInCones(problem.loads, Eigen::VectorXd::Ones(29), 1e-9), std::invalid_argument);
}

}  // namespace
}  // namespace palpate
