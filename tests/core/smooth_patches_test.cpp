// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/smooth_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <limits>

#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

Eigen::VectorXi patchesOf(const Shape& shape, double angle) {
  return findSmoothPatches(*shape.mesh(), angle);
}

int countOf(const Shape& shape, double angle) {
  return patchesOf(shape, angle).maxCoeff() + 1;
}

TEST(SmoothPatches, ABoxHasSixUntilItsEdgesCountAsSmooth) {
  const Shape shape = renumbered(box({1, 2, 3}, {2, 3, 4}));
  EXPECT_EQ(countOf(shape, 30), 6);
  EXPECT_EQ(countOf(shape, 89.9), 6);
  EXPECT_EQ(countOf(shape, 90.1), 1);
}

TEST(SmoothPatches, TrianglesOfABoxsFaceShareAPatch) {
  const Shape shape = box({1, 1, 1}, {3, 3, 3});
  const auto mesh = shape.mesh();
  const Eigen::VectorXi patch = findSmoothPatches(*mesh, 30);
  for (int f = 0; f < mesh->triangleCount(); ++f)
    for (int g = 0; g < mesh->triangleCount(); ++g)
      EXPECT_EQ(patch[f] == patch[g],
                mesh->triangleNormals().col(f).dot(mesh->triangleNormals().col(g)) > 0.5);
}

TEST(SmoothPatches, PartAtTheDihedralAngle) {
  // An icosahedron's faces meet at arccos(-sqrt 5 / 3) = 138.19 degrees: normals 41.81 apart.
  EXPECT_EQ(countOf(icosphere(0), 41.8), 20);
  EXPECT_EQ(countOf(icosphere(0), 41.82), 1);
}

TEST(SmoothPatches, AtNoughtDegreesOnlyPlanesAreSmoothHoweverTheyLie) {
  const Shape shape = box({1, 1, 1}, {3, 3, 3});
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  for (double angle : {0.0, 0.3, 1.0, 2.0}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).matrix();
    EXPECT_EQ(countOf({turn * shape.points, shape.triangles}, 0), 6) << angle;
  }
  EXPECT_EQ(countOf(icosphere(1), 0), 80);
}

TEST(SmoothPatches, At180DegreesEveryShellIsOne) {
  // A needle's edges turn by nearly 180 degrees.
  const Shape needle = bipyramid(3).mapped(
      [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), 1e-7 * x.y(), x.z()); });
  EXPECT_EQ(countOf(needle, 180), 1);
  EXPECT_EQ(countOf(hollowSphere(1, 0.5).with(box({1, 1, 1}, {1, 1, 1}).moved({4, 0, 0})), 180), 3);
}

TEST(SmoothPatches, AreNumberedInTheOrderOfTheirLowestTriangle) {
  const Eigen::VectorXi patch = patchesOf(renumbered(box({1, 1, 1}, {2, 2, 2})), 30);
  int next = 0;
  for (int number : patch) {
    EXPECT_LE(number, next);
    if (number == next) ++next;
  }
  EXPECT_EQ(next, 6);
}

TEST(SmoothPatches, AnAngleOutsideItsRangeIsRefused) {
  for (double angle : {-1.0, 180.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(
        contains(refusal([&] { patchesOf(tetrahedron(), angle); }),
                 "the smooth angle must be 0 to 180 degrees, not " + std::to_string(angle)));
}

}  // namespace
}  // namespace palpate::test
