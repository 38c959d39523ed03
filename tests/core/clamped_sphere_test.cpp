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
#include "support/problems.h"

namespace palpate::test {
namespace {

constexpr double kMaskRadius = 0.3, kClampHeight = -0.8;

/// Edges fine under the mask and at the edge of the support, coarse between; a ring of vertices on the
/// mask's rim and one on the clamp line.
Shape gradedMesh(double finest) {
  const double rim = 2 * std::asin(kMaskRadius / 2), clamp = std::acos(kClampHeight);
  return ringedSphere(
      [=](double angle) {
        const double fromMask = std::max(0.0, angle - rim), fromClamp = std::abs(angle - clamp);
        return std::min({0.16, finest + 0.22 * fromMask, 0.6 * finest + 0.3 * fromClamp});
      },
      {rim, clamp});
}

/// The compliance at the pole, m/N, for E = 1 and a mask of unit force in the continuum.
Eigen::Matrix3d poleCompliance(double nu) {
  const Shape shape = gradedMesh(0.055);
  EXPECT_LE(shape.points.cols(), 2000);
  const ElasticModel model = makeModel(
      shape, [](const Eigen::Vector3d& x) { return x.z() < kClampHeight + 1e-9; }, 1, nu);
  const PressureMasks masks(model.mesh(), model.conditions(), MaskShape::Linear, kMaskRadius);
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
  const Eigen::Matrix3d compliance = poleCompliance(GetParam().poissonRatio);
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

}  // namespace
}  // namespace palpate::test
