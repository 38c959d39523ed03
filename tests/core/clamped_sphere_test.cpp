// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The whole chain against an independent solver: compliance under a pressure mask at the pole of a
// clamped sphere.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "contact/pressure_mask.h"
#include "contact/surface_stiffness.h"
#include "model/support.h"
#include "support/clamped_sphere.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

/// The compliance at the pole, m/N, for E = 1.
/// @param supportPatch  the support's triangles are a smooth patch of their own.
Eigen::Matrix3d poleCompliance(const Shape& shape, double nu, bool supportPatch) {
  const auto mesh = shape.mesh();
  const auto fixed = fixedWhere(shape, clamped);
  Eigen::VectorXi patches = Eigen::VectorXi::Zero(mesh->triangleCount());
  if (supportPatch) patches = splitAtSupport(*mesh, BoundaryConditions(fixed), patches);
  const ElasticModel model(mesh, Material(1, nu), BoundaryConditions(fixed), patches);
  const PressureMasks masks(*mesh, model.conditions(), MaskShape::Linear, kMaskRadius);
  const VertexMask mask = masks.at(0);
  BoundaryElementOptions options;
  options.columns = mask.nodes;
  const auto greens = computeGreens(model, options);
  return maskedVertexStiffness(*greens, 0, mask).stiffness.inverse();
}

class ClampedSphere : public testing::TestWithParam<ClampedSphereReference> {};

TEST_P(ClampedSphere, PoleYieldsAsTheFiniteElementReference) {
  const Shape shape = gradedMesh(0.05, 0.015);
  ASSERT_LE(shape.points.cols(), 2000);
  const Eigen::Matrix3d compliance = poleCompliance(shape, GetParam().poissonRatio, false);
  EXPECT_NEAR(compliance(2, 2) / GetParam().normal, 1, 0.01);
  EXPECT_NEAR(compliance(0, 0) / GetParam().tangential, 1, 0.03);
  EXPECT_NEAR(compliance(1, 1) / GetParam().tangential, 1, 0.03);
  // The sphere is round: no direction along the surface is special, nor coupled to the normal.
  EXPECT_LT(std::abs(compliance(0, 2)), 0.01 * compliance(2, 2));
}

INSTANTIATE_TEST_SUITE_P(References, ClampedSphere, testing::ValuesIn(kClampedSphereReferences));

/// Continuous traction leaks from the support over the first row of free triangles.
TEST(SupportThatIsAPatchOfItsOwn, EndsItsTractionAtTheClampLine) {
  const Shape coarse = gradedMesh(0.1, 0.06);
  const double tangential = kClampedSphereReferences[0].tangential;
  const double leaking = poleCompliance(coarse, 0.3, false)(0, 0) / tangential - 1;
  const double sharp = poleCompliance(coarse, 0.3, true)(0, 0) / tangential - 1;
  EXPECT_LT(leaking, -0.02);
  EXPECT_LT(std::abs(sharp), 0.4 * std::abs(leaking));
}

}  // namespace
}  // namespace palpate::test
