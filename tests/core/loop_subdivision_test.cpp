// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/loop_subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/LU>
#include <map>
#include <set>

#include "support/data_models.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 1e-14;  // sums of up to 12 terms near 1

SubdivisionLevel refine(const Shape& shape) {
  return subdivideLoop(*shape.mesh());
}
Shape shapeOf(const SubdivisionLevel& level) {
  return {level.points, level.triangles};
}

/// Edge (low, high) to the vertices opposite it.
std::map<std::pair<int, int>, std::vector<int>> edgesOf(const Shape& shape) {
  std::map<std::pair<int, int>, std::vector<int>> edges;
  for (const auto& t : shape.triangles.colwise())
    for (int k = 0; k < 3; ++k) edges[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
  return edges;
}

/// Shapes of many valences, from 3 on.
std::vector<Shape> controlMeshes() {
  return {tetrahedron(),
          bipyramid(3),
          bipyramid(11),
          torus(2, 0.5, 5, 4),
          renumbered(readDataModel("kidney").shape),
          hollowSphere(0, 0.5)};
}

TEST(LoopSubdivision, AVertexMovesByLoopsMask) {
  // (1 - n b) x + b sum of neighbours, b = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n.
  for (const Shape& shape : controlMeshes()) {
    const SubdivisionLevel level = refine(shape);
    std::vector<std::set<int>> neighbours(shape.points.cols());
    for (const auto& [edge, opposite] : edgesOf(shape)) {
      neighbours[edge.first].insert(edge.second);
      neighbours[edge.second].insert(edge.first);
    }
    for (int v = 0; v < shape.points.cols(); ++v) {
      const double n = neighbours[v].size();
      const double b = (0.625 - std::pow(0.375 + std::cos(2 * kPi / n) / 4, 2)) / n;
      Eigen::Vector3d expected = (1 - n * b) * shape.points.col(v);
      for (int other : neighbours[v]) expected += b * shape.points.col(other);
      EXPECT_LT((level.points.col(v) - expected).norm(), kRounding) << "valence " << n;
    }
  }
}

TEST(LoopSubdivision, AnEdgesVertexIsThreeEighthsOfItsEndsAndAnEighthOfTheOpposites) {
  for (const Shape& shape : controlMeshes()) {
    const SubdivisionLevel level = refine(shape);
    const auto edges = edgesOf(shape);
    ASSERT_EQ(level.points.cols(), shape.points.cols() + int(edges.size()));
    std::set<std::pair<int, int>> seen;
    for (Eigen::Index v = shape.points.cols(); v < level.points.cols(); ++v) {
      const std::pair<int, int> edge(level.parents(0, v), level.parents(1, v));
      ASSERT_TRUE(edges.count(edge));
      EXPECT_TRUE(seen.insert(edge).second) << "an edge has one vertex";
      const std::vector<int>& opposite = edges.at(edge);
      const Eigen::Vector3d expected =
          3.0 / 8 * (shape.points.col(edge.first) + shape.points.col(edge.second)) +
          1.0 / 8 * (shape.points.col(opposite[0]) + shape.points.col(opposite[1]));
      EXPECT_LT((level.points.col(v) - expected).norm(), kRounding);
    }
  }
}

TEST(LoopSubdivision, OldVerticesKeepTheirNumbers) {
  const SubdivisionLevel level = refine(icosphere(1));
  for (int v = 0; v < 42; ++v) EXPECT_EQ(level.parents.col(v), Eigen::Vector2i(v, v));
}

TEST(LoopSubdivision, EachTriangleBecomesFourThatLieInItTheSameWayRound) {
  for (const Shape& shape : controlMeshes()) {
    const SubdivisionLevel level = refine(shape);
    ASSERT_EQ(level.triangles.cols(), 4 * shape.triangles.cols());
    std::vector<int> children(shape.triangles.cols(), 0);
    for (Eigen::Index f = 0; f < level.triangles.cols(); ++f) {
      const int parent = level.parentTriangle[f];
      ++children[parent];
      // In the parent's barycentric coordinates a child is half as long and turned the same way.
      Eigen::Matrix3d barycentric = Eigen::Matrix3d::Zero();
      for (int k = 0; k < 3; ++k)
        for (int end : level.parents.col(level.triangles(k, f)))
          for (int j = 0; j < 3; ++j)
            if (shape.triangles(j, parent) == end) barycentric(j, k) += 0.5;
      EXPECT_DOUBLE_EQ(barycentric.determinant(), 0.25);
    }
    for (int count : children) EXPECT_EQ(count, 4);
  }
}

TEST(LoopSubdivision, TopologyAndSoundnessSurvive) {
  for (const Shape& shape : controlMeshes()) {
    const Shape fine = shapeOf(refine(shape));
    EXPECT_EQ(eulerCharacteristic(fine.triangles), eulerCharacteristic(shape.triangles));
    EXPECT_EQ(fine.mesh()->bodyCount(), shape.mesh()->bodyCount());
  }
}

TEST(LoopSubdivision, CommutesWithAffineMaps) {
  const Shape shape = bipyramid(5);
  Eigen::Matrix3d stretch;
  stretch << 2, 1, 0,  //
      0, 3, -1,        //
      0.5, 0, 1;
  const Eigen::Vector3d shift(1, -2, 3);
  const SubdivisionLevel level = refine(shape);
  const SubdivisionLevel mapped =
      refine({(stretch * shape.points).colwise() + shift, shape.triangles});
  EXPECT_LT((mapped.points - ((stretch * level.points).colwise() + shift)).norm(),
            100 * kRounding);  // some 20 points of size 5
  EXPECT_EQ(mapped.triangles, level.triangles);
}

struct Counts {
  const char* name;
  int vertices[3], genus, paperLevel, freeThere;
};
std::ostream& operator<<(std::ostream& out, const Counts& counts) {
  return out << counts.name;
}

class ModelsOfThePaper : public ::testing::TestWithParam<Counts> {};

TEST_P(ModelsOfThePaper, HaveTheVertexCountsOfTables1And2) {
  const DataModel model = readDataModel(GetParam().name);
  Shape shape = model.shape;
  std::vector<unsigned char> types = model.boundaryTypes;
  for (int level = 1; level <= 3; ++level) {
    if (level > 1) {
      const SubdivisionLevel finer = refine(shape);
      types = refineBoundaryTypes(finer, types);
      shape = shapeOf(finer);
    }
    EXPECT_EQ(shape.points.cols(), GetParam().vertices[level - 1]) << "level " << level;
    EXPECT_EQ(types.size(), std::size_t(shape.points.cols()));
    EXPECT_EQ(eulerCharacteristic(shape.triangles), 2 - 2 * GetParam().genus);
    EXPECT_EQ(shape.mesh()->bodyCount(), 1);
    const auto freeCount = std::count(types.begin(), types.end(), 0);
    if (level == GetParam().paperLevel) {
      EXPECT_EQ(freeCount, GetParam().freeThere);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Data, ModelsOfThePaper,
                         ::testing::Values(Counts{"nodule", {34, 130, 514}, 0, 2, 89},
                                           Counts{"kidney", {22, 82, 322}, 0, 3, 217},
                                           Counts{"spatula", {35, 152, 620}, 3, 3, 559},
                                           Counts{"banana_seat", {36, 138, 546}, 0, 3, 245}),
                         [](const auto& info) { return std::string(info.param.name); });

/// OpenMesh tabulates Loop's weights up to 49 edges a vertex; fans of CAD surfaces have more.
TEST(LoopSubdivision, MovesVerticesOfManyEdgesAsLoopSays) {
  for (int edges : {49, 50, 51, 200}) {
    Eigen::Matrix3Xd points(3, edges + 2);
    Eigen::Matrix3Xi triangles(3, 2 * edges);
    for (int i = 0; i < edges; ++i) {
      const double angle = 2 * M_PI * i / edges;
      const int next = (i + 1) % edges;
      points.col(i) << std::cos(angle), std::sin(angle), 0;
      triangles.col(2 * i) << i, next, edges;
      triangles.col(2 * i + 1) << next, i, edges + 1;
    }
    points.col(edges) << 0, 0, 1;
    points.col(edges + 1) << 0, 0, -1;
    const double share = 0.375 + std::cos(2 * M_PI / edges) / 4;
    const double apex = 0.375 + share * share;  // that the apex keeps of itself
    const SubdivisionLevel level = refine({points, triangles});
    EXPECT_NEAR(level.points(2, edges), apex, 1e-12) << edges;
    EXPECT_NEAR(level.points(2, edges + 1), -apex, 1e-12) << edges;
  }
}

}  // namespace
}  // namespace palpate::test
