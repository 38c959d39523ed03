// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"
#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

BoundaryConditions fixedNodes(int count, const std::vector<int>& nodes) {
  std::vector<unsigned char> types(count, 0);
  for (int node : nodes) types[node] = 1;
  return BoundaryConditions(types);
}

void require(const Shape& shape, const std::vector<int>& nodes) {
  requireSupport(*shape.mesh(), fixedNodes(int(shape.points.cols()), nodes));
}

/// The vertex at a place.
int at(const Shape& shape, const Eigen::Vector3d& x) {
  Eigen::Index nearest;
  (shape.points.colwise() - x).colwise().norm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

/// The displacement that a rigid motion gives the constraints' points, along their directions.
double largestDisplacement(const RigidMotion& motion, const Eigen::Matrix3Xd& points,
                           const Eigen::Matrix3Xd& directions, double bodySize) {
  const Eigen::Vector3d middle = points.rowwise().mean();
  double largest = 0;
  for (int i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d arm = (points.col(i) - middle) / bodySize;
    const Eigen::Vector3d moved = motion.translation + motion.rotation.cross(arm);
    largest = std::max(largest, std::abs(directions.col(i).dot(moved)));
  }
  return largest;
}

TEST(LeastResistedMotion, RotationsHeldAnywhereLeaveTranslationsAlone) {
  const Eigen::Matrix3Xd none(3, 0), point = Eigen::Matrix3Xd::Zero(3, 3),
                                     directions = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3Xd axes = Eigen::Matrix3d::Identity();
  const RigidMotion free = leastResistedMotion(none, none, 2, axes);
  EXPECT_LT(free.resistance, 1e-15);
  EXPECT_LT(free.rotation.norm(), 1e-15);
  EXPECT_GT(leastResistedMotion(point, directions, 2, axes).resistance, 0.1);
  EXPECT_LT(leastResistedMotion(point, directions, 2, axes.leftCols(2)).resistance, 1e-15);
}

TEST(LeastResistedMotion, AFreeMotionMovesNoConstraint) {
  // A ball joint and a roller: the motion left is the rotation about the line through both.
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 5), directions(3, 5);
  points.col(3) << 1, 2, 3;
  points.col(4) << 1, 2, 3;
  directions.leftCols(3).setIdentity();
  directions.col(3) << 3, 0, -1;
  directions.col(4) << 2, -1, 0;
  directions.colwise().normalize();
  const RigidMotion motion = leastResistedMotion(points, directions, 4);
  EXPECT_LT(motion.resistance, 1e-15);
  EXPECT_LT(largestDisplacement(motion, points, directions, 4), 1e-15);
  EXPECT_LT(motion.rotation.normalized().cross(Eigen::Vector3d(1, 2, 3).normalized()).norm(),
            1e-14);
}

TEST(LeastResistedMotion, ThreeTwoOneSupportsRestrainEveryMotion) {
  // Three rollers below, two at a side, one at the front: statically determinate.
  Eigen::Matrix3Xd points(3, 6), directions(3, 6);
  points << 0, 1, 0, 0, 1, 0,  //
      0, 0, 1, 0, 0, 0,        //
      0, 0, 0, 0.5, 0.5, 0.5;
  directions << 0, 0, 0, 0, 0, 1,  //
      0, 0, 0, 1, 1, 0,            //
      1, 1, 1, 0, 0, 0;
  EXPECT_GT(leastResistedMotion(points, directions, 1).resistance, 0.05);
  // Any one of them less, and a motion is free.
  for (int left = 0; left < 6; ++left) {
    Eigen::Matrix3Xd p(3, 5), d(3, 5);
    for (int i = 0, j = 0; i < 6; ++i)
      if (i != left) p.col(j) = points.col(i), d.col(j++) = directions.col(i);
    EXPECT_LT(leastResistedMotion(p, d, 1).resistance, 1e-15) << "without constraint " << left;
  }
}

TEST(LeastResistedMotion, DoesNotDependOnUnitsPlaceOrRepetition) {
  const Shape shape = tetrahedron();
  Eigen::Matrix3Xd points(3, 9), directions(3, 9);
  for (int i = 0; i < 9; ++i) {
    points.col(i) = shape.points.col(i / 3);
    directions.col(i) = Eigen::Vector3d::Unit(i % 3);
  }
  const double resistance = leastResistedMotion(points, directions, 2).resistance;
  EXPECT_GT(resistance, 0.01);
  for (double scale : {1e-20, 1e20})
    EXPECT_NEAR(leastResistedMotion(points * scale, directions, 2 * scale).resistance, resistance,
                1e-14);
  const Eigen::Vector3d away(1000, 2000, 3000);  // places rounded to 1e-13
  EXPECT_NEAR(leastResistedMotion(points.colwise() + away, directions, 2).resistance, resistance,
              1e-12);
  EXPECT_NEAR(leastResistedMotion(points.replicate(1, 5), directions.replicate(1, 5), 2).resistance,
              resistance, 1e-14);
}

TEST(LeastResistedMotion, WithoutConstraintsIsFree) {
  const Eigen::Matrix3Xd none(3, 0);
  EXPECT_EQ(leastResistedMotion(none, none, 1).resistance, 0);
}

TEST(Support, ABodyWithoutFixedNodesIsRefused) {
  EXPECT_TRUE(
      contains(refusal([] { require(icosphere(1), {}); }),
               "the body of vertex 0 has no fixed node, which leaves a rigid motion free ("));
}

