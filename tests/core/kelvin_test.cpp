// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/kelvin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

namespace palpate::bem {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Kelvin : public testing::TestWithParam<double> {};

TEST_P(Kelvin, TractionIsTheStressOfTheDisplacementOnThePlane) {
  const double nu = GetParam(), g = 3, lambda = 2 * g * nu / (1 - 2 * nu);
  const Eigen::Vector3d r(0.7, -0.4, 1.1), n = Eigen::Vector3d(1, 2, -2).normalized();
  const double step = 1e-5;
  for (int load = 0; load < 3; ++load) {
    Eigen::Matrix3d gradient;  // d u_j / d r_k by central differences
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d e = step * Eigen::Vector3d::Unit(k);
      gradient.col(k) =
          (kelvinDisplacement(r + e, g, nu).row(load) - kelvinDisplacement(r - e, g, nu).row(load))
              .transpose() /
          (2 * step);
    }
    const Eigen::Matrix3d stress = g * (gradient + gradient.transpose()) +
                                   lambda * gradient.trace() * Eigen::Matrix3d::Identity();
    // Central differences of step 1e-5 leave 1e-10 of rounding and truncation.
    EXPECT_NEAR((kelvinTraction(r, n, nu).row(load).transpose() - stress * n).norm(), 0, 1e-8);
  }
}

TEST_P(Kelvin, TractionsOnASphereAroundTheLoadBalanceIt) {
  const double nu = GetParam(), radius = 0.8;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const int rings = 60, spokes = 60;  // midpoint rule, exact to h^2 and here to symmetry
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < spokes; ++j) {
      const double z = -1 + (2 * i + 1.0) / rings, turn = 2 * kPi * j / spokes;
      const double s = std::sqrt(1 - z * z);
      const Eigen::Vector3d n(s * std::cos(turn), s * std::sin(turn), z);
      sum += 4 * kPi * radius * radius / (rings * spokes) * kelvinTraction(radius * n, n, nu);
    }
  EXPECT_NEAR((sum + Eigen::Matrix3d::Identity()).norm(), 0, 1e-3);
}

TEST_P(Kelvin, DisplacementIsSymmetricAndFallsLikeOneOverDistance) {
  const Eigen::Vector3d r(0.3, 0.5, -0.2);
  const Eigen::Matrix3d near = kelvinDisplacement(r, 2, GetParam());
  EXPECT_NEAR((near - near.transpose()).norm(), 0, 1e-17);
  EXPECT_NEAR((kelvinDisplacement(10 * r, 2, GetParam()) * 10 - near).norm(), 0, 1e-16);
}

INSTANTIATE_TEST_SUITE_P(Materials, Kelvin, testing::Values(-0.9, -0.5, 0.0, 0.3, 0.499));

}  // namespace
}  // namespace palpate::bem
