// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/given_checks.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/given_bodies.h"
#include "support/half_space.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

TEST(GivenChecks, WhatIsNoElasticBodyIsRefused) {
  const Truss truss;
  const auto refused = [&](MatrixKind kind, const Eigen::MatrixXd& matrix, const std::string& words,
                           bool supported = true) {
    const ElasticModel model = supported ? truss.model : givenModel(boundaryOf(truss.solid.mesh()));
    EXPECT_TRUE(isRefused([&] { imported(model, kind, matrix, truss.nodes); }, words));
  };
  const Eigen::MatrixXd& k = truss.stiffness;
  refused(MatrixKind::Stiffness, k, "leaves the body free to move", false);
  refused(MatrixKind::Compliance, k, "it is the stiffness of a loose body");
  Eigen::MatrixXd skew = k;
  skew(0, 40) += 1;
  refused(MatrixKind::Stiffness, skew, "is not symmetric");
  Eigen::MatrixXd indefinite = k;
  indefinite.block<3, 3>(60, 60) -= 2.2 * Eigen::Matrix3d::Identity();
  refused(MatrixKind::Stiffness, indefinite, "is not positive");
  Eigen::MatrixXd loose = k;
  loose.block<3, 81>(39, 0).setZero();
  loose.block<81, 3>(0, 39).setZero();
  loose(39, 39) = -1;
  refused(MatrixKind::Stiffness, loose, "(node 14, x)");
  std::vector<int> swapped = nodesUpTo(81);
  for (int c = 0; c < 3; ++c) std::swap(swapped[3 + c], swapped[75 + c]);
  refused(MatrixKind::Stiffness, k(swapped, swapped), "not where the surface has them");
  std::vector<int> byComponent;
  for (int row = 0; row < 81; ++row) byComponent.push_back(3 * (row % 27) + row / 27);
  refused(MatrixKind::Stiffness, k(byComponent, byComponent), "are in another order");
  const Eigen::MatrixXd c = (k + Eigen::MatrixXd::Identity(81, 81)).inverse();
  refused(MatrixKind::Compliance, c - 0.5 * Eigen::MatrixXd::Identity(81, 81),
          "has a negative eigenvalue, -0.4");
}

TEST(GivenChecks, SupportsThatLeaveARotationAreRefused) {
  const Truss truss;
  const ElasticModel hinged =
      givenModel(boundaryOf(truss.solid.mesh()), [](auto&& x) { return base(x) && x.y() < 1e-9; });
  const Eigen::MatrixXd stiffness = 1e6 * truss.stiffness;
  EXPECT_TRUE(
      isRefused([&] { imported(hinged, MatrixKind::Stiffness, stiffness, truss.nodes); },
                "the stiffness and the fixed vertices leave the body free to move (rotation about "
                "the axis (1, "));
  const Eigen::MatrixXd held = stiffness + 0.1 * Eigen::MatrixXd::Identity(81, 81);
  const auto greens = imported(hinged, MatrixKind::Stiffness, held, truss.nodes);
  ASSERT_EQ(greens->info().diagnostics.warnings.size(), 1u);
  EXPECT_TRUE(contains(greens->info().diagnostics.warnings[0], "the body is held weakly"));
}

TEST(GivenChecks, EachPieceOfASurfaceMustBeHeld) {
  const Truss truss;
  const Shape one = boundaryOf(truss.solid.mesh());
  const Shape two = one.with(one.moved({3, 0, 0}));
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(162, 162);
  stiffness.topLeftCorner(81, 81) = stiffness.bottomRightCorner(81, 81) = truss.stiffness;
  NodeTable nodes = truss.nodes;
  nodes.points.conservativeResize(3, 54);
  nodes.points.rightCols(27) = truss.nodes.points.colwise() + Eigen::Vector3d(3, 0, 0);
  const auto serve = [&](const Place& held) {
    return imported(givenModel(two, held), MatrixKind::Stiffness, stiffness, nodes);
  };
  const auto greens = serve(base),
             alone = imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes);
  const std::vector<int> columns = alone->info().columnNodes;
  EXPECT_LE(relativeDifference(forceCompliance(*greens, columns), forceCompliance(*alone, columns)),
            1e-12);
  EXPECT_EQ(blockOf(*greens, 40, columns[0]).norm(), 0);
  EXPECT_TRUE(isRefused([&] { serve([](auto&& x) { return base(x) && x.x() < 2; }); },
                        "leave the body free to move"));
}

TEST(GivenChecks, UnitsThatNoMaterialHasAreWarnedOf) {
  const Truss truss;
  for (double unit : {1e-9, 1e18}) {
    const auto greens =
        imported(truss.model, MatrixKind::Stiffness, unit * truss.stiffness, truss.nodes);
    ASSERT_EQ(greens->info().diagnostics.warnings.size(), 1u);
    EXPECT_TRUE(contains(greens->info().diagnostics.warnings[0], "state the units"));
  }
}

}  // namespace
}  // namespace palpate::test
