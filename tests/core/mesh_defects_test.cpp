// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_defects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/shells.h"
#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

const double kInfinity = std::numeric_limits<double>::infinity();

std::vector<MeshDefect> defectsOf(const Shape& shape) {
  return findMeshDefects(shape.points, shape.triangles);
}

/// Expects the soup's first defect to be this one, and SurfaceMesh to refuse it in these words.
void expectFirstDefect(const Shape& shape, MeshDefectKind kind, int index,
                       const std::string& text) {
  const std::string sentence = std::string(nameOf(kind)) + ": " + text;
  const std::vector<MeshDefect> defects = defectsOf(shape);
  ASSERT_FALSE(defects.empty()) << sentence;
  EXPECT_EQ(defects.front().kind, kind);
  EXPECT_EQ(defects.front().index, index);
  EXPECT_EQ(defects.front().sentence, sentence);
  EXPECT_EQ(refusal([&] { shape.mesh(); }), sentence);
}

TEST(MeshDefects, SoundSurfacesHaveNone) {
  for (const Shape& shape :
       {tetrahedron(), icosphere(2), box({1, 1, 1}, {3, 2, 1}), torus(2, 0.5, 9, 5), bipyramid(3),
        bipyramid(40), hollowSphere(1, 0.4), renumbered(torus(2, 0.5, 9, 5))}) {
    EXPECT_TRUE(defectsOf(shape).empty());
    EXPECT_TRUE(findOrientationDefects(findShells(shape.points, shape.triangles)).empty());
  }
}

TEST(MeshDefects, GoByTheirUsualNames) {
  EXPECT_STREQ(nameOf(MeshDefectKind::OpenBoundary), "open boundary");
  EXPECT_STREQ(nameOf(MeshDefectKind::NonManifoldEdge), "non-manifold edge");
  EXPECT_STREQ(nameOf(MeshDefectKind::InconsistentOrientation), "inconsistent orientation");
  EXPECT_STREQ(nameOf(MeshDefectKind::SelfIntersection), "self-intersection");
}

TEST(MeshDefects, ASurfaceWithoutTrianglesIsRefused) {
  expectFirstDefect({Eigen::Matrix3Xd(3, 0), Eigen::Matrix3Xi(3, 0)}, MeshDefectKind::Empty, -1,
                    "the surface has no triangles");
  expectFirstDefect({icosphere(0).points, Eigen::Matrix3Xi(3, 0)}, MeshDefectKind::Empty, -1,
                    "the surface has no triangles");
}

TEST(MeshDefects, ANonFiniteCoordinateNamesItsVertexAndValue) {
  Shape shape = tetrahedron();
  shape.points(1, 3) = std::numeric_limits<double>::quiet_NaN();
  expectFirstDefect(shape, MeshDefectKind::NonFiniteCoordinate, 3,
                    "vertex 3 has a coordinate that is not a usable number (0, nan, 1)");
  shape.points(1, 3) = -kInfinity;
  expectFirstDefect(shape, MeshDefectKind::NonFiniteCoordinate, 3,
                    "vertex 3 has a coordinate that is not a usable number (0, -inf, 1)");
}

TEST(MeshDefects, ACoordinateWhoseVolumesOverflowIsRefused) {
  Shape shape = tetrahedron();
  shape.points(0, 1) = 1e61;
  expectFirstDefect(shape, MeshDefectKind::NonFiniteCoordinate, 1,
                    "vertex 1 has a coordinate that is not a usable number (1e+61, 0, 0)");
}

TEST(MeshDefects, AnIndexOutOfRangeNamesItsTriangleAndValue) {
  Shape shape = tetrahedron();
  shape.triangles(2, 1) = 4;
  expectFirstDefect(shape, MeshDefectKind::IndexOutOfRange, 1,
                    "triangle 1 refers to vertex 4, but there are only 4 vertices");
  shape.triangles(2, 1) = -1;
  expectFirstDefect(shape, MeshDefectKind::IndexOutOfRange, 1,
                    "triangle 1 refers to vertex -1, but there are only 4 vertices");
}

