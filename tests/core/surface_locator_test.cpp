// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_locator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/allocation_count.h"
#include "support/soups.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

/// Tame and not so tame surfaces of about unit size.
std::vector<Shape> surfaces() {
  return {icosphere(0),
          jitteredSphere(2, 0.2),
          hollowSphere(1, 0.7),
          box({1, 1, 1}, {2, 3, 4}),
          boxWithNeedles(1e-6),
          bipyramid(40),
          box({1, 1, 1e-5}, {5, 5, 1}),
          box({1, 1, 1}, {2, 2, 2}).with(box({1, 1, 1}, {2, 2, 2}).moved({0, 0, 1.00001})),
          torus(1, 0.3, 20, 10)};
}

TEST(SurfaceLocator, FindsTheNearestPointThatASearchOverAllTrianglesFinds) {
  std::mt19937 random(1);
  for (const Shape& shape : surfaces()) {
    const SurfaceLocator locator(shape.mesh());
    for (int trial = 0; trial < 300; ++trial) {
      const Eigen::Vector3d place = 1.5 * randomVectors(1, random);
      const SurfacePoint found = locator.nearest(place);
      const SurfacePoint searched = nearestSurfacePoint(locator.mesh(), place);
      // The same distance to the last bit; ties, as at a vertex, may go to any triangle.
      EXPECT_EQ((placeOf(locator.mesh(), found) - place).norm(),
                (placeOf(locator.mesh(), searched) - place).norm());
    }
  }
}

TEST(SurfaceLocator, TellsMaterialFromSpaceAndCavities) {
  std::mt19937 random(2);
  const SurfaceLocator hollow(hollowSphere(3, 0.5).mesh());
  const SurfaceLocator cube(box({1, 1, 1}, {3, 3, 3}).mesh());
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Vector3d x = 1.2 * randomVectors(1, random);
    const double r = x.norm();
    // Triangles of 642 vertices are 0.7 % of the radius within their sphere.
    if (std::abs(r - 1) > 0.01 && std::abs(r - 0.5) > 0.01) {
      EXPECT_EQ(hollow.isInside(x), r < 1 && r > 0.5);
    }
    EXPECT_EQ(cube.isInside(x), x.minCoeff() > 0 && x.maxCoeff() < 1);
  }
  // On the planes, lines and diagonals that its triangles' edges span, too.
  for (double x : {-1.0, 0.5, 2.0})
    for (double y : {-1.0, 1. / 3, 2.0})
      for (double z : {-1.0, 0.5, 4.0}) {
        const bool inside = x == 0.5 && y == 1. / 3 && z == 0.5;
        EXPECT_EQ(cube.isInside({x, y, z}), inside);
      }
}

TEST(SurfaceLocator, AWayIntoTheMaterialIsNeverMissed) {
  std::mt19937 random(3);
  for (const Shape& shape : surfaces()) {
    const SurfaceLocator locator(shape.mesh());
    const SurfaceMesh& mesh = locator.mesh();
    int entries = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Eigen::Vector3d from = 2 * randomVectors(1, random);
      if (locator.isInside(from)) continue;
      // To somewhere in space, to a vertex and beyond, or through the middle of an edge.
      const Eigen::Vector3i t = mesh.triangles().col(random() % mesh.triangleCount());
      Eigen::Vector3d to = 2 * randomVectors(1, random);
      if (trial % 3 == 1) to = 1.5 * mesh.points().col(t[0]) - 0.5 * from;
      if (trial % 3 == 2)
        to = 1.1 * (mesh.points().col(t[0]) + mesh.points().col(t[1])) / 2 - 0.1 * from;
      const auto entry = locator.firstEntry(from, to);
      if (!entry) {
        EXPECT_FALSE(locator.isInside(to)) << "it cannot get in without entering";
        continue;
      }
      ++entries;
      EXPECT_LT(mesh.triangleNormals().col(entry->triangle).dot(to - from), 0);
      EXPECT_GE(entry->barycentric.minCoeff(), 0);
      EXPECT_NEAR(entry->barycentric.sum(), 1, 1e-12);
      const Eigen::Vector3d place = placeOf(mesh, *entry), way = to - from;
      // On the segment, as far as rounding allows where it meets a triangle at a small angle.
      EXPECT_LE((place - from).cross(way).norm(), 1e-9 * way.norm());
      // Nothing of the material lies before it.
      const Eigen::Vector3d before = from + (1 - 1e-6) * (place - from);
      EXPECT_FALSE(locator.firstEntry(from, before));
    }
    EXPECT_GT(entries, 100);
  }
}

TEST(SurfaceLocator, AFastWayThroughAThinWallEntersAtItsNearFace) {
  const SurfaceLocator plate(box({1, 1, 1e-5}, {5, 5, 1}).mesh());
  const auto entry = plate.firstEntry({0.31, 0.42, 0.5}, {0.35, 0.42, -0.5});
  ASSERT_TRUE(entry);
  EXPECT_NEAR(placeOf(plate.mesh(), *entry).z(), 1e-5, 1e-15);
}

TEST(SurfaceLocator, AWayOutOfTheMaterialOrIntoACavityDoesNotEnter) {
  const SurfaceLocator hollow(hollowSphere(2, 0.5).mesh());
  EXPECT_FALSE(hollow.firstEntry({0.75, 0, 0}, {2, 0, 0}));
  EXPECT_FALSE(hollow.firstEntry({0.75, 0, 0}, {0, 0, 0}));
  const auto entry = hollow.firstEntry({0.75, 0, 0}, {-0.75, 0, 0});  // across the cavity
  ASSERT_TRUE(entry);
  EXPECT_NEAR(placeOf(hollow.mesh(), *entry).x(), -0.5, 0.02);
}

TEST(SurfaceLocator, QueriesAllocateNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  const SurfaceLocator locator(jitteredSphere(3, 0.2).mesh());
  const long before = allocationCount();
  int inside = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d place(0.02 * i - 1, 0.3, 0.5);
    inside += locator.isInside(place) + locator.nearest(place).triangle +
              locator.firstEntry(place, -place).has_value();
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(inside, 0);
}

}  // namespace
}  // namespace palpate::test
