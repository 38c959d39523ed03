// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/subdivision.h"

#include <gtest/gtest.h>

#include "mesh/smooth_patches.h"
#include "mesh/surface_mesh.h"
#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

/// Three vertices and the middles of the edges between them.
SubdivisionLevel triangleLevel() {
  SubdivisionLevel level;
  level.parents.resize(2, 6);
  level.parents << 0, 1, 2, 0, 1, 0,  //
      0, 1, 2, 1, 2, 2;
  return level;
}

TEST(Subdivision, AnOldVertexKeepsItsTypeAndANewOneIsFixedIfBothItsParentsAre) {
  EXPECT_EQ(refineBoundaryTypes(triangleLevel(), {1, 1, 0}),
            (std::vector<unsigned char>{1, 1, 0, 1, 0, 0}));
  EXPECT_EQ(refineBoundaryTypes(triangleLevel(), {0, 0, 0}), std::vector<unsigned char>(6, 0));
  EXPECT_EQ(refineBoundaryTypes(triangleLevel(), {1, 1, 1}), std::vector<unsigned char>(6, 1));
}

TEST(Subdivision, TypesForAnotherMeshAreRefused) {
  EXPECT_EQ(refusal([] {
              refineBoundaryTypes(triangleLevel(), {1, 1});
            }),
            "there are 2 boundary types for 3 old vertices");
  EXPECT_EQ(refusal([] {
              refineBoundaryTypes(triangleLevel(), {1, 1, 0, 0, 0, 0});
            }),
            "there are 6 boundary types for 3 old vertices");
}

TEST(Subdivision, AFinePointsParentIsTheSamePlaceOfAFlatSurface) {
  const auto coarse = box({1, 1, 1}, {2, 2, 2}).mesh();
  const SubdivisionLevel level =
      subdivide(*coarse, findSmoothPatches(*coarse, 30), Subdivision::Flat);
  const SurfaceMesh fine(level.points, level.triangles);
  for (int f = 0; f < fine.triangleCount(); ++f) {
    const SurfacePoint point{f, {0.2, 0.5, 0.3}};
    const SurfacePoint parent = parentPoint(level, coarse->triangles(), point);
    EXPECT_NEAR(parent.barycentric.sum(), 1, 1e-15);
    EXPECT_GE(parent.barycentric.minCoeff(), 0);
    EXPECT_LT((placeOf(*coarse, parent) - placeOf(fine, point)).norm(), 1e-15);
  }
}

class EachSubdivision : public testing::TestWithParam<Subdivision> {};

TEST_P(EachSubdivision, LeadsBackToTheCoarseTriangles) {
  const auto coarse = box({1, 1, 1}, {2, 2, 2}).mesh();
  const Eigen::VectorXi patches = findSmoothPatches(*coarse, 30);
  const SubdivisionLevel level = subdivide(*coarse, patches, GetParam());
  const Eigen::VectorXi fine = refineSmoothPatches(level, patches);
  for (int f = 0; f < level.triangles.cols(); ++f) {
    EXPECT_EQ(fine[f], patches[level.parentTriangle[f]]);
    for (int k = 0; k < 3; ++k) {
      const int vertex = level.triangles(k, f);
      if (vertex >= coarse->vertexCount()) continue;
      const SurfacePoint parent =
          parentPoint(level, coarse->triangles(), {f, Eigen::Vector3d::Unit(k)});
      Eigen::Index corner;
      EXPECT_EQ(parent.barycentric.maxCoeff(&corner), 1);
      EXPECT_EQ(coarse->triangles()(corner, parent.triangle), vertex);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(WithoutOpenMesh, EachSubdivision,
                         testing::Values(Subdivision::Flat, Subdivision::Curved));
#ifdef PALPATE_WITH_OPENMESH
INSTANTIATE_TEST_SUITE_P(WithOpenMesh, EachSubdivision, testing::Values(Subdivision::Loop));
#endif

}  // namespace
}  // namespace palpate::test
