// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The whole chain against an independent solver: compliance under a pressure mask at the pole of a
// clamped sphere.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "contact/pressure_mask.h"
#include "contact/surface_stiffness.h"
#include "model/support.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

constexpr double kMaskRadius = 0.3, kClampHeight = -0.8;

/// Edges fine under the mask, finer still at the edge of the support, where the traction is
/// singular, and coarse between; a ring of vertices on the mask's rim and one on the clamp line.
Shape gradedMesh(double underMask, double atClamp) {
  const double rim = 2 * std::asin(kMaskRadius / 2), clamp = std::acos(kClampHeight);
  return ringedSphere(
      [=](double angle) {
        return std::min({0.3, underMask + 0.4 * std::max(0.0, angle - rim),
                         atClamp + 0.5 * std::abs(angle - clamp)});
      },
      {rim, clamp});
}

/// The compliance at the pole, m/N, for E = 1.
/// @param supportPatch  the support's triangles are a smooth patch of their own.
Eigen::Matrix3d poleCompliance(const Shape& shape, double nu, bool supportPatch) {
  const auto mesh = shape.mesh();
  const auto fixed =
      fixedWhere(shape, [](const Eigen::Vector3d& x) { return x.z() < kClampHeight + 1e-9; });
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

struct Reference {
  double poissonRatio, normal, tangential;
};

class ClampedSphere : public testing::TestWithParam<Reference> {};

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

// hp finite elements, error <= 1e-5, of the exactly normalised linear mask; E = 1, radius 1.
INSTANTIATE_TEST_SUITE_P(References, ClampedSphere,
                         testing::Values(Reference{0.3, 3.137999, 15.631981},
                                         Reference{0.0, 3.519960, 15.122070}));

/// Continuous traction leaks from the support over the first row of free triangles.
TEST(SupportThatIsAPatchOfItsOwn, EndsItsTractionAtTheClampLine) {
  const Shape coarse = gradedMesh(0.1, 0.06);
  const double tangential = 15.631981;  // as above
  const double leaking = poleCompliance(coarse, 0.3, false)(0, 0) / tangential - 1;
  const double sharp = poleCompliance(coarse, 0.3, true)(0, 0) / tangential - 1;
  EXPECT_LT(leaking, -0.02);
  EXPECT_LT(std::abs(sharp), 0.4 * std::abs(leaking));
}

}  // namespace
}  // namespace palpate::test
