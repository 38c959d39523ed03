// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/edge_subdivision.h"

#include <gtest/gtest.h>

#include "mesh/smooth_patches.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

SubdivisionLevel curved(const Shape& shape) {
  const auto mesh = shape.mesh();
  return subdivideCurved(*mesh, findSmoothPatches(*mesh, 30));
}

/// Chords miss a sphere by h^2 / 8, cubic edges by much less.
TEST(CurvedSubdivision, StaysOnASphere) {
  const Shape sphere = icosphere(2);
  const SubdivisionLevel fine = curved(sphere);
  const SurfaceMesh mesh(fine.points, fine.triangles);
  EXPECT_EQ(mesh.triangleCount(), 4 * sphere.triangles.cols());
  const double chord = 1 - std::sqrt(1 - std::pow(sphere.mesh()->meanEdgeLength() / 2, 2));
  for (int v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_NEAR(fine.points.col(v).norm(), 1, 0.05 * chord) << v;
  EXPECT_EQ(fine.points.leftCols(sphere.points.cols()), sphere.points);
}

TEST(CurvedSubdivision, LeavesABoxABox) {
  const Shape cube = box({1, 2, 3}, {2, 2, 2});
  const SubdivisionLevel fine = curved(cube);
  const auto types =
      refineBoundaryTypes(fine, fixedWhere(cube, [](auto& x) { return x.z() < 1e-9; }));
  const SurfaceMesh mesh(fine.points, fine.triangles);
  EXPECT_NEAR(mesh.triangleAreas().sum(), 22, 1e-12);
  const Eigen::VectorXi patches = findSmoothPatches(mesh, 30);
  EXPECT_EQ(patches.maxCoeff(), 5);
  for (int v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_EQ(types[v] != 0, fine.points(2, v) < 1e-9) << v;
}

TEST(CurvedSubdivision, PatchesOfAnotherMeshAreRefused) {
  EXPECT_EQ(refusal([] { subdivideCurved(*icosphere(0).mesh(), Eigen::VectorXi::Zero(3)); }),
            "refinement takes a smooth patch for each triangle");
}

TEST(FlatSubdivision, KeepsTheBodyAndHalvesItsEdges) {
  const auto coarse = box({1, 1, 1}, {2, 2, 2}).mesh();
  const SubdivisionLevel level = subdivideFlat(*coarse);
  const SurfaceMesh fine(level.points, level.triangles);
  EXPECT_EQ(fine.triangleCount(), 4 * coarse->triangleCount());
  EXPECT_NEAR(fine.meanEdgeLength(), 0.5 * coarse->meanEdgeLength(), 1e-14);
  EXPECT_NEAR(fine.triangleAreas().sum(), 6, 1e-14);
  for (int f = 0; f < fine.triangleCount(); ++f)
    EXPECT_LT(
        (fine.triangleNormals().col(f) - coarse->triangleNormals().col(level.parentTriangle[f]))
            .norm(),
        1e-14);
  EXPECT_EQ(fine.points().leftCols(coarse->vertexCount()), coarse->points());
}

}  // namespace
}  // namespace palpate::test
