// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/capacitance_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numeric>

#include "support/capacitance_consistency.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

TEST(CapacitanceMatrix, IsTheNegatedBlockOfTheGreensFunctionsAlongItsDirections) {
  const SyntheticBody body = someBody();
  const auto greens = syntheticGreens(body);
  std::mt19937 random(1);
  for (int count = 0; count <= body.nodes; ++count)
    expectConsistent({greens, flat(randomSwitches(randomSubset(20, count, random), random))},
                     body.matrix());
}

TEST(CapacitanceMatrix, UnknownValuesMakeTheSwitchedOnesAsPrescribed) {
  const SyntheticBody body = someBody();
  std::mt19937 random(3);
  const CapacitanceMatrix c(syntheticGreens(body),
                            flat(randomSwitches(randomSubset(20, 15, random), random)));
  const Eigen::MatrixXd e = selection(c.switches(), 20);
  const Eigen::VectorXd right = Eigen::VectorXd::Random(c.size());
  Eigen::VectorXd values(c.size());
  c.solve(right.data(), values.data());
  EXPECT_LE((e.transpose() * body.matrix() * e * values - right).norm(), kRounding * right.norm());
  EXPECT_LE((values + c.inverse() * right).norm(), kRounding * values.norm());
}

TEST(CapacitanceMatrix, IsSymmetricAsAForceComplianceWhereReciprocal) {
  const SyntheticBody body = someBody(true);
  const auto greens = syntheticGreens(body);
  const CapacitanceMatrix c(greens, switchesOfNodes({0, 1, 2, 7, 19}));
  Eigen::MatrixXd perForce = c.matrix();
  for (int k = 0; k < c.size(); ++k) perForce.col(k) /= greens->vertexArea(c.switches()[k].node);
  EXPECT_LE((perForce - perForce.transpose()).norm(), 1e-15 * perForce.norm());
}

TEST(CapacitanceMatrix, ConditionDoesNotDependOnUnits) {
  const SyntheticBody body = someBody();
  const auto greens = syntheticGreens(body);
  const auto switches = switchesOfNodes({2, 3, 4, 8, 15});  // contacts and releases
  const double condition = CapacitanceMatrix(greens, switches).condition();
  EXPECT_GE(condition, 1);
  EXPECT_NEAR(CapacitanceMatrix(greens->withYoungsModulus(2e11), switches).condition() / condition,
              1, 1e-12);
  // Lengths in millimetres: displacements per traction grow, tractions per displacement fall.
  Eigen::MatrixXd xi = body.matrix();
  GreensFunctionsInfo info = body.info();
  info.vertexAreas *= 1e6;
  for (int node = 0; node < 20; ++node) {
    if (!greens->isFixed(node)) xi.middleRows<3>(3 * node) *= 1e3;
    if (greens->isFixed(node)) xi.middleCols<3>(3 * node) /= 1e3;
  }
  EXPECT_NEAR(CapacitanceMatrix(denseGreens(info, xi), switches).condition() / condition, 1, 1e-12);
}

TEST(CapacitanceMatrix, ImpossibleSetsAreRefusedNamingTheNodes) {
  SyntheticBody body = someBody();
  body.columns = {0, 1, 2, 5, 7, 12};
  GreensFunctionsInfo info = body.info();
  Eigen::MatrixXd xi = body.matrix();
  std::mt19937 random(5);
  makeTwins(info, xi, 7, 12, 1e-15, random);
  const auto greens = denseGreens(info, xi);
  const auto make = [&](const std::vector<ConstraintSwitch>& switches) {
    return [&greens, switches] { CapacitanceMatrix(greens, switches); };
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_TRUE(isRefused(make(switchesOfNodes({0, 6})),
                        "the Green's functions of node 6 were not computed"));
  EXPECT_TRUE(isRefused(make(switchesOfNodes({0, 20})), "there is no node 20"));
  EXPECT_TRUE(isRefused(make({{1, x}, {5, 2 * x}}),
                        "the direction (2, 0, 0) of a constraint at node 5 is not a unit vector"));
  EXPECT_TRUE(isRefused(make({{1, x}, {5, x}, {5, x}}),
                        "node 5 is constrained twice along the same direction"));
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  EXPECT_TRUE(
      isRefused(make({{5, x}, {5, y}, {5, (x + y).normalized()}, {5, (x - y).normalized()}}),
                "node 5 has more than three constraints"));
  EXPECT_TRUE(isRefused([&] { CapacitanceMatrix(greens, -1); },
                        "the capacity of a capacitance matrix must be at least 0, not -1"));
  EXPECT_TRUE(isRefused<std::runtime_error>(make({{2, x}, {0, x}, {0, -x}}),
                                            "those of node 0 depend on each other"));
  const std::vector<int> order = {1, 12, 0, 7, 5};
  for (const auto& switches : {switchesOfNodes(order), switchesOfNodes({7, 12})}) {
    EXPECT_TRUE(isRefused<std::runtime_error>(
        make(switches), "the constraints cannot be told apart (condition number "));
    EXPECT_TRUE(
        isRefused<std::runtime_error>(make(switches), "of the capacitance matrix): nodes "));
    EXPECT_TRUE(isRefused<std::runtime_error>(make(switches), " 7 "));
    EXPECT_TRUE(isRefused<std::runtime_error>(make(switches), " 12 "));
  }
}

TEST(CapacitanceMatrix, ConditionOfNearTwinsIsReportedAndTheyAreNamed) {
  for (double difference : {1e-3, 1e-6, 1e-9}) {
    const SyntheticBody body = someBody();
    GreensFunctionsInfo info = body.info();
    Eigen::MatrixXd xi = body.matrix();
    std::mt19937 random(6);
    makeTwins(info, xi, 7, 12, difference, random);
    const CapacitanceMatrix c(denseGreens(info, xi), switchesOfNodes({0, 12, 1, 5, 7, 19}));
    EXPECT_GT(c.condition(), 0.1 / difference);
    EXPECT_LT(c.condition(), 1e4 / difference);
    const auto [a, b] = c.weakestPair();
    EXPECT_EQ(std::minmax(a, b), std::minmax(7, 12));
  }
}

TEST(CapacitanceMatrix, CopiesAreIndependent) {
  const SyntheticBody body = someBody();
  CapacitanceMatrix c(syntheticGreens(body), switchesOfNodes({2, 3, 9}), 15);
  CapacitanceMatrix copy(c);
  EXPECT_EQ(copy.inverse(), c.inverse());
  EXPECT_EQ(copy.capacity(), 15);
  EXPECT_TRUE(copy.add(switchesOfNodes({4}).data(), 3).done);
  EXPECT_TRUE(copy.removeNode(2));
  expectConsistent(copy, body.matrix());
  EXPECT_EQ(c.size(), 9);
  expectConsistent(c, body.matrix());
}

}  // namespace
}  // namespace palpate::test
