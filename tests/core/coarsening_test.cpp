// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/coarsening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/smooth_patches.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

CoarsenedSurface coarsenedTo(int vertices, const Shape& shape, const Place& fixed) {
  return coarsen(shape.points, shape.triangles, fixedWhere(shape, fixed),
                 findSmoothPatches(*shape.mesh(), 30), vertices);
}

bool nowhere(const Eigen::Vector3d&) {
  return false;
}

/// 1 for an equilateral triangle, 0 for one without area.
double leastQuality(const SurfaceMesh& mesh) {
  double least = 1;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    double squares = 0;
    for (int k = 0; k < 3; ++k)
      squares += (mesh.points().col(mesh.triangles()(k, f)) -
                  mesh.points().col(mesh.triangles()((k + 1) % 3, f)))
                     .squaredNorm();
    least = std::min(least, 4 * std::sqrt(3.0) * mesh.triangleAreas()[f] / squares);
  }
  return least;
}

TEST(Coarsening, DoublesEdgesAndKeepsTrianglesSound) {
  const Shape sphere = jitteredSphere(3, 0.2);
  const CoarsenedSurface coarse = coarsenedTo(160, sphere, nowhere);
  const SurfaceMesh mesh(coarse.points, coarse.triangles);  // closed, or it throws
  EXPECT_EQ(mesh.vertexCount(), 160);
  EXPECT_NEAR(mesh.meanEdgeLength() / sphere.mesh()->meanEdgeLength(), 2, 0.15);
  EXPECT_GT(leastQuality(mesh), 0.25);
}

TEST(Coarsening, KeepsVerticesWhereTheyWere) {
  const Shape sphere = icosphere(3);
  const CoarsenedSurface coarse = coarsenedTo(160, sphere, cap);
  ASSERT_LE(coarse.vertices.size(), 180u);  // a ragged rim keeps a few more
  for (std::size_t v = 0; v < coarse.vertices.size(); ++v) {
    EXPECT_EQ(coarse.points.col(v), sphere.points.col(coarse.vertices[v]));
    EXPECT_EQ(coarse.boundaryTypes[v] != 0, cap(coarse.points.col(v)));
  }
  EXPECT_TRUE(std::is_sorted(coarse.vertices.begin(), coarse.vertices.end()));
}

/// Where edges are graded, they grow everywhere by about the same factor.
TEST(Coarsening, KeepsTheGrading) {
  const auto edgeAt = [](double angle) { return 0.05 + 0.1 * angle; };
  const Shape graded = ringedSphere(edgeAt, {});
  const int wanted = static_cast<int>(graded.points.cols()) / 4;
  const CoarsenedSurface coarse = coarsenedTo(wanted, graded, nowhere);
  double fine[2] = {0, 0}, left[2] = {0, 0};
  for (Eigen::Index v = 0; v < graded.points.cols(); ++v) ++fine[graded.points(2, v) > 0];
  for (Eigen::Index v = 0; v < coarse.points.cols(); ++v) ++left[coarse.points(2, v) > 0];
  EXPECT_GT(fine[1], 2 * fine[0]);
  for (int half : {0, 1}) EXPECT_NEAR(left[half] / fine[half], 0.25, 0.06) << half;
}

/// The coarse surface of a box is the box: edges keep vertices of their own, corners stay.
TEST(Coarsening, KeepsSharpEdgesCornersAndPatches) {
  const Shape cube = box({1, 1, 1}, {8, 8, 8});
  const CoarsenedSurface coarse = coarsenedTo(100, cube, nowhere);
  const SurfaceMesh mesh(coarse.points, coarse.triangles);
  EXPECT_LE(mesh.vertexCount(), 110);
  EXPECT_NEAR(mesh.triangleAreas().sum(), 6, 1e-9);
  const Eigen::VectorXi found = findSmoothPatches(mesh, 30);
  EXPECT_EQ(found.maxCoeff(), 5);
  for (int f = 1; f < mesh.triangleCount(); ++f)
    EXPECT_EQ(found[f] == found[0], coarse.smoothPatches[f] == coarse.smoothPatches[0]) << f;
}

/// The support keeps its area to the chords of its rim, and no triangle outside joins it.
TEST(Coarsening, KeepsTheSupport) {
  const Shape sphere = icosphere(3);
  const auto supportArea = [](const SurfaceMesh& mesh, const std::vector<unsigned char>& fixed) {
    double area = 0;
    for (int f = 0; f < mesh.triangleCount(); ++f) {
      const Eigen::Vector3i t = mesh.triangles().col(f);
      if (fixed[t[0]] && fixed[t[1]] && fixed[t[2]]) area += mesh.triangleAreas()[f];
    }
    return area;
  };
  const CoarsenedSurface coarse = coarsenedTo(160, sphere, cap);
  EXPECT_NEAR(supportArea({coarse.points, coarse.triangles}, coarse.boundaryTypes) /
                  supportArea(*sphere.mesh(), fixedWhere(sphere, cap)),
              1, 0.1);
}

/// Three fixed vertices hold a body: they are corners.
TEST(Coarsening, KeepsASupportOfOneTriangle) {
  const Shape sphere = icosphere(3);
  std::set<int> held;
  for (int k = 0; k < 3; ++k) held.insert(sphere.triangles(k, 0));
  std::vector<unsigned char> fixed(sphere.points.cols(), 0);
  for (int v : held) fixed[v] = 1;
  const CoarsenedSurface coarse =
      coarsen(sphere.points, sphere.triangles, fixed, findSmoothPatches(*sphere.mesh(), 30), 160);
  std::set<int> kept;
  for (std::size_t v = 0; v < coarse.vertices.size(); ++v)
    if (coarse.boundaryTypes[v]) kept.insert(coarse.vertices[v]);
  EXPECT_EQ(kept, held);
}

TEST(Coarsening, RefusesWhatDoesNotFit) {
  const Shape sphere = icosphere(1);
  const Eigen::VectorXi patches = Eigen::VectorXi::Zero(sphere.triangles.cols());
  const std::vector<unsigned char> free(sphere.points.cols(), 0);
  EXPECT_THROW(coarsen(sphere.points, sphere.triangles, {0, 1}, patches, 20),
               std::invalid_argument);
  EXPECT_THROW(coarsen(sphere.points, sphere.triangles, free, patches.head(3), 20),
               std::invalid_argument);
  EXPECT_THROW(coarsen(sphere.points, sphere.triangles, free, patches, 3), std::invalid_argument);
  EXPECT_THROW(coarsen(sphere.points, sphere.triangles.leftCols(70), free, patches.head(70), 20),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
