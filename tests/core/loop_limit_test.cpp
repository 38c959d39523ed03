// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/loop_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/loop_subdivision.h"
#include "mesh/rims.h"
#include "mesh/shells.h"
#include "support/data_models.h"
#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

/// Shapes of many valences, from 3 on.
std::vector<Shape> controlMeshes() {
  return {tetrahedron(), bipyramid(3), bipyramid(11), torus(2, 0.5, 5, 4),
          readDataModel("kidney").shape};
}

Shape refined(const Shape& shape) {
  const SubdivisionLevel level = subdivideLoop(*shape.mesh());
  return {level.points, level.triangles};
}

TEST(LoopLimit, OfASubdividedMeshIsThatOfItsControlMesh) {
  for (const Shape& shape : controlMeshes()) {
    const auto mesh = shape.mesh();
    const Eigen::Matrix3Xd once = loopLimit(*refined(shape).mesh());
    EXPECT_LE((once.leftCols(mesh->vertexCount()) - loopLimit(*mesh)).norm(),
              1e-14 * mesh->diagonal() * std::sqrt(mesh->vertexCount()));
  }
}

/// A vertex and the mean of its neighbours move by a matrix of eigenvalues 1 and
/// (3/8 + cos(2 pi / n) / 4)^2, by which a step shortens what is left to the limit.
TEST(LoopLimit, IsWhereSubdivisionLeads) {
  for (const Shape& shape : controlMeshes()) {
    const auto mesh = shape.mesh();
    const Eigen::Matrix3Xd limit = loopLimit(*mesh);
    const Shape fine = refined(shape);
    for (int v = 0; v < mesh->vertexCount(); ++v) {
      const double turn = 2 * std::acos(-1.0) / mesh->trianglesOfVertex(v).size();
      const double shorter = std::pow(0.375 + std::cos(turn) / 4, 2);
      const Eigen::Vector3d left = mesh->points().col(v) - limit.col(v);
      EXPECT_LE((fine.points.col(v) - limit.col(v) - shorter * left).norm(),
                1e-14 * mesh->diagonal())
          << v;
    }
  }
}

double volume(const Shape& control, double share) {
  return enclosedVolume(towardsLoopLimit(*control.mesh(), share), control.triangles);
}

/// All valences are 6. Volumes of the control mesh and of chords are off by the second order, of as
/// much to either side; in between by the fourth.
TEST(LoopLimit, HalfWayThereAMeshEnclosesWhatTheSurfaceDoes) {
  const Shape coarse = torus(2, 0.8, 24, 12), fine = refined(coarse);
  const double truth = volume(refined(refined(fine)), kVolumeShare);
  const auto error = [&](const Shape& control, double share) {
    return volume(control, share) / truth - 1;
  };
  EXPECT_GT(error(fine, 0), 0);
  EXPECT_NEAR(error(fine, 1) / error(fine, 0), -1, 0.1);
  EXPECT_NEAR(std::log2(error(coarse, 0) / error(fine, 0)), 2, 0.1);
  EXPECT_GT(std::log2(error(coarse, kVolumeShare) / error(fine, kVolumeShare)), 3.7);
}

TEST(LoopLimit, IsOfClosedSurfaces) {
  Eigen::Matrix3Xd points(3, 3);
  points << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  const SurfaceMesh open(points, Eigen::Vector3i(0, 1, 2), Rims::Allowed);
  EXPECT_TRUE(isRefused([&] { loopLimit(open); }, "closed surface"));
}

}  // namespace
}  // namespace palpate::test
