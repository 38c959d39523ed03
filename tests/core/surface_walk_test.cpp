// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_walk.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/allocation_count.h"
#include "support/soups.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kPlenty = 1000;

struct Walked {
  SurfaceWalk::Walker end;
  double length = 0;
  int steps = 0;
};

/// Walks step by step and checks that each one is on the surface and goes on where the last ended.
Walked walked(const SurfaceWalk& walk, const SurfacePoint& from, const Eigen::Vector3d& way) {
  Walked result{walk.start(from, way)};
  while (!result.end.hasArrived() && result.steps < kPlenty) {
    const SurfacePoint before = result.end.point;
    const SurfacePoint exit{before.triangle, walk.step(result.end)};
    const Eigen::Vector3d place = placeOf(walk.mesh(), result.end.point);
    result.length += (placeOf(walk.mesh(), exit) - placeOf(walk.mesh(), before)).norm();
    ++result.steps;
    EXPECT_LE((placeOf(walk.mesh(), exit) - place).norm(), 1e-15 * walk.mesh().diagonal());
    EXPECT_GE(result.end.point.barycentric.minCoeff(), 0);
    EXPECT_NEAR(result.end.point.barycentric.sum(), 1, 1e-14);
  }
  EXPECT_TRUE(result.end.hasArrived()) << "after " << result.steps << " steps";
  return result;
}

SurfacePoint randomPoint(const SurfaceMesh& mesh, std::mt19937& random) {
  const Eigen::Vector3d weights = randomVectors(1, random).cwiseAbs();
  return {static_cast<int>(random() % mesh.triangleCount()), weights / weights.sum()};
}

TEST(SurfaceWalk, OnAPlaneIsAStraightLineWhateverTheTriangles) {
  std::mt19937 random(1);
  for (const Shape& shape : {box({1, 1, 1}, {5, 4, 3}), boxWithNeedles(1e-6)}) {
    const SurfaceWalk walk(shape.mesh());
    for (int trial = 0; trial < 500; ++trial) {
      Eigen::Vector3d from = randomVectors(1, random).cwiseAbs(), to = from;
      to = randomVectors(1, random).cwiseAbs();
      // Some of them from and to grid points and along grid lines.
      if (trial % 3 == 0) from = Eigen::Vector3d(1 + trial % 2, 1 + trial % 3, 4) / 4;
      if (trial % 5 == 0) to = Eigen::Vector3d(1 + trial % 3, 1 + trial % 2, 4) / 4;
      from.z() = to.z() = 1;
      const Walked result = walked(walk, nearestSurfacePoint(walk.mesh(), from), to - from);
      // Needles divide the rounding of a coordinate by their width of 1e-6, once an edge; what is
      // lost of the way along them comes back with it.
      EXPECT_LE((placeOf(walk.mesh(), result.end.point) - to).norm(), 1e-13) << trial;
      EXPECT_NEAR(result.length, (to - from).norm(), 1e-13);
    }
  }
}

TEST(SurfaceWalk, TurnsWithTheSurfaceOverAnEdge) {
  const SurfaceWalk walk(box({1, 1, 1}, {4, 4, 4}).mesh());
  // From the top at a slant over the edge x = 1 and down: as on the unfolded sides.
  const SurfacePoint from = nearestSurfacePoint(walk.mesh(), {0.9, 0.21, 1});
  const Walked down = walked(walk, from, {0.5, 0.3, 0});
  EXPECT_LE((placeOf(walk.mesh(), down.end.point) - Eigen::Vector3d(1, 0.51, 0.6)).norm(), 1e-14);
  // Once round the cube and home.
  const Walked round = walked(walk, from, {4, 0, 0});
  EXPECT_LE((placeOf(walk.mesh(), round.end.point) - placeOf(walk.mesh(), from)).norm(), 1e-13);
}

TEST(SurfaceWalk, OnceRoundASphereComesHome) {
  const SurfaceWalk walk(icosphere(4).mesh());
  const SurfacePoint from = nearestSurfacePoint(walk.mesh(), {0.8, 0.1, 0.6});
  const Eigen::Vector3d place = placeOf(walk.mesh(), from);
  const Walked round = walked(walk, from, 2 * kPi * place.unitOrthogonal());
  // Edges of 0.07: chords are short of their arcs by 1e-3, and facets turn the way a little.
  EXPECT_LE((placeOf(walk.mesh(), round.end.point) - place).norm(), 0.02);
}

