// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "mesh/mesh_defects.h"
#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

std::vector<MeshDefect> crossingsOf(const Shape& shape, std::size_t largestCount = 16) {
  return findSelfIntersections(*shape.mesh(), largestCount);
}

TEST(SelfIntersections, SoundSurfacesHaveNone) {
  for (const Shape& shape : {icosphere(2), box({1, 1, 1}, {3, 2, 1}), torus(2, 0.5, 12, 7),
                             hollowSphere(2, 0.9), jitteredSphere(2, 0.2)})
    EXPECT_TRUE(crossingsOf(shape).empty());
}

TEST(SelfIntersections, OfSheetsAreFoundAndTheirRimsAreNone) {
  EXPECT_TRUE(findSelfIntersections(*jitteredPlate(1, 4, 0.3).sheet()).empty());
  // Two pieces of one plane that overlap.
  const Shape piece = plate(1, 2);
  EXPECT_FALSE(findSelfIntersections(*piece.with(piece.moved({0.3, 0.2, 0})).sheet()).empty());
  EXPECT_TRUE(findSelfIntersections(*piece.with(piece.moved({1.2, 0, 0})).sheet()).empty());
}

TEST(SelfIntersections, ANeedleThroughAFaceNamesTheTwoTriangles) {
  // Triangle 3 of the lower tetrahedron, its slope, is pierced by the upper one's tip alone.
  Shape needle = bipyramid(3).scaled(0.01);
  needle.points.col(1) << 0, 0, -0.5;
  const Shape both = tetrahedron().with(needle.moved({0.3, 0.3, 0.6}));
  const std::vector<MeshDefect> defects = crossingsOf(both);
  ASSERT_EQ(defects.size(), 3u);  // the needle's three sides
  for (const MeshDefect& defect : defects) {
    EXPECT_EQ(defect.kind, MeshDefectKind::SelfIntersection);
    EXPECT_TRUE(contains(defect.sentence, "self-intersection: triangles "));
    EXPECT_TRUE(contains(defect.sentence, " cut through each other (3 such pairs)"));
    EXPECT_TRUE(contains(defect.sentence, "triangles 3 and ")) << defect.index;
    EXPECT_EQ(defect.index, 3);
  }
}

TEST(SelfIntersections, DoNotDependOnScaleOrPlace) {
  const Shape shape = cubeWithSpikeThroughItsBase();
  const std::size_t count = crossingsOf(shape, 1000).size();
  EXPECT_GT(count, 0u);
  for (double scale : {1e-30, 1e-3, 1e3, 1e30})
    EXPECT_EQ(crossingsOf(shape.scaled(scale), 1000).size(), count) << scale;
  EXPECT_EQ(crossingsOf(shape.moved({100, -200, 300}), 1000).size(), count);
}

TEST(SelfIntersections, NoMoreAreListedThanAskedForButAllAreCounted) {
  const Shape shape = icosphere(2).with(icosphere(2).moved({0.71, 0.13, 0.2}));
  const std::size_t all = crossingsOf(shape, 100000).size();
  ASSERT_GT(all, 4u);
  const std::vector<MeshDefect> some = crossingsOf(shape, 4);
  EXPECT_EQ(some.size(), 4u);
  EXPECT_TRUE(contains(some.front().sentence, "(" + std::to_string(all) + " such pairs)"));
}

}  // namespace
}  // namespace palpate::test
