// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_map.h"

#include <gtest/gtest.h>

#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

/// A field at places between the vertices that it is given at.
Eigen::Matrix3Xd carried(const SurfaceMesh& mesh, const Eigen::Matrix3Xd& field,
                         const std::vector<SurfacePoint>& places) {
  Eigen::Matrix3Xd result(3, places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    result.col(i) =
        field(Eigen::all, mesh.triangles().col(places[i].triangle)) * places[i].barycentric;
  return result;
}

TEST(SurfaceMap, CarriesLinearFieldsOverFlatFacesToRounding) {
  const auto coarse = box({1, 2, 3}, {1, 2, 2}).mesh(), fine = box({1, 2, 3}, {5, 7, 9}).mesh();
  Eigen::Matrix3d slope;
  slope << 0.3, -0.2, 0.5, 1.1, 0.4, -0.7, 0.2, 0.9, -0.6;
  const SurfaceMap map = mapOnto(coarse, fine->points(), fine->vertexNormals());
  EXPECT_LT(map.largestDistance, 1e-14);
  EXPECT_LT((carried(*coarse, slope * coarse->points(), map.places) - slope * fine->points())
                .cwiseAbs()
                .maxCoeff(),
            1e-13);
}

TEST(SurfaceMap, OfASphereErrsInTheSecondOrderOfTheCoarseMesh) {
  const auto fine = icosphere(4).mesh();
  Eigen::Vector2d error, distance;
  for (int level = 1; level <= 2; ++level) {
    const auto coarse = icosphere(level).mesh();
    const SurfaceMap map = mapOnto(coarse, fine->points(), fine->vertexNormals());
    const auto squares = [](const Eigen::Matrix3Xd& x) -> Eigen::Matrix3Xd {
      return x.cwiseProduct(x);
    };
    error[level - 1] =
        (carried(*coarse, squares(coarse->points()), map.places) - squares(fine->points()))
            .cwiseAbs()
            .maxCoeff();
    distance[level - 1] = map.largestDistance;
  }
  EXPECT_NEAR(error[0] / error[1], 4, 1);
  EXPECT_NEAR(distance[0] / distance[1], 4, 1);
}

TEST(SurfaceMap, StaysOnItsSideOfAWallThatIsThinnerThanItsMeshesDiffer) {
  // Two walls of one thickness, displaced across it: the far side of the one is nearest to the near
  // side of the other.
  const double thickness = 0.01;
  const auto wall = box({1, 1, thickness}, {4, 4, 1}).mesh();
  Eigen::Matrix3Xd points = wall->points();
  points.row(2).array() += 0.8 * thickness;
  const SurfaceMap map = mapOnto(wall, points, wall->vertexNormals());
  int inside = 0;
  for (int v = 0; v < wall->vertexCount(); ++v) {
    const Eigen::Vector3d x = wall->points().col(v), normal = wall->vertexNormals().col(v);
    if (x.head<2>().minCoeff() < 0.01 || x.head<2>().maxCoeff() > 0.99) continue;
    ++inside;
    EXPECT_GT(wall->triangleNormals().col(map.places[v].triangle).dot(normal), 0.9) << v;
    EXPECT_LT((placeOf(*wall, map.places[v]) - wall->points().col(v)).norm(), 1e-12) << v;
  }
  EXPECT_EQ(inside, 18);
}

TEST(SurfaceMap, RefusesPointsWithoutNormals) {
  const auto mesh = icosphere(1).mesh();
  EXPECT_TRUE(isRefused([&] { mapOnto(mesh, mesh->points(), Eigen::Matrix3Xd(3, 2)); },
                        "points and normals of 2"));
}

}  // namespace
}  // namespace palpate::test
