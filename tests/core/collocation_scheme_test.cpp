// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/collocation_scheme.h"

#include <gtest/gtest.h>

#include <set>

#include "support/problems.h"

namespace palpate::test {
namespace {

bool isBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

TEST(TractionNodes, AreTheVerticesOnASmoothSurfaceAndMoreOnEdges) {
  const bem::BodySurface sphere(makeModel(
                                    icosphere(2), [](const auto& x) { return x.z() < 0; }, 1, 0.3),
                                0);
  EXPECT_EQ(sphere.nodes.count(), sphere.vertexCount());
  // A cube of d divisions: 3 nodes a corner, 2 an edge vertex, 1 inside a face.
  const int d = 4;
  const bem::BodySurface cube(makeModel(box({1, 1, 1}, {d, d, d}), isBase, 1, 0.3), 0);
  EXPECT_EQ(cube.nodes.count(), 8 * 3 + 12 * (d - 1) * 2 + 6 * (d - 1) * (d - 1));
}

TEST(TractionNodes, ShareOutTheVertexAreas) {
  const bem::BodySurface cube(makeModel(box({1, 2, 3}, {3, 4, 5}), isBase, 1, 0.3), 0);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(cube.vertexCount()), byTriangles = area;
  for (int node = 0; node < cube.nodes.count(); ++node)
    area[cube.nodes.vertex[node]] += cube.nodes.area[node];
  for (int f = 0; f < cube.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) byTriangles[cube.triangles(k, f)] += cube.areas[f] / 3;
  EXPECT_LT((area - byTriangles).cwiseAbs().maxCoeff(), 1e-15);
}

class Scheme : public testing::TestWithParam<Collocation> {};

TEST_P(Scheme, HasAnEquationForEachUnknown) {
  const auto twoFaces = [](const Eigen::Vector3d& x) { return x.z() < 1e-9 || x.x() < 1e-9; };
  for (const Place& fixed : {Place(isBase), Place(twoFaces)}) {
    const bem::BodySurface body(makeModel(box({1, 1, 1}, {4, 4, 4}), fixed, 1, 0.3), 0);
    const bem::CollocationScheme scheme(body, GetParam());
    int unknowns = static_cast<int>(scheme.tractions.size());
    for (bool isFixed : body.fixed) unknowns += !isFixed;
    EXPECT_EQ(scheme.equationCount(), unknowns);
    std::set<int> columns;
    for (const bem::TractionUnknown& t : scheme.tractions) columns.insert(t.column);
    EXPECT_EQ(columns.size(), scheme.tractions.size());
    for (const bem::CollocationEquation& e : scheme.equations) {
      double sum = 0;
      for (const auto& term : e.terms) sum += term.weight;
      EXPECT_NEAR(sum, 1, 1e-14);
    }
  }
}

TEST_P(Scheme, EquationsStandForTheWholeSurfaceOnce) {
  const bem::BodySurface body(makeModel(box({1, 1, 1}, {4, 4, 4}), isBase, 1, 0.3), 0);
  const bem::CollocationScheme scheme(body, GetParam());
  double area = 0;
  Eigen::Vector3d areaVector = Eigen::Vector3d::Zero();
  for (const bem::CollocationEquation& e : scheme.equations) {
    area += e.area;
    areaVector += e.areaVector;
  }
  EXPECT_NEAR(area, body.areas.sum(), 1e-13);
  EXPECT_NEAR(areaVector.norm(), 0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Scheme,
                         testing::Values(Collocation::Averaged, Collocation::Vertex));

TEST(CollocationScheme, RimOfAFixedFaceHasUnknownTractionOnThatFaceOnly) {
  const bem::BodySurface body(makeModel(box({1, 1, 1}, {3, 3, 3}), isBase, 1, 0.3), 0);
  const bem::CollocationScheme scheme(body, Collocation::Averaged);
  for (const bem::TractionUnknown& t : scheme.tractions) {
    ASSERT_EQ(t.nodes.size(), 1u);
    for (int f = 0; f < body.triangleCount(); ++f)
      for (int k = 0; k < 3; ++k)
        if (body.nodes.ofCorner(k, f) == t.nodes[0]) {
          EXPECT_LT(body.normals(2, f), -0.9);
        }
  }
}

TEST(CollocationScheme, FixedVertexWithoutFixedTriangleHasOneTractionOnAllItsPatches) {
  const Place threeCorners = [](const Eigen::Vector3d& x) {
    return x.norm() < 1e-9 || (x - Eigen::Vector3d(1, 0, 0)).norm() < 1e-9 ||
           (x - Eigen::Vector3d(0, 1, 0)).norm() < 1e-9;
  };
  const bem::BodySurface body(makeModel(box({1, 1, 1}, {3, 3, 3}), threeCorners, 1, 0.3), 0);
  const bem::CollocationScheme scheme(body, Collocation::Averaged);
  ASSERT_EQ(scheme.tractions.size(), 3u);
  for (const bem::TractionUnknown& t : scheme.tractions) EXPECT_EQ(t.nodes.size(), 3u);
}

}  // namespace
}  // namespace palpate::test
