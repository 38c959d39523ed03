// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// CapacitanceMatrix::add, removeNode and what keeps its inverse accurate.

#include <gtest/gtest.h>

#include <limits>

#include "support/allocation_count.h"
#include "support/capacitance_consistency.h"

namespace palpate::test {
namespace {

CapacitanceMatrix::Addition add(CapacitanceMatrix& matrix,
                                const std::vector<ConstraintSwitch>& switches) {
  return matrix.add(switches.data(), static_cast<int>(switches.size()));
}

CapacitanceMatrix::Addition addNode(CapacitanceMatrix& matrix, int node) {
  return add(matrix, switchesOfNodes({node}));
}

TEST(CapacitanceUpdates, NodesAddedAndRemovedInAnyOrderGiveTheMatrixOfTheWholeSet) {
  const SyntheticBody body = someBody();
  const auto greens = syntheticGreens(body);
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    CapacitanceMatrix c(greens, 60);
    auto switches = randomSwitches(randomSubset(20, 20, random), random);
    for (const auto& ofNode : switches) {
      const auto addition = add(c, ofNode);
      ASSERT_TRUE(addition.done);
      EXPECT_GT(addition.pivot, 0.01);
      expectConsistent(c, body.matrix());
    }
    EXPECT_EQ(c.size(), int(flat(switches).size()));
    std::shuffle(switches.begin(), switches.end(), random);
    while (!switches.empty()) {
      const int node = switches.back()[0].node;
      EXPECT_TRUE(c.contains(node));
      EXPECT_TRUE(c.removeNode(node));
      EXPECT_FALSE(c.contains(node));
      switches.pop_back();
      EXPECT_EQ(c.size(), int(flat(switches).size()));
      expectConsistent(c, body.matrix());
    }
    EXPECT_EQ(c.refactorisations(), 0) << "by updates alone";
  }
}

TEST(CapacitanceUpdates, DirectionsOfOneNodeMayBeAddedOneByOne) {
  const SyntheticBody body = someBody();
  CapacitanceMatrix c(syntheticGreens(body), 12);
  for (int direction = 0; direction < 3; ++direction)
    for (int node : {5, 3, 9}) EXPECT_TRUE(add(c, {{node, Eigen::Vector3d::Unit(direction)}}).done);
  expectConsistent(c, body.matrix());
  EXPECT_FALSE(add(c, {{5, Eigen::Vector3d(1, 1, 1).normalized()}}).done);
  EXPECT_TRUE(c.removeNode(3));
  EXPECT_EQ(c.size(), 6);
  expectConsistent(c, body.matrix());
}

TEST(CapacitanceUpdates, WhatCannotBeAddedChangesNothing) {
  SyntheticBody body = someBody();
  body.columns = {0, 1, 2, 3, 4, 5, 6};
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  CapacitanceMatrix c(syntheticGreens(body), 7);
  ASSERT_TRUE(addNode(c, 2).done);
  ASSERT_TRUE(addNode(c, 5).done);
  const Eigen::MatrixXd before = c.inverse();
  const auto expectRefused = [&](const std::vector<ConstraintSwitch>& switches) {
    const auto addition = add(c, switches);
    EXPECT_FALSE(addition.done);
    EXPECT_EQ(addition.pivot, 0);
    EXPECT_EQ(addition.nearestNode, -1);
    EXPECT_EQ(c.size(), 6);
    EXPECT_EQ(c.inverse(), before);
  };
  expectRefused(switchesOfNodes({6}));  // beyond the capacity
  expectRefused({});                    // nothing
  expectRefused({{7, x}});              // without column
  expectRefused({{20, x}});             // out of range
  expectRefused({{-1, x}});
  expectRefused({{6, 2 * x}});  // not a unit vector
  expectRefused({{6, Eigen::Vector3d::Zero()}});
  expectRefused({{6, x * std::nan("")}});
  expectRefused({{2, (x + y).normalized()}});  // a fourth direction
  EXPECT_TRUE(add(c, {{6, x}}).done);
  EXPECT_EQ(c.capacity(), 7);
}

TEST(CapacitanceUpdates, SwitchesOfTwoNodesAtOnceAreNotAdded) {
  CapacitanceMatrix c(syntheticGreens(someBody()), 9);
  EXPECT_FALSE(add(c, {{1, Eigen::Vector3d::UnitX()}, {2, Eigen::Vector3d::UnitX()}}).done);
  EXPECT_EQ(c.size(), 0);
}

TEST(CapacitanceUpdates, ADependentNodeIsNotAddedAndItsTwinIsNamed) {
  const SyntheticBody body = someBody();
  GreensFunctionsInfo info = body.info();
  Eigen::MatrixXd xi = body.matrix();
  std::mt19937 random(4);
  makeTwins(info, xi, 7, 12, 0, random);
  CapacitanceMatrix c(denseGreens(info, xi), 30);
  for (int node : {1, 7, 9}) ASSERT_TRUE(addNode(c, node).done);
  const auto twin = addNode(c, 12);
  EXPECT_FALSE(twin.done);
  EXPECT_LT(twin.pivot, CapacitanceMatrix::kSmallestPivot);
  EXPECT_EQ(twin.nearestNode, 7);
  EXPECT_EQ(c.size(), 9);
  EXPECT_TRUE(c.removeNode(7));
  EXPECT_TRUE(addNode(c, 12).done) << "alone it is as good as its twin";
  // The same for a direction that the node has already.
  EXPECT_TRUE(add(c, {{0, Eigen::Vector3d::UnitX()}}).done);
  const auto again = add(c, {{0, -Eigen::Vector3d::UnitX()}});
  EXPECT_FALSE(again.done);
  EXPECT_EQ(again.nearestNode, 0);
}

TEST(CapacitanceUpdates, AContactThatAloneHoldsAReleasedNodeIsNotRemoved) {
  // Node 3's traction does not respond to its own displacement, as in a body that hangs on it.
  const SyntheticBody body = someBody();
  Eigen::MatrixXd xi = body.matrix();
  xi.block<3, 3>(9, 9).setZero();
  CapacitanceMatrix c(denseGreens(body.info(), xi), {switchesOfNodes({8, 3})});
  expectConsistent(c, xi);
  const Eigen::MatrixXd before = c.inverse();
  EXPECT_FALSE(c.removeNode(8));
  EXPECT_EQ(c.size(), 6);
  EXPECT_TRUE(c.contains(8));
  expectConsistent(c, xi);
  EXPECT_TRUE(c.removeNode(3));
  EXPECT_TRUE(c.removeNode(8));
  EXPECT_EQ(c.size(), 0);
}

TEST(CapacitanceUpdates, RemovingANearTwinLeavesNoDamageBehind) {
  const SyntheticBody body = someBody();
  GreensFunctionsInfo info = body.info();
  Eigen::MatrixXd xi = body.matrix();
  std::mt19937 random(7);
  makeTwins(info, xi, 7, 12, 1e-10, random);
  CapacitanceMatrix c(denseGreens(info, xi), 60);
  for (int node : {0, 7, 1, 12, 2, 5}) ASSERT_TRUE(addNode(c, node).done);
  // Other nodes come and go while the two are there.
  EXPECT_TRUE(c.removeNode(1));
  EXPECT_TRUE(c.removeNode(0));
  EXPECT_TRUE(addNode(c, 9).done);
  EXPECT_TRUE(c.removeNode(7));
  EXPECT_GT(c.refactorisations(), 0);
  expectConsistent(c, xi);
}

TEST(CapacitanceUpdates, UpdatesSolvesAndDeformationSumsNeitherAllocateNorThrow) {
  static_assert(noexcept(std::declval<CapacitanceMatrix&>().add(nullptr, 1)));
  static_assert(noexcept(std::declval<CapacitanceMatrix&>().removeNode(1)));
  static_assert(noexcept(std::declval<const CapacitanceMatrix&>().solve(nullptr, nullptr)));
  ASSERT_TRUE(allocationsAreCounted());
  const SyntheticBody body = someBody();
  GreensFunctionsInfo info = body.info();
  Eigen::MatrixXd xi = body.matrix();
  std::mt19937 random(8);
  makeTwins(info, xi, 7, 12, 1e-9, random);
  CapacitanceMatrix c(denseGreens(info, xi), 60);
  const auto switches = switchesOfNodes({0, 1, 2, 3, 7, 4, 5, 12, 8});
  Eigen::VectorXd right = Eigen::VectorXd::Ones(60), values(60), moved(60);
  std::vector<int> nodes;
  for (std::size_t k = 0; k < switches.size(); k += 3) nodes.push_back(switches[k].node);
  const long before = allocationCount();
  for (int round = 0; round < 10; ++round) {
    for (std::size_t k = 0; k < switches.size(); k += 3) c.add(&switches[k], 3);
    c.solve(right.data(), values.data());
    moved.setZero();  // the deformation sum; whole nodes stand in the order of their addition
    c.greens().accumulate(nodeList(nodes), values.head(c.size()), moved);
    c.add(&switches[0], 2);  // refused
    for (std::size_t k = 0; k < switches.size(); k += 3) c.removeNode(switches[k].node);
    c.removeNode(17);  // not there
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(c.refactorisations(), 0) << "the test should take in refactorisations";
}

}  // namespace
}  // namespace palpate::test
