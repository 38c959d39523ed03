// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/refusals.h"
#include "support/shapes.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

TEST(NearestSurfacePoint, IsNearerThanAnyOther) {
  const auto mesh = jitteredSphere(2, 0.2).mesh();
  std::mt19937 random(41);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Vector3d place = 1.5 * randomVectors(1, random);
    const SurfacePoint nearest = nearestSurfacePoint(*mesh, place);
    EXPECT_GE(nearest.barycentric.minCoeff(), 0);
    EXPECT_NEAR(nearest.barycentric.sum(), 1, 1e-15);
    const double distance = (placeOf(*mesh, nearest) - place).norm();
    for (int other = 0; other < 2000; ++other) {
      const Eigen::Vector3d weights = randomVectors(1, random).cwiseAbs();
      const SurfacePoint point{other % mesh->triangleCount(), weights / weights.sum()};
      EXPECT_LE(distance, (placeOf(*mesh, point) - place).norm() * (1 + 1e-14));
    }
    // On the surface itself it is the point, but for rounding.
    const Eigen::Vector3d on = placeOf(*mesh, nearest);
    EXPECT_LE((placeOf(*mesh, nearestSurfacePoint(*mesh, on)) - on).norm(), 1e-15);
  }
  for (int v = 0; v < mesh->vertexCount(); ++v)
    EXPECT_EQ(placeOf(*mesh, nearestSurfacePoint(*mesh, mesh->points().col(v))),
              mesh->points().col(v));
}

TEST(NearestSurfacePoint, IsRefusedToWhatIsNoPlace) {
  EXPECT_TRUE(isRefused(
      [] {
        nearestSurfacePoint(*icosphere(0).mesh(), {0, INFINITY, 0});
      },
      "the point to touch is not a finite number"));
}

}  // namespace
}  // namespace palpate::test
