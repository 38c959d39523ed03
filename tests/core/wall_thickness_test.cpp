// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/wall_thickness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "support/soups.h"

namespace palpate::test {
namespace {

double ratioOf(const Shape& shape) {
  return largestWallRatio(*shape.mesh()).ratio;
}

TEST(WallThickness, OfAPlateIsItsHeight) {
  // Squares of 0.1 cut in two: the longest edge is their diagonal.
  for (double height : {0.01, 0.1, 0.3})
    EXPECT_NEAR(ratioOf(box({1, 1, height}, {10, 10, 1})), 0.1 * std::sqrt(2.0) / height,
                1e-12 / height);
}

TEST(WallThickness, DoesNotDependOnScaleOrPosition) {
  const Shape shape = box({1, 1, 0.1}, {5, 5, 1});
  const double ratio = ratioOf(shape);
  for (double scale : {1e-6, 1e-3, 1e6}) EXPECT_NEAR(ratioOf(shape.scaled(scale)), ratio, 1e-12);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  // Coordinates near 10 are rounded to 1e-15, over a height of 0.1.
  EXPECT_NEAR(ratioOf(Shape{turn * shape.points, shape.triangles}.moved({7, 8, 9})), ratio, 1e-11);
}

TEST(WallThickness, BetweenASphereAndItsCavityIsTheDifferenceOfTheirRadii) {
  // Longest edge of the outer sphere 0.3249 (icosphere of 162 vertices), plane triangles inside.
  const double cavity = 0.8;
  const auto outer = icosphere(2).mesh();
  const double ratio = ratioOf(hollowSphere(2, cavity));
  double longest = 0;
  for (const auto& t : outer->triangles().colwise())
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest,
                         (outer->points().col(t[k]) - outer->points().col(t[(k + 1) % 3])).norm());
  const double inradius = std::sqrt(1 - longest * longest / 3);  // of the largest triangle's plane
  EXPECT_NEAR(ratio, longest / (inradius * (1 - cavity)), 1e-3 * ratio);
}

TEST(WallThickness, OfASolidBallIsItsDiameter) {
  EXPECT_NEAR(ratioOf(icosphere(2)), 0.325 / 2, 0.01);  // longest edge over the diameter
}

TEST(WallThickness, NamesATriangleWhereTheWallIsThinnest) {
  // A wedge from 0.02 to 0.22 thick: the thin end's triangles have x < 0.1.
  const Shape wedge = box({1, 1, 1}, {10, 10, 1}).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y(), x.z() * (0.02 + 0.2 * x.x()));
  });
  const auto mesh = wedge.mesh();
  const WallRatio wall = largestWallRatio(*mesh);
  ASSERT_GE(wall.triangle, 0);
  for (int v : mesh->triangles().col(wall.triangle)) EXPECT_LT(mesh->points()(0, v), 0.1 + 1e-12);
}

TEST(WallThickness, ANarrowGapBetweenTwoBodiesIsNoThinWall) {
  const Shape cube = box({1, 1, 1}, {4, 4, 4});
  EXPECT_NEAR(ratioOf(cube.with(cube.moved({0, 0, 1.001}))), ratioOf(cube), 1e-12);
}

TEST(WallThickness, SidesThatFaceEachOtherUnderLessThan120DegreesAreNoWall) {
  // A regular tetrahedron's normals are 109.5 degrees apart.
  Eigen::Matrix3Xd points(3, 4);
  points << 1, 1, -1, -1,  //
      1, -1, 1, -1,        //
      1, -1, -1, 1;
  EXPECT_EQ(ratioOf({points, tetrahedron().flipped().triangles}), 0);
}

}  // namespace
}  // namespace palpate::test
