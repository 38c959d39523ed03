// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/geodesic_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <thread>

#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

int vertexNear(const SurfaceMesh& mesh, const Eigen::Vector3d& place) {
  Eigen::Index vertex;
  (mesh.points().colwise() - place).colwise().norm().minCoeff(&vertex);
  return static_cast<int>(vertex);
}

TEST(GeodesicDistance, OnASphereIsTheGreatCircle) {
  const auto mesh = jitteredSphere(3, 0.2).mesh();
  const GeodesicDistances distances(*mesh);
  double error = 0, square = 0;
  int count = 0;
  for (int v : {0, 100, 333}) {
    const Eigen::VectorXd d = distances.from(v);
    EXPECT_EQ(d[v], 0);
    for (int u = 0; u < mesh->vertexCount(); ++u) {
      const Eigen::Vector3d a = mesh->points().col(u), b = mesh->points().col(v);
      const double exact = std::atan2(a.cross(b).norm(), a.dot(b));
      if (exact < 0.01) continue;
      error = std::max(error, std::abs(d[u] / exact - 1));
      square += (d[u] / exact - 1) * (d[u] / exact - 1);
      ++count;
    }
  }
  RecordProperty("largest", std::to_string(error));
  RecordProperty("rms", std::to_string(std::sqrt(square / count)));
  EXPECT_LT(error,
            0.1);  // the heat method on an irregular mesh; ways along edges are 15 % too long
  EXPECT_LT(std::sqrt(square / count), 0.03);
}

TEST(GeodesicDistance, GoesRoundTheEdgesOfABox) {
  // From the middle of the top down a side: unfolded, the way is straight.
  const auto mesh = box({1, 1, 1}, {16, 16, 16}).mesh();
  const Eigen::VectorXd d = GeodesicDistances(*mesh).from(vertexNear(*mesh, {0.5, 0.5, 1}));
  for (double down : {0.25, 0.5})
    for (double along : {0.5, 0.625, 0.75}) {
      const double exact = std::hypot(0.5 + down, along - 0.5);
      EXPECT_NEAR(d[vertexNear(*mesh, {1, along, 1 - down})] / exact, 1, 0.03);
    }
}

TEST(GeodesicDistance, OnASheetEndsAtItsRim) {
  const auto mesh = jitteredPlate(1, 24, 0.2).sheet();
  const GeodesicDistances distances(*mesh);
  for (const Eigen::Vector3d& from : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.5, 0.1, 0)}) {
    const int vertex = vertexNear(*mesh, from);
    const Eigen::VectorXd d = distances.from(vertex);
    double square = 0;
    for (int v = 0; v < mesh->vertexCount(); ++v) {
      const double exact = (mesh->points().col(v) - mesh->points().col(vertex)).norm();
      if (v != vertex) square += std::pow(d[v] / exact - 1, 2) / mesh->vertexCount();
    }
    EXPECT_LT(std::sqrt(square), 0.05);
  }
}

TEST(GeodesicDistance, IsBetweenTheStraightOneAndTheWayAlongEdgesAndKnowsTheFarSideOfAWall) {
  const auto mesh = box({1, 1, 0.05}, {8, 8, 1}).mesh();
  const GeodesicDistances distances(*mesh);
  const int top = vertexNear(*mesh, {0.5, 0.5, 0.05}), below = vertexNear(*mesh, {0.5, 0.5, 0});
  const Eigen::VectorXd d = distances.from(top);
  for (int v = 0; v < mesh->vertexCount(); ++v)
    EXPECT_GE(d[v], (mesh->points().col(v) - mesh->points().col(top)).norm());
  EXPECT_NEAR(d[below] / 1.05, 1, 0.05) << "to the rim, down, and back";
}

TEST(GeodesicDistance, ToAnotherShellIsInfinite) {
  const Shape ball = icosphere(1);
  const auto mesh = ball.with(ball.moved({2.00001, 0, 0})).mesh();
  const GeodesicDistances distances(*mesh);
  for (int source : {3, 42 + 3}) {
    const Eigen::VectorXd d = distances.from(source);
    for (int v = 0; v < 84; ++v) EXPECT_EQ(std::isfinite(d[v]), v / 42 == source / 42);
  }
}

TEST(GeodesicDistance, ScalesWithTheMeshAndDoesNotDependOnWhatWasAskedBefore) {
  const Shape shape = jitteredSphere(2, 0.2);
  const auto metres = shape.mesh(), micrometres = shape.scaled(1e6).mesh();
  const GeodesicDistances small(*metres), large(*micrometres);
  const Eigen::VectorXd first = small.from(7);
  EXPECT_LE((1e6 * first - large.from(7)).norm(), 1e-6 * large.from(7).norm());
  Eigen::VectorXd others[2];
  std::thread one([&] { others[0] = small.from(80); }), two([&] { others[1] = small.from(7); });
  one.join();
  two.join();
  EXPECT_EQ(others[1], first);
  EXPECT_NE(others[0], first);
}

TEST(GeodesicDistance, IsFiniteOnNeedlesAndOnLongMeshes) {
  // Heat dies out within a few hundred edges: 10^-308 of it arrives.
  for (const Shape& shape : {boxWithNeedles(1e-4), box({900, 1, 1}, {900, 1, 1})}) {
    const auto mesh = shape.mesh();
    const Eigen::VectorXd d = GeodesicDistances(*mesh).from(0);
    EXPECT_TRUE(d.allFinite());
    for (int v = 0; v < mesh->vertexCount(); ++v) {
      const double straight = (mesh->points().col(v) - mesh->points().col(0)).norm();
      EXPECT_GE(d[v], straight);
      EXPECT_LE(d[v], 2 * straight + 1e-12) << "no way over a box is longer";
    }
  }
}

TEST(GeodesicDistance, FromAVertexThatIsNotThereIsRefused) {
  const auto mesh = icosphere(1).mesh();
  const GeodesicDistances distances(*mesh);
  for (int v : {-1, 42})
    EXPECT_TRUE(isRefused([&] { distances.from(v); }, "there is no vertex " + std::to_string(v) +
                                                          " to measure distances from"));
}

}  // namespace
}  // namespace palpate::test