TEST(SurfaceWalk, KeepsItsLengthAndGetsPastEveryVertex) {
  std::mt19937 random(2);
  for (const Shape& shape : {jitteredSphere(2, 0.2), bipyramid(40), bipyramid(3),
                             torus(1, .3, 9, 7), boxWithNeedles(1e-6), hollowSphere(1, 0.5)}) {
    const SurfaceWalk walk(shape.mesh());
    const SurfaceMesh& mesh = walk.mesh();
    for (int v = 0; v < mesh.vertexCount(); ++v)
      for (int f : mesh.trianglesOfVertex(v)) {
        int corner = 0;
        while (mesh.triangles()(corner, f) != v) ++corner;
        const SurfacePoint at{f, Eigen::Vector3d::Unit(corner)};
        const SurfacePoint off = randomPoint(mesh, random);
        const Eigen::Vector3d way = randomDirection(random);
        // From a vertex; and from within a triangle straight at its corner and on.
        const Eigen::Vector3d through =
            3 * (placeOf(mesh, at) - placeOf(mesh, {f, off.barycentric}));
        for (const auto& [start, ahead] :
             {std::pair(at, way), std::pair(SurfacePoint{f, off.barycentric}, through)}) {
          const Walked result = walked(walk, start, ahead);
          EXPECT_NEAR(result.length, ahead.norm(), 1e-9) << "steps " << result.steps;
          EXPECT_EQ(mesh.shellOfVertex(mesh.triangles()(0, result.end.point.triangle)),
                    mesh.shellOfVertex(v));
        }
      }
  }
}

TEST(SurfaceWalk, InPiecesIsTheSameWalk) {
  std::mt19937 random(3);
  const SurfaceWalk walk(jitteredSphere(2, 0.2).mesh());
  for (int trial = 0; trial < 100; ++trial) {
    const SurfacePoint from = randomPoint(walk.mesh(), random);
    const Eigen::Vector3d way = randomDirection(random);
    const SurfaceWalk::Walker whole = walk.walk(from, way, kPlenty);
    SurfaceWalk::Walker piece = walk.walk(from, way, 2);
    for (int i = 0; i < 100 && !piece.hasArrived(); ++i)
      piece = walk.walk(piece.point, piece.ahead, 2);
    // What rounding turns a way by at each of a few tens of edges.
    EXPECT_LE((placeOf(walk.mesh(), piece.point) - placeOf(walk.mesh(), whole.point)).norm(),
              1e-12);
  }
}

TEST(SurfaceWalk, NeighboursAreEachOthers) {
  const SurfaceWalk walk(jitteredSphere(2, 0.2).mesh());
  for (int f = 0; f < walk.mesh().triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int g = walk.neighbour(f, k);
      EXPECT_TRUE(walk.neighbour(g, 0) == f || walk.neighbour(g, 1) == f ||
                  walk.neighbour(g, 2) == f);
    }
}

TEST(SurfaceWalk, AWayThatLeadsNowhereStays) {
  const SurfaceWalk walk(icosphere(1).mesh());
  const SurfacePoint from{3, {0.2, 0.3, 0.5}};
  for (const Eigen::Vector3d& way :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(NAN, 1, 0), Eigen::Vector3d(INFINITY, 0, 0),
        Eigen::Vector3d(walk.mesh().triangleNormals().col(3))}) {
    const SurfaceWalk::Walker walker = walk.walk(from, way, kPlenty);
    EXPECT_TRUE(walker.hasArrived());
    EXPECT_EQ(walker.point.triangle, from.triangle);
    EXPECT_EQ(walker.point.barycentric, from.barycentric);
  }
}

TEST(SurfaceWalk, AllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  const SurfaceWalk walk(jitteredSphere(2, 0.2).mesh());
  const long before = allocationCount();
  const SurfaceWalk::Walker walker = walk.walk({0, {0.2, 0.3, 0.5}}, {10, 2, 1}, kPlenty);
  EXPECT_EQ(allocationCount(), before);
  EXPECT_TRUE(walker.hasArrived());
}

}  // namespace
}  // namespace palpate::test
