// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/curved_refinement.h"

#include <gtest/gtest.h>

#include "mesh/smooth_patches.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

RemeshedSurface refined(const Shape& shape, const Place& fixed) {
  const auto mesh = shape.mesh();
  return refineCurved(*mesh, fixedWhere(shape, fixed), findSmoothPatches(*mesh, 30));
}

/// Chords miss a sphere by h^2 / 8, cubic edges by much less.
TEST(CurvedRefinement, StaysOnASphere) {
  const Shape sphere = icosphere(2);
  const RemeshedSurface fine = refined(sphere, cap);
  const SurfaceMesh mesh(fine.points, fine.triangles);
  EXPECT_EQ(mesh.triangleCount(), 4 * sphere.triangles.cols());
  const double chord = 1 - std::sqrt(1 - std::pow(sphere.mesh()->meanEdgeLength() / 2, 2));
  for (int v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_NEAR(fine.points.col(v).norm(), 1, 0.05 * chord) << v;
  EXPECT_EQ(fine.points.leftCols(sphere.points.cols()), sphere.points);
}

TEST(CurvedRefinement, LeavesABoxABox) {
  const Shape cube = box({1, 2, 3}, {2, 2, 2});
  const RemeshedSurface fine = refined(cube, [](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  const SurfaceMesh mesh(fine.points, fine.triangles);
  EXPECT_NEAR(mesh.triangleAreas().sum(), 22, 1e-12);
  const Eigen::VectorXi patches = findSmoothPatches(mesh, 30);
  EXPECT_EQ(patches.maxCoeff(), 5);
  for (int v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_EQ(fine.boundaryTypes[v] != 0, fine.points(2, v) < 1e-9) << v;
}

TEST(CurvedRefinement, RefusesWhatDoesNotFit) {
  const auto mesh = icosphere(0).mesh();
  const Eigen::VectorXi patches = Eigen::VectorXi::Zero(20);
  EXPECT_THROW(refineCurved(*mesh, {0}, patches), std::invalid_argument);
  EXPECT_THROW(refineCurved(*mesh, std::vector<unsigned char>(12, 0), patches.head(3)),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