TEST(Support, OneFixedNodeLeavesARotation) {
  const std::string sentence = refusal([] { require(icosphere(1), {7}); });
  EXPECT_TRUE(contains(sentence,
                       "the only fixed node of the body of vertex 0 leaves a rigid motion "
                       "free (rotation about the axis ("));
  EXPECT_TRUE(contains(sentence, "): fix at least three nodes that are not on one line"));
}

TEST(Support, NodesOnALineLeaveTheRotationAboutItAndTheSentenceNamesTheAxis) {
  const Shape cube = box({1, 1, 1}, {4, 4, 4});
  std::vector<int> edge;  // along y
  for (double y : {0.0, 0.25, 0.5, 0.75, 1.0}) edge.push_back(at(cube, {1, y, 1}));
  const std::string sentence = refusal([&] { require(cube, edge); });
  EXPECT_TRUE(contains(sentence,
                       "the 5 fixed nodes of the body of vertex 0 leave a rigid motion "
                       "free (rotation about the axis ("));
  const double y = std::stod(sentence.substr(sentence.find(", ") + 2));
  EXPECT_NEAR(std::abs(y), 1, 1e-3);  // three digits are shown
}

TEST(Support, ThreeNodesOffALineHoldABodyInAnyUnit) {
  const Shape cube = box({1, 1, 1}, {2, 2, 2});
  const std::vector<int> corners{at(cube, {0, 0, 0}), at(cube, {1, 0, 0}), at(cube, {0, 1, 0})};
  for (double scale : {1e-20, 1e-3, 1.0, 1e3, 1e20})
    EXPECT_NO_THROW(require(cube.scaled(scale), corners)) << scale;
  for (double scale : {1e-20, 1e20})
    EXPECT_TRUE(contains(refusal([&] {
                           require(cube.scaled(scale), {corners[0], corners[1]});
                         }),
                         "leave a rigid motion free"))
        << scale;
}

TEST(Support, EveryBodyNeedsItsOwn) {
  const Shape two = tetrahedron().with(tetrahedron().moved({3, 0, 0}));
  EXPECT_NO_THROW(require(two, {0, 1, 2, 4, 5, 6}));
  EXPECT_TRUE(contains(refusal([&] {
                         require(two, {0, 1, 2});
                       }),
                       "the body of vertex 4 has no fixed node, which leaves a rigid motion free"));
}

TEST(Support, ACavityIsHeldByTheBodyAroundIt) {
  const Shape hollow = hollowSphere(1, 0.5);
  EXPECT_NO_THROW(require(hollow, {0, 1, 2}));     // outside
  EXPECT_NO_THROW(require(hollow, {42, 43, 44}));  // in the cavity
}

double widthOf(const Shape& shape, const std::vector<int>& nodes) {
  return supportWidthInEdges(*shape.mesh(), fixedNodes(int(shape.points.cols()), nodes));
}

std::vector<int> where(const Shape& shape, const std::function<bool(const Eigen::Vector3d&)>& is) {
  std::vector<int> nodes;
  for (int v = 0; v < shape.points.cols(); ++v)
    if (is(shape.points.col(v))) nodes.push_back(v);
  return nodes;
}

TEST(SupportWidth, OfABoxsBaseIsItsShorterSideOverTheMeanEdge) {
  // 8 by 4 squares of side 1: 8 * 5 + 9 * 4 edges of length 1 and a diagonal in each square.
  const Shape plate = box({8, 4, 2}, {8, 4, 2});
  const double meanEdge = (76 + 32 * std::sqrt(2.0)) / 108;
  for (double scale : {1e-6, 1.0, 1e6})
    EXPECT_NEAR(widthOf(plate.scaled(scale), where(plate, [](auto& x) { return x.z() < 1e-9; })),
                4 / meanEdge, 1e-12);
}

TEST(SupportWidth, OfALineOrANodeIsNothing) {
  const Shape cube = box({1, 1, 1}, {4, 4, 4});
  EXPECT_NEAR(widthOf(cube, where(cube, [](auto& x) { return x.y() < 1e-9 && x.z() < 1e-9; })), 0,
              1e-7);  // the square root of rounding: an axis of the scatter matrix
  EXPECT_EQ(widthOf(cube, {0}), 0);
}

TEST(SupportWidth, IsTheWidestSupportOfTheWorstBody) {
  const Shape cube = box({4, 4, 4}, {4, 4, 4});
  const auto base = [](auto& x) { return x.z() < 1e-9; };
  const double wide = widthOf(cube, where(cube, base));
  // A second, small support of the same body does not matter, that of another body does.
  std::vector<int> both = where(cube, base);
  both.push_back(at(cube, {2, 2, 4}));
  EXPECT_EQ(widthOf(cube, both), wide);
  const Shape two = cube.with(cube.moved({10, 0, 0}));
  std::vector<int> nodes = where(cube, base);
  const int count = static_cast<int>(cube.points.cols());
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)})
    nodes.push_back(count + at(cube, x));
  EXPECT_LT(widthOf(two, nodes), 1.5);
}

TEST(SupportWidth, WithoutSupportIsInfinite) {
  EXPECT_TRUE(std::isinf(widthOf(icosphere(1), {})));
}

}  // namespace
}  // namespace palpate::test
