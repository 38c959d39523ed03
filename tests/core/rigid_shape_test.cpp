// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/rigid_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/mesh_shape.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

/// Least distance to a shape over a lattice of a triangle's points.
double leastOnLattice(const RigidShape& shape, const Eigen::Matrix3d& corners) {
  constexpr int n = 60;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(
          least,
          shape.proximity(corners * Eigen::Vector3d(i, j, n - i - j) / static_cast<double>(n))
              .distance);
  return least;
}

/// Triangles of about a shape's size, near it, half of them cut by it.
Eigen::Matrix3d randomTriangle(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> within(-1, 1);
  Eigen::Matrix3d corners;
  const Eigen::Vector3d middle =
      1.5 * size * Eigen::Vector3d(within(random), within(random), within(random));
  for (int k = 0; k < 9; ++k) corners(k) = size * within(random);
  return corners.colwise() + middle;
}

void expectDeepest(const RigidShape& shape, double size, double tolerance, double outsideOf) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Matrix3d corners = randomTriangle(random, size);
    const double least = leastOnLattice(shape, corners);
    if (least < outsideOf) continue;
    const Eigen::Vector3d point = shape.deepest(corners);
    EXPECT_NEAR(point.sum(), 1, 1e-12);
    EXPECT_GE(point.minCoeff(), -1e-12);
    EXPECT_LE(shape.proximity(corners * point).distance, least + tolerance * size) << trial;
  }
}

TEST(RigidShape, NoPointOfATriangleIsDeeperThanTheDeepest) {
  expectDeepest(SphereShape(0.3), 0.5, 1e-12, -1);
  expectDeepest(SphereShape(0.01), 0.5, 1e-12, -1);
  // A segment that pierces the triangle has no deepest point that means more than others.
  expectDeepest(CapsuleShape({-0.2, 0, 0.1}, {0.3, 0.1, 0}, 0.2), 0.5, 1e-12, -0.2 + 0.02);
  expectDeepest(CapsuleShape({0, 0, 0}, {0, 0, 0}, 0.2), 0.5, 1e-12, -1);
  expectDeepest(PlaneShape(), 0.5, 1e-12, -10);
  // From one start, outside a convex body, where its distance is convex.
  expectDeepest(MeshShape(icosphere(2).scaled(0.3).mesh()), 0.5, 2e-3, 0);
}

TEST(RigidShape, SmallestRadiusIsThatOfWhatSticksOut) {
  EXPECT_EQ(SphereShape(0.3).smallestRadius(), 0.3);
  EXPECT_EQ(CapsuleShape({0, 0, 0}, {1, 0, 0}, 0.2).smallestRadius(), 0.2);
  EXPECT_EQ(PlaneShape().smallestRadius(), std::numeric_limits<double>::infinity());
  // Triangles of an icosphere differ in size by a fifth.
  EXPECT_NEAR(MeshShape(icosphere(3).scaled(0.3).mesh()).smallestRadius(), 0.3, 0.06);
  EXPECT_EQ(MeshShape(box({1, 1, 1}, {2, 2, 2}).mesh()).smallestRadius(), 0);
}

}  // namespace
}  // namespace palpate::test
