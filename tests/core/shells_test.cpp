// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/shells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <numeric>

#include "support/soups.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Shells shellsOf(const Shape& shape) {
  return findShells(shape.points, shape.triangles);
}

double angleOf(const Shape& shape, const Eigen::Vector3d& x) {
  double sum = 0;
  for (const auto& t : shape.triangles.colwise())
    sum += solidAngle(x, shape.points.col(t[0]), shape.points.col(t[1]), shape.points.col(t[2]));
  return sum;
}

TEST(SolidAngle, AnOctantIsAnEighthOfTheSphereAndPositiveFromBehind) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(solidAngle({0, 0, 0}, x, y, z), kPi / 2, 1e-15);
  EXPECT_NEAR(solidAngle({0, 0, 0}, x, z, y), -kPi / 2, 1e-15);
}

TEST(SolidAngle, OfAClosedSurfaceIsFourPiInsideAndNothingOutside) {
  // 20 to 320 terms, each exact to a few units in the last place.
  for (const Shape& shape : {icosphere(2), torus(2, 0.5, 12, 7), box({4, 4, 4}, {2, 2, 2})}) {
    EXPECT_NEAR(angleOf(shape, {10, 1, 2}), 0, 1e-12);
    EXPECT_NEAR(angleOf(shape.flipped(), {10, 1, 2}), 0, 1e-12);
  }
  EXPECT_NEAR(angleOf(icosphere(2), {0.3, -0.2, 0.5}), 4 * kPi, 1e-12);
  EXPECT_NEAR(angleOf(icosphere(2).flipped(), {0.3, -0.2, 0.5}), -4 * kPi, 1e-12);
  EXPECT_NEAR(angleOf(torus(2, 0.5, 12, 7), {0, 0, 0}), 0, 1e-12);  // the hole is outside
}

TEST(Shells, VolumesAreThoseOfTheSolids) {
  EXPECT_NEAR(shellsOf(tetrahedron()).volume[0], 1.0 / 6, 1e-15);
  EXPECT_NEAR(shellsOf(box({1, 2, 3}, {2, 2, 2})).volume[0], 6, 1e-13);
  EXPECT_NEAR(shellsOf(box({1, 2, 3}, {2, 2, 2}).flipped()).volume[0], -6, 1e-13);
  // Icosahedron: 5 (3 + sqrt 5) / 12 of its edge cubed.
  const double edge = 1 / std::sin(2 * kPi / 5);
  EXPECT_NEAR(shellsOf(icosphere(0)).volume[0], 5 * (3 + std::sqrt(5.0)) / 12 * std::pow(edge, 3),
              1e-13);
}

TEST(Shells, VolumesDoNotDependOnTheOrigin) {
  // The coordinates themselves are rounded to 1e6 times 1e-16, over a surface of 12.
  const Eigen::Vector3d far(1e6, -2e6, 3e6);
  EXPECT_NEAR(shellsOf(icosphere(2).moved(far)).volume[0], shellsOf(icosphere(2)).volume[0], 1e-8);
}

TEST(Shells, AFlatSurfaceEnclosesExactlyNothingWhereverItLies) {
  const Shape flat = bipyramid(6).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() + 0.1 * x.z(), x.y() + 0.05 * x.z(), 0);
  });
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  for (double scale : {1e-20, 1.0, 1e20})
    EXPECT_EQ(shellsOf({turn * flat.points * scale, flat.triangles}).volume[0], 0) << scale;
}

TEST(Shells, AThinPlateStillEnclosesItsVolume) {
  const Shells shells = shellsOf(box({1, 1, 1e-8}, {3, 3, 1}));
  EXPECT_NEAR(shells.volume[0] / 1e-8, 1, 1e-7);  // cancelled digits: 1e-16 of 1 over 1e-8
}

TEST(Shells, AreTheConnectedComponentsInTheOrderOfTheirVertices) {
  const Shape two = icosphere(1).with(tetrahedron().moved({5, 0, 0}));
  const Shells shells = shellsOf(two);
  ASSERT_EQ(shells.count(), 2);
  EXPECT_EQ(shells.ofVertex[41], 0);
  EXPECT_EQ(shells.ofVertex[42], 1);
  EXPECT_EQ(shells.firstTriangle, (std::vector<int>{0, 80}));
  EXPECT_EQ(shells.parent, (std::vector<int>{-1, -1}));
  EXPECT_EQ(shells.depth, (std::vector<int>{0, 0}));
}

TEST(Shells, NestAsDeepAsTheyAre) {
  // Given from the inside out and from the outside in: the numbers differ, the nesting does not.
  const Shape small = icosphere(1).scaled(0.2), middle = icosphere(1).scaled(0.5),
              large = icosphere(1);
  const Shells outward = shellsOf(small.with(middle).with(large));
  EXPECT_EQ(outward.depth, (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(outward.parent, (std::vector<int>{1, 2, -1}));
  const Shells inward = shellsOf(large.with(middle).with(small));
  EXPECT_EQ(inward.depth, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(inward.parent, (std::vector<int>{-1, 0, 1}));
}

TEST(Shells, InTheHoleOfATorusIsNotInsideIt) {
  const Shells shells = shellsOf(torus(2, 0.5, 24, 9).with(icosphere(0)));
  EXPECT_EQ(shells.depth, (std::vector<int>{0, 0}));
}

}  // namespace
}  // namespace palpate::test
