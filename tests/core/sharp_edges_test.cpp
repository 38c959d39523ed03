// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/problems.h"

namespace palpate::test {
namespace {

struct BlockResult {
  Eigen::Matrix3Xd response, applied;
  std::shared_ptr<const GreensFunctions> greens;
  Eigen::Vector3d reaction;
  Eigen::Vector3d at(const ElasticModel& model, const Eigen::Vector3d& place) const {
    Eigen::Index nearest;
    (model.mesh().points().colwise() - place).colwise().norm().minCoeff(&nearest);
    return response.col(nearest);
  }
};

/// A block with its base z = 0 fixed and unit traction on its top.
BlockResult loadTop(const ElasticModel& model, const Eigen::Vector3d& traction, double top) {
  BoundaryElementOptions options = raw();
  options.patchColumns = true;
  BlockResult result;
  result.greens = computeGreens(model, options);
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, model.mesh().triangleCount());
  for (int f = 0; f < model.mesh().triangleCount(); ++f) {
    const double height = model.mesh().points()(2, model.mesh().triangles()(0, f));
    if (model.mesh().triangleNormals()(2, f) > 0.9 && height > top - 1e-9)
      tractions.col(f) = traction;
  }
  result.response = solveFaceTractions(*result.greens, model.mesh(), model.smoothPatches(),
                                       tractions, result.applied);
  result.reaction = Eigen::Vector3d::Zero();
  for (int v : model.conditions().fixedNodes())
    result.reaction += result.greens->vertexArea(v) * result.response.col(v);
  return result;
}

bool isBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

TEST(SharpEdges, CubeUnderUnitTractionMovesAsTheFiniteElementReference) {
  const ElasticModel model = makeModel(box({1, 1, 1}, {12, 12, 12}), isBase, 1, 0.3);
  const Eigen::Vector3d centre(0.5, 0.5, 1);
  // hp finite elements, error <= 1e-5: top centre along the load.
  const BlockResult normal = loadTop(model, {0, 0, 1}, 1);
  const BlockResult shear = loadTop(model, {1, 0, 0}, 1);
  EXPECT_NEAR(normal.at(model, centre).z() / 0.964754, 1, 0.01);
  EXPECT_NEAR(shear.at(model, centre).x() / 6.71156, 1, 0.01);
  EXPECT_NEAR((normal.applied.rowwise().sum() - Eigen::Vector3d(0, 0, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR((normal.reaction + Eigen::Vector3d(0, 0, 1)).norm(), 0, 0.005);
  EXPECT_NEAR((shear.reaction + Eigen::Vector3d(1, 0, 0)).norm(), 0, 0.005);
}

TEST(SharpEdges, CantileverBendsAsTheThreeDimensionalReference) {
  for (int d : {4, 6}) {
    const ElasticModel model = makeModel(box({1, 1, 8}, {d, d, 8 * d}), isBase, 1, 0.3);
    const BlockResult shear = loadTop(model, {1, 0, 0}, 8);
    EXPECT_NEAR(shear.at(model, {0.5, 0.5, 8}).x() / 2055.45, 1, 0.04);
    const BlockResult axial = loadTop(model, {0, 0, 1}, 8);
    EXPECT_NEAR(axial.at(model, {0.5, 0.5, 8}).z() / 7.97048, 1, 0.04);
  }
}

TEST(SharpEdges, TwoFixedPatchesThatMeetAtAnEdgeStayWellConditioned) {
  for (int d : {4, 8, 12}) {
    const auto corner = [](const Eigen::Vector3d& x) { return x.z() < 1e-9 || x.x() < 1e-9; };
    const ElasticModel model = makeModel(box({1, 1, 1}, {d, d, d}), corner, 1, 0.3);
    const BlockResult result = loadTop(model, {0, 0, 1}, 1);
    EXPECT_LT(result.greens->info().diagnostics.conditionEstimate, 1e4);
  }
}

TEST(SharpEdges, OneTractionPerVertexIsTheSameOnASmoothSurface) {
  const auto cap = [](const Eigen::Vector3d& x) { return x.z() < -0.79; };
  const auto patches =
      computeBoundaryElementGreensFunctions(makeModel(icosphere(2), cap, 1, 0.3, 30), raw());
  const auto whole =
      computeBoundaryElementGreensFunctions(makeModel(icosphere(2), cap, 1, 0.3, 180), raw());
  EXPECT_TRUE(std::equal(patches.matrix.data(), patches.matrix.data() + patches.matrix.size(),
                         whole.matrix.data()));
}

TEST(SharpEdges, OneTractionPerVertexWrapsLoadsRoundTheEdgesOfACube) {
  // The hats of the top's rim reach down the sides: 1 + 4 * (1/2 * 1/12) = 1.1667 of the force.
  const ElasticModel model = makeModel(box({1, 1, 1}, {12, 12, 12}), isBase, 1, 0.3, 180);
  const auto greens = computeGreens(model, raw());
  double applied = 0;
  for (int v = 0; v < model.mesh().vertexCount(); ++v)
    if (model.mesh().points()(2, v) > 1 - 1e-9) applied += greens->vertexArea(v);
  EXPECT_NEAR(applied, 1 + 4 * 0.5 / 12, 1e-12);
}

}  // namespace
}  // namespace palpate::test
