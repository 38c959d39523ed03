// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Surfaces that end: what walks, locates and measures on them.

#include "mesh/rims.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "mesh/mesh_defects.h"
#include "mesh/smooth_patches.h"
#include "mesh/surface_locator.h"
#include "mesh/surface_walk.h"
#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

TEST(Rims, AreRefusedUnlessTheyAreAllowed) {
  EXPECT_TRUE(isRefused([] { plate(1, 2).mesh(); }, "open boundary: edge (0, 1)"));
  const auto sheet = plate(1, 2).sheet();
  EXPECT_EQ(sheet->bodyCount(), 1);
  EXPECT_FALSE(sheet->isCavity(0));
  EXPECT_NEAR(sheet->vertexAreas().sum(), 1, 1e-15);
  // Eight edges of the rim and four within of 1/2, and four diagonals.
  EXPECT_NEAR(sheet->meanEdgeLength(), (12 * 0.5 + 4 * std::sqrt(0.5)) / 16, 1e-15);
}

TEST(Rims, DoNotExcuseOtherDefects) {
  const auto refused = [](Shape shape, const char* sentence) {
    return isRefused([&] { shape.sheet(); }, sentence);
  };
  Shape flipped = plate(1, 2);
  std::swap(flipped.triangles(0, 3), flipped.triangles(1, 3));
  EXPECT_TRUE(refused(flipped, "inconsistent orientation"));
  // Two triangles that touch in one vertex.
  EXPECT_TRUE(refused(
      fromLists({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}),
      "non-manifold vertex: at vertex 0"));
  EXPECT_TRUE(refused(fromLists({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
                      "non-manifold edge"));
}

TEST(Rims, APieceWithAHoleIsASheet) {
  Shape ring = plate(1, 4);
  Eigen::Matrix3Xi kept(3, 0);
  for (int f = 0; f < ring.triangles.cols(); ++f) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int v : ring.triangles.col(f)) middle += ring.points.col(v) / 3;
    if (middle.cwiseAbs().maxCoeff() < 0.25 && middle.x() > 0) continue;
    kept.conservativeResize(3, kept.cols() + 1);
    kept.rightCols(1) = ring.triangles.col(f);
  }
  const auto sheet = Shape{ring.points, kept}.sheet();
  EXPECT_EQ(sheet->bodyCount(), 1);
  EXPECT_EQ(findSmoothPatches(*sheet, 30).maxCoeff(), 0);
}

/// Walks and checks that every step is on the surface.
SurfaceWalk::Walker walked(const SurfaceWalk& walk, const SurfacePoint& from,
                           const Eigen::Vector3d& way) {
  SurfaceWalk::Walker walker = walk.start(from, way);
  for (int steps = 0; !walker.hasArrived() && steps < 1000; ++steps) {
    const int triangle = walker.point.triangle;
    const Eigen::Vector3d end = walk.step(walker);
    EXPECT_GE(end.minCoeff(), 0);
    EXPECT_GE(walker.point.triangle, 0);
    EXPECT_LE((placeOf(walk.mesh(), {triangle, end}) - placeOf(walk.mesh(), walker.point)).norm(),
              1e-15);
  }
  EXPECT_TRUE(walker.hasArrived());
  return walker;
}

TEST(Rims, AWalkGoesOnAlongThem) {
  const SurfaceWalk walk(plate(1, 4).sheet());
  const SurfacePoint from = nearestSurfacePoint(walk.mesh(), {0.3, -0.3, 0});
  const auto end = [&](double x, double y) {
    return placeOf(walk.mesh(), walked(walk, from, {x, y, 0}).point);
  };
  EXPECT_LE((end(0.4, 0.4) - Eigen::Vector3d(0.5, 0.1, 0)).norm(), 1e-14);  // slides along x = 1/2
  EXPECT_LE((end(0.6, 0.1) - Eigen::Vector3d(0.5, -0.2, 0)).norm(), 1e-14);
  EXPECT_LE((end(0.9, 2) - Eigen::Vector3d(0.5, 0.5, 0)).norm(), 1e-14);  // into a corner
  EXPECT_LE((end(0.6, 0) - Eigen::Vector3d(0.5, -0.3, 0)).norm(), 1e-14);
}

TEST(Rims, NoWalkLeavesOrGetsLost) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const Shape& shape : {jitteredPlate(1, 5, 0.3), disc(0.5, 4), disc(0.5, 1),
                             fromLists({{0, 0, 0}, {1, 0, 0}, {1, 0.05, 0}}, {{0, 1, 2}})}) {
    const SurfaceWalk walk(shape.sheet());
    const SurfaceMesh& mesh = walk.mesh();
    for (int trial = 0; trial < 500; ++trial) {
      const Eigen::Vector3d way(number(random), number(random), 0);
      const int f = static_cast<int>(random() % mesh.triangleCount());
      Eigen::Vector3d weights =
          Eigen::Vector3d(number(random), number(random), number(random)).cwiseAbs();
      if (trial % 3 == 0) weights = Eigen::Vector3d::Unit(trial / 3 % 3);  // from a vertex
      if (trial % 3 == 1) weights[trial / 3 % 3] = 0;                      // from an edge
      walked(walk, {f, weights / weights.sum()}, 2 * way);
    }
  }
}

TEST(Rims, ASegmentEntersAFlatSheetFromItsOuterSideAlone) {
  const SurfaceLocator locator(plate(1, 4).sheet());
  const auto entry = locator.firstEntry({0.1, 0.2, 1}, {0.1, 0.2, -1});
  ASSERT_TRUE(entry);
  EXPECT_LE((placeOf(locator.mesh(), *entry) - Eigen::Vector3d(0.1, 0.2, 0)).norm(), 1e-15);
  EXPECT_FALSE(locator.firstEntry({0.1, 0.2, -1}, {0.1, 0.2, 1}));
  EXPECT_FALSE(locator.firstEntry({0.7, 0.2, 1}, {0.7, 0.2, -1}));  // beside it
  EXPECT_TRUE(locator.isInside({0.1, 0.2, -0.3}));
  EXPECT_TRUE(locator.isInside({0.9, 0.2, -0.3}));  // below its plane
  EXPECT_FALSE(locator.isInside({0.1, 0.2, 0.3}));
}

}  // namespace
}  // namespace palpate::test
