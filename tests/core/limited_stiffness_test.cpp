// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What is served where a vertex's compliance alone would lead astray: thin walls, blades.

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "contact/surface_stiffness.h"
#include "support/contact_bodies.h"
#include "support/mask_compliances.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

TEST(SurfaceStiffness, OfABodyThatYieldsTheWrongWayIsRefused) {
  SyntheticBody synthetic;
  const auto greens = denseGreens(synthetic.info(), -synthetic.matrix());
  EXPECT_TRUE(isRefused<std::runtime_error>(
      [&] {
        maskedVertexStiffness(*greens, 3, {{3}, Eigen::VectorXd::Ones(1)});
      },
      "the compliance at vertex 3 is not positive definite: the surface is inside out there"));
}

bool atTheEdge(const Eigen::Vector3d& x) {
  return x.x() < 1e-9;
}

TEST(SurfaceStiffness, MovesTheVerticesOfABladeAsItIsToldTo) {
  const Shape blade = box({2, 1, 0.3}, {16, 8, 2}).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y(), x.z() + 0.2 * x.x() * x.x());
  });
  const ElasticModel model = makeModel(blade, atTheEdge, 1, 0.3);
  const auto greens = computeGreens(model, {});
  const SurfaceStiffness stiffness(greens, blade.mesh(), MaskShape::Linear, 0.25);
  std::vector<double> errors, errorsOfTheMean;
  for (int v : model.conditions().freeNodes()) {
    const Eigen::Matrix3d b = vertexCompliance(*greens, v, stiffness.mask(v));
    errors.push_back((b * stiffness.elastic(v) - Eigen::Matrix3d::Identity()).norm());
    errorsOfTheMean.push_back(((b - b.transpose()) * (b + b.transpose()).inverse()).norm());
  }
  std::sort(errors.begin(), errors.end());
  std::sort(errorsOfTheMean.begin(), errorsOfTheMean.end());
  EXPECT_LT(errors[errors.size() / 2], 0.05);
  EXPECT_LT(errors.back(), 0.5);
  EXPECT_GT(errorsOfTheMean[errors.size() / 2], 5 * errors[errors.size() / 2]);
}

TEST(SurfaceStiffness, OfThinWallsIsNowhereMoreThanTwiceThatOfTheMean) {
  const Shape plate = box({1, 1, 0.1}, {8, 8, 1});
  const ElasticModel model = makeModel(plate, atTheEdge, 1, 0.3);
  const auto greens = computeGreens(model, {});
  int limited = 0;
  for (const double radius : {0.2, 0.4}) {
    const SurfaceStiffness stiffness(greens, plate.mesh(), MaskShape::Linear, radius);
    for (int v : model.conditions().freeNodes()) {
      const Eigen::Matrix3d& k = stiffness.elastic(v);
      EXPECT_EQ(k, k.transpose());
      const Eigen::LLT<Eigen::Matrix3d> mean(meanCompliance(*greens, stiffness.mask(v)));
      ASSERT_EQ(mean.info(), Eigen::Success);
      const Eigen::Matrix3d root = mean.matrixL();
      const Eigen::Vector3d ratios =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(root.transpose() * k * root).eigenvalues();
      EXPECT_GT(ratios[0], 0);
      EXPECT_LE(ratios[2], 2 + 1e-6);
      EXPECT_EQ(stiffness.isLimited(v), ratios[2] > 2 - 1e-6);
      limited += stiffness.isLimited(v);
    }
  }
  EXPECT_GT(limited, 0);
}

TEST(SurfaceStiffness, OfWallsFarThinnerThanEdgesIsPositiveDefiniteOrRefusedVertexByVertex) {
  const Shape plate = box({1, 1, 0.05}, {8, 8, 1});
  for (const double nu : {-0.5, 0.0}) {
    const ElasticModel model = makeModel(plate, atTheEdge, 1, nu);
    const auto greens = computeGreens(model, {});
    const SurfaceStiffness stiffness(greens, plate.mesh(), MaskShape::Linear, 0.2);
    int unserved = 0;
    const std::vector<int> free = model.conditions().freeNodes();
    for (int v : free) {
      if (stiffness.elastic(v).hasNaN()) {
        ++unserved;
        EXPECT_TRUE(isRefused<std::runtime_error>([&] { stiffness.requireServed(v); },
                                                  "the compliance at vertex "));
      } else {
        const Eigen::Matrix3d& k = stiffness.elastic(v);
        EXPECT_EQ(Eigen::LLT<Eigen::Matrix3d>(k).info(), Eigen::Success);
        const Eigen::Matrix3d b = vertexCompliance(*greens, v, stiffness.mask(v));
        EXPECT_LE((b * k - Eigen::Matrix3d::Identity()).operatorNorm(), 1);
      }
    }
    EXPECT_GT(unserved, 0) << nu;
    EXPECT_LT(unserved, int(free.size())) << nu;
  }
}

TEST(SurfaceStiffness, IsNowhereLimitedOnAResolvedBody) {
  const TouchedBody sphere = touchedSphere(2, false);
  for (const double radius : {0.0, 0.3, 0.6}) {
    const SurfaceStiffness stiffness(sphere.greens, sphere.mesh, MaskShape::Linear, radius);
    for (int v = 0; v < sphere.mesh->vertexCount(); ++v) EXPECT_FALSE(stiffness.isLimited(v)) << v;
  }
}

}  // namespace
}  // namespace palpate::test