TEST(MeshDefects, ATriangleWithARepeatedVertexIsDegenerate) {
  expectFirstDefect(withTriangle(tetrahedron(), {0, 0, 1}), MeshDefectKind::DegenerateTriangle, 4,
                    "triangle 4 (0, 0, 1) is degenerate: height 0 over longest edge 1");
}

TEST(MeshDefects, ATriangleWithoutHeightIsDegenerate) {
  const Shape shape = withVertex(tetrahedron(), {0.5, 0, 0});
  expectFirstDefect(withTriangle(shape, {0, 1, 4}), MeshDefectKind::DegenerateTriangle, 4,
                    "triangle 4 (0, 1, 4) is degenerate: height 0 over longest edge 1");
}

TEST(MeshDefects, ATriangleIsDegenerateByItsShapeNotItsSize) {
  for (double scale : {1e-40, 1e-6, 1.0, 1e6, 1e40}) {
    const Eigen::Vector3d a(0, 0, 0), b(scale, 0, 0);
    EXPECT_FALSE(isDegenerateTriangle(a, b, {scale / 2, 2e-10 * scale, 0})) << scale;
    EXPECT_TRUE(isDegenerateTriangle(a, b, {scale / 2, 0.5e-10 * scale, 0})) << scale;
  }
  EXPECT_TRUE(isDegenerateTriangle({0, 0, 0}, {1e-71, 0, 0}, {0, 1e-71, 0}));  // squares vanish
}

TEST(MeshDefects, ARepeatedTriangleNamesBoth) {
  // Tetrahedron's triangle 1 from another corner and turned round: still the same one.
  const Shape shape = tetrahedron();
  const Eigen::Vector3i t = shape.triangles.col(1);
  expectFirstDefect(withTriangle(shape, {t[1], t[0], t[2]}), MeshDefectKind::DuplicateTriangle, 4,
                    "triangle 4 repeats triangle 1");
}

TEST(MeshDefects, AnUnusedVertexIsNamed) {
  expectFirstDefect(withVertex(tetrahedron(), {2, 2, 2}), MeshDefectKind::UnusedVertex, 4,
                    "vertex 4 is in no triangle");
}

TEST(MeshDefects, ADuplicateVertexNamesItsTwin) {
  const Shape two = tetrahedron().with(tetrahedron().moved({0, 0, 1}));  // 3 and 4 are at (0, 0, 1)
  expectFirstDefect(two, MeshDefectKind::DuplicateVertex, 4,
                    "vertex 4 lies on vertex 3 (distance 0)");
}

TEST(MeshDefects, VerticesAreDuplicatesWithinABillionthOfTheDiagonal) {
  const Shape shape = tetrahedron();
  const double diagonal = std::sqrt(3.0);
  for (double scale : {1e-30, 1.0, 1e30}) {
    const auto withNeighbour = [&](double distance) {
      const Shape other =
          tetrahedron().scaled(0.1).moved({-0.1, 0, 0}).mapped([&](const Eigen::Vector3d& x) {
            return Eigen::Vector3d(x - Eigen::Vector3d(distance, 0, 0));
          });
      return shape.with(other).scaled(scale);
    };
    // The soup's diagonal is a little longer than the tetrahedron's.
    EXPECT_FALSE(defectsOf(withNeighbour(0.5e-9 * diagonal)).empty());
    EXPECT_TRUE(defectsOf(withNeighbour(2e-9 * diagonal)).empty());
  }
}

TEST(MeshDefects, ANonManifoldEdgeNamesItsEndsAndTriangleCount) {
  const Shape cubes = twoCubesAtAnEdge();
  const std::vector<MeshDefect> defects = defectsOf(cubes);
  ASSERT_EQ(defects.size(), 1u);
  // The shared edge: the two vertices at (1, 1, z).
  std::vector<int> ends;
  for (int v = 0; v < cubes.points.cols(); ++v)
    if (cubes.points.col(v).head<2>() == Eigen::Vector2d(1, 1)) ends.push_back(v);
  ASSERT_EQ(ends.size(), 2u);
  int first = 0;
  while (!(cubes.triangles.col(first).array() == ends[0]).any() ||
         !(cubes.triangles.col(first).array() == ends[1]).any())
    ++first;
  expectFirstDefect(cubes, MeshDefectKind::NonManifoldEdge, first,
                    "edge (" + std::to_string(ends[0]) + ", " + std::to_string(ends[1]) +
                        ") belongs to 4 triangles (the first is " + std::to_string(first) +
                        "): the surface is not a manifold there");
}

