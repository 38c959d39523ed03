// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/flat_subdivision.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace palpate::test {
namespace {

const Shape& cube() {
  static const Shape shape = box({1, 1, 1}, {2, 2, 2});
  return shape;
}

TEST(FlatSubdivision, KeepsTheBodyAndHalvesItsEdges) {
  const LoopLevel level = subdivideFlat(cube().points, cube().triangles);
  const SurfaceMesh coarse(cube().points, cube().triangles), fine(level.points, level.triangles);
  EXPECT_EQ(fine.triangleCount(), 4 * coarse.triangleCount());
  EXPECT_NEAR(fine.meanEdgeLength(), 0.5 * coarse.meanEdgeLength(), 1e-14);
  EXPECT_NEAR(fine.triangleAreas().sum(), 6, 1e-14);
  for (int f = 0; f < fine.triangleCount(); ++f)
    EXPECT_LT(
        (fine.triangleNormals().col(f) - coarse.triangleNormals().col(level.parentTriangle[f]))
            .norm(),
        1e-14);
  EXPECT_EQ(fine.points().leftCols(coarse.vertexCount()), coarse.points());
}

TEST(FlatSubdivision, APointsParentIsTheSamePlace) {
  const LoopLevel level = subdivideFlat(cube().points, cube().triangles);
  const SurfaceMesh coarse(cube().points, cube().triangles), fine(level.points, level.triangles);
  for (int f = 0; f < fine.triangleCount(); ++f) {
    const SurfacePoint point{f, {0.2, 0.5, 0.3}};
    const SurfacePoint parent = parentPoint(level, coarse.triangles(), point);
    EXPECT_NEAR(parent.barycentric.sum(), 1, 1e-15);
    EXPECT_GE(parent.barycentric.minCoeff(), 0);
    EXPECT_LT((placeOf(coarse, parent) - placeOf(fine, point)).norm(), 1e-15);
  }
}

TEST(LoopSubdivision, TheParentOfAnOldVertexIsThatVertex) {
  const LoopLevel level = subdivideLoop(cube().points, cube().triangles);
  for (int f = 0; f < level.triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int vertex = level.triangles(k, f);
      if (vertex >= cube().points.cols()) continue;
      const SurfacePoint parent =
          parentPoint(level, cube().triangles, {f, Eigen::Vector3d::Unit(k)});
      Eigen::Index corner;
      EXPECT_EQ(parent.barycentric.maxCoeff(&corner), 1);
      EXPECT_EQ(cube().triangles(corner, parent.triangle), vertex);
    }
}

}  // namespace
}  // namespace palpate::test
