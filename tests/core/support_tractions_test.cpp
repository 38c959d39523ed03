// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/support_tractions.h"

#include <gtest/gtest.h>

#include "support/problems.h"

namespace palpate::test {
namespace {

const Place base = [](const Eigen::Vector3d& x) { return x.z() < 1e-9; };

TEST(SupportShares, KeepEachVertexsForce) {
  for (const Shape& shape : {box({1, 1, 1}, {3, 3, 3}), icosphere(2)}) {
    const ElasticModel model =
        makeModel(shape, shape.points.minCoeff() < -0.5 ? Place(cap) : base, 1, 0.3);
    const SurfaceMesh& mesh = model.mesh();
    const Eigen::Matrix3Xd shares = supportShares(mesh, model.conditions(), model.smoothPatches());
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.vertexCount());
    for (int f = 0; f < mesh.triangleCount(); ++f)
      for (int k = 0; k < 3; ++k)
        areas[mesh.triangles()(k, f)] += shares(k, f) * mesh.triangleAreas()[f] / 3;
    EXPECT_LT((areas - mesh.vertexAreas()).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(SupportShares, OfAHeldBaseAreItsOwn) {
  const ElasticModel model = makeModel(box({1, 1, 1}, {3, 3, 3}), base, 1, 0.3);
  const SurfaceMesh& mesh = model.mesh();
  const Eigen::Matrix3Xd shares = supportShares(mesh, model.conditions(), model.smoothPatches());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles()(k, f);
      const bool below = mesh.triangleNormals()(2, f) < -0.5;
      if (!model.conditions().isFixed(v))
        EXPECT_EQ(shares(k, f), 1);
      else if (below)
        EXPECT_GE(shares(k, f), 1);
      else
        EXPECT_EQ(shares(k, f), 0);
    }
}

}  // namespace
}  // namespace palpate::test