TEST(MeshDefects, AnOpenBoundaryNamesItsEdgeAndTriangle) {
  // Without triangle 3 (1, 2, 3) the edges (1, 2), (1, 3), (2, 3) are open; 0 holds the first.
  const Shape open = withoutTriangle(tetrahedron(), 3);
  EXPECT_EQ(defectsOf(open).size(), 3u);
  expectFirstDefect(open, MeshDefectKind::OpenBoundary, 0,
                    "edge (1, 2) belongs to triangle 0 alone: the surface is open there, but it "
                    "must be closed");
}

TEST(MeshDefects, AFlippedTriangleIsNamedWithItsNeighbour) {
  const Shape flipped = withTriangleFlipped(tetrahedron(), 3);
  EXPECT_EQ(defectsOf(flipped).size(), 3u);  // one for each of its edges
  expectFirstDefect(flipped, MeshDefectKind::InconsistentOrientation, 3,
                    "triangles 0 and 3 run in opposite senses at edge (1, 2): one of them is "
                    "flipped");
}

TEST(MeshDefects, ANonManifoldVertexIsNamed) {
  expectFirstDefect(twoConesAtAPoint(), MeshDefectKind::NonManifoldVertex, 0,
                    "at vertex 0 two sheets of the surface touch in a point");
}

/// Expects the shells of an otherwise sound surface to have just this defect.
void expectOrientationDefect(const Shape& shape, MeshDefectKind kind, int index,
                             const std::string& text) {
  const std::string sentence = std::string(nameOf(kind)) + ": " + text;
  ASSERT_TRUE(defectsOf(shape).empty());
  const auto defects = findOrientationDefects(findShells(shape.points, shape.triangles));
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects.front().kind, kind);
  EXPECT_EQ(defects.front().index, index);
  EXPECT_EQ(defects.front().sentence, sentence);
  EXPECT_EQ(refusal([&] { shape.mesh(); }), sentence);
}

TEST(MeshDefects, AnInsideOutSurfaceNamesATriangleOfIt) {
  const Shape outward = icosphere(0), inward = icosphere(0).flipped().moved({4, 0, 0});
  expectOrientationDefect(outward.with(inward), MeshDefectKind::InwardOrientation, 20,
                          "the surface is inside out at triangle 20: its normals must point "
                          "outwards");
}

TEST(MeshDefects, ACavityThatPointsIntoTheMaterialIsNamed) {
  expectOrientationDefect(icosphere(1).with(icosphere(0).scaled(0.5)),
                          MeshDefectKind::InwardOrientation, 80,
                          "the cavity of triangle 80 is not a hole: its normals must point out of "
                          "the material, into the cavity");
}

TEST(MeshDefects, ASurfaceThatEnclosesNothingIsNamed) {
  const Shape flat = flatBipyramid(4);
  expectOrientationDefect(icosphere(0).moved({4, 0, 0}).with(flat), MeshDefectKind::NoVolume, 20,
                          "the surface of triangle 20 encloses no volume");
}

TEST(MeshDefects, NoMoreAreListedThanAskedFor) {
  const Shape torn = tornApart(icosphere(1));
  EXPECT_EQ(defectsOf(torn).size(), 16u);
  EXPECT_EQ(findMeshDefects(torn.points, torn.triangles, 3).size(), 3u);
}

TEST(NearestDuplicates, NameTheLowestVertexAtThePlaceHoweverFarTheOrigin) {
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 1, 0, 1, 0,  //
      0, 0, 0, 0, 3,        //
      0, 0, 0, 0, 0;
  const std::vector<int> expected{0, 1, 0, 1, 4};
  for (double away : {0.0, 1e3, 1e12})
    EXPECT_EQ(nearestDuplicates(points.array() + away, 0), expected);
  EXPECT_EQ(nearestDuplicates(points, 1.5), (std::vector<int>{0, 0, 0, 0, 4}));
  EXPECT_TRUE(nearestDuplicates(Eigen::Matrix3Xd(3, 0), 1).empty());
}

}  // namespace
}  // namespace palpate::test
