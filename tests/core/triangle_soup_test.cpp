// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/triangle_soup.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

TriangleSoup clean(const Shape& shape, ChangeList& changes) {
  return cleanSoup(shape.points, shape.triangles, changes);
}
TriangleSoup clean(const Shape& shape) {
  ChangeList changes;
  return clean(shape, changes);
}

TEST(ChangeList, ListsEachThingOnceInOrderAndCutsLongListsShort) {
  ChangeList changes;
  changes.add("moved", {});
  changes.add("moved", {3, 1, 3});
  changes.add("turned", {9, 8, 7, 6, 5, 4, 3, 2, 1});
  EXPECT_EQ(
      changes.changes(),
      (std::vector<std::string>{"moved: 1, 3", "turned: 1, 2, 3, 4, 5, 6, 7, 8, ... (9 in all)"}));
}

TEST(CleanSoup, ASoundSurfaceStaysAsItIs) {
  ChangeList changes;
  const Shape shape = icosphere(1);
  const TriangleSoup soup = clean(shape, changes);
  EXPECT_TRUE(changes.changes().empty());
  for (int f = 0; f < shape.triangles.cols(); ++f) {
    EXPECT_EQ(soup.triangleOrigin[f], f);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(soup.vertexOrigin[soup.triangles[f][k]], shape.triangles(k, f));
  }
}

TEST(CleanSoup, OriginsNameTheInputsPlaces) {
  const Shape shape = tornApart(renumbered(icosphere(1)));
  const TriangleSoup soup = clean(shape);
  EXPECT_EQ(soup.points.size(), 42u);
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    EXPECT_EQ(soup.points[v], shape.points.col(soup.vertexOrigin[v]));
  for (std::size_t f = 0; f < soup.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(soup.points[soup.triangles[f][k]],
                shape.points.col(shape.triangles(k, soup.triangleOrigin[f])));
}

TEST(CleanSoup, NoNumberIsTooBadForIt) {
  Shape shape = withVertex(tetrahedron(), {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  shape = withVertex(shape, {0, 1e300, 0});
  for (const Eigen::Vector3i& bad :
       {Eigen::Vector3i(0, 1, 4), Eigen::Vector3i(0, 1, 5), Eigen::Vector3i(0, 1, 6),
        Eigen::Vector3i(-1, 0, 1), Eigen::Vector3i(0, std::numeric_limits<int>::max(), 1)})
    shape = withTriangle(shape, bad);
  ChangeList changes;
  EXPECT_EQ(clean(shape, changes).triangles.size(), 4u);
  EXPECT_EQ(changes.changes(),
            (std::vector<std::string>{
                "dropped triangles with unusable indices or coordinates: 4, 5, 6, 7, 8",
                "dropped unused vertices: 4, 5"}));
}

TEST(CleanSoup, AFarUnusedVertexDoesNotWidenTheWeldingDistance) {
  // A billionth of the diagonal with it would be 1, as large as the tetrahedron.
  EXPECT_EQ(clean(withVertex(tetrahedron(), {1e9, 0, 0})).points.size(), 4u);
}

TEST(DropLooseTriangles, AFinGoesFromItsTipToTheSurface) {
  // Two triangles in a row that stand on the edge (0, 1).
  Shape shape = withVertex(withVertex(tetrahedron(), {0.5, -1, 0}), {0.5, -2, 0.1});
  shape = withTriangle(withTriangle(shape, {0, 1, 4}), {1, 4, 5});
  ChangeList changes;
  TriangleSoup soup = clean(shape, changes);
  dropLooseTriangles(soup, changes);
  EXPECT_EQ(soup.triangleOrigin, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(changes.changes(),
            std::vector<std::string>{"dropped triangles that hang from an edge of three: 4, 5"});
}

TEST(DropLooseTriangles, AnOpenSheetInAPlaneGoesAndABentOneStays) {
  const Shape flat = withoutTriangle(withoutTriangle(tetrahedron(), 3), 2).moved({5, 0, 0});
  Shape sheet = flat;  // two triangles with a common edge, in one plane
  sheet.points.col(3) << 5.5, -1, 0;
  for (const auto& [shape, left] : {std::pair{sheet, 4u}, std::pair{flat, 6u}}) {
    ChangeList changes;
    TriangleSoup soup = clean(tetrahedron().with(shape), changes);
    dropLooseTriangles(soup, changes);
    EXPECT_EQ(soup.triangles.size(), left);
    const std::string change = changes.changes().empty() ? "" : changes.changes().back();
    EXPECT_EQ(change == "dropped triangles of flat pieces that enclose nothing: 4, 5", left == 4);
  }
}

TEST(SeparatePieces, PiecesThatTouchGetVerticesOfTheirOwnAtTheSamePlace) {
  TriangleSoup soup = clean(twoCubesAtAnEdge());
  ASSERT_EQ(soup.points.size(), 14u);
  separatePieces(soup);
  ASSERT_EQ(soup.points.size(), 16u);
  for (int copy : {14, 15}) {
    const int origin = soup.vertexOrigin[copy];
    int found = 0;
    for (int v = 0; v < 14; ++v)
      if (soup.vertexOrigin[v] == origin) {
        EXPECT_EQ(soup.points[v], soup.points[copy]);
        ++found;
      }
    EXPECT_EQ(found, 1);
  }
}

TEST(SeparatePieces, AnEdgeWithAWallBehindItIsNotClear) {
  // A tetrahedron divided by a wall of its own: the triangle between the edge (0, 1) and a vertex
  // in the middle of the opposite edge, which is cut there.
  Shape shape = withVertex(tetrahedron(), {0, 0.5, 0.5});
  shape.triangles.resize(3, 7);
  shape.triangles << 0, 0, 0, 0, 1, 1, 0,  //
      2, 1, 4, 3, 2, 4, 1,                 //
      1, 3, 2, 4, 4, 3, 4;
  TriangleSoup soup = clean(shape);
  EXPECT_TRUE(contains(refusal([&] { separatePieces(soup); }),
                       "edge (0, 1) belongs to 3 triangles (0, 1, 6), and it is not clear which of "
                       "them bound a body"));
}

TEST(SeparatePieces, PiecesThatAreBothOpenAtAVertexAreTorn) {
  const Shape up = withoutTriangle(tetrahedron(), 0);
  const Shape down = up.mapped([](const Eigen::Vector3d& x) { return Eigen::Vector3d(-x); });
  TriangleSoup soup = clean(up.with(down).welded());
  EXPECT_TRUE(contains(refusal([&] { separatePieces(soup); }), "the surface is torn at vertex 0"));
}

TEST(RequireTwoSided, AMoebiusStripNamesTwoTriangles) {
  TriangleSoup soup = clean(moebiusStrip(12));
  std::vector<int> same(soup.points.size());
  std::iota(same.begin(), same.end(), 0);
  const std::string sentence = refusal([&] { requireTwoSided(soup, same); });
  EXPECT_TRUE(contains(sentence, "the surface is one-sided: triangles "));
  EXPECT_TRUE(contains(sentence, " cannot both point out of the material"));
  const TriangleSoup sphere = clean(icosphere(0));
  EXPECT_NO_THROW(requireTwoSided(sphere, same));
}

}  // namespace
}  // namespace palpate::test
