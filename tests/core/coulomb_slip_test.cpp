// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/coulomb_slip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

// What the root is found to, through matrices of condition below 1e2.
constexpr double kFound = 1e-10;

/// Symmetric, eigenvalues between 1 and 10.
Eigen::Matrix3d randomStiffness(std::mt19937& random) {
  const Eigen::Vector3d axis = randomDirection(random);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(double(random() % 1000), axis).toRotationMatrix();
  const Eigen::Vector3d values = Eigen::Vector3d::Constant(5.5) + 4.5 * randomVectors(1, random);
  return turn * values.asDiagonal() * turn.transpose();
}

struct Parts {
  Eigen::Vector3d across;
  double pressing;
};
Parts partsOf(const Eigen::Vector3d& force, const Eigen::Vector3d& normal) {
  return {force - normal.dot(force) * normal, -normal.dot(force)};
}

TEST(CoulombSlip, ReturnsToTheConeAlongTheForceThatRemainsAcross) {
  std::mt19937 random(1);
  int slips = 0, sticks = 0, letsGo = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Eigen::Matrix3d k = randomStiffness(random);
    const Eigen::Vector3d n = randomDirection(random), u = 1e-3 * randomDirection(random);
    const double mu = (trial % 4) * 0.4;
    const Parts before = partsOf(k * u, n);
    const CoulombSlip slip = coulombSlip(k, n, u, mu);
    const Parts after = partsOf(k * (u - slip.displacement), n);
    const double size = (k * u).norm();
    EXPECT_LE(std::abs(slip.displacement.dot(n)), kFound * u.norm());
    if (slip.friction == Friction::Sticks) {
      ++sticks;
      EXPECT_LE(before.across.norm(), mu * before.pressing + 1e-9 * size);
      EXPECT_EQ(slip.displacement, Eigen::Vector3d::Zero());
    } else if (slip.friction == Friction::Slips) {
      ++slips;
      EXPECT_NEAR(after.across.norm(), mu * after.pressing, kFound * size);
      EXPECT_GE(after.pressing, 0);
      // Dissipation: f_t(d) = s d with s >= 0.
      EXPECT_NEAR(after.across.dot(slip.displacement),
                  after.across.norm() * slip.displacement.norm(), kFound * size * u.norm());
    } else {
      ++letsGo;
      EXPECT_GE(u.dot(n), 0) << "the probe is not below the plane";
      EXPECT_LE(after.across.norm(), kFound * size);
      EXPECT_LE(after.pressing, 0);
    }
    EXPECT_EQ(u.dot(n) < 0 && slip.friction == Friction::LetsGo, false);
  }
  EXPECT_GT(slips, 1000);
  EXPECT_GT(sticks, 50);
  EXPECT_GT(letsGo, 1000);
}

TEST(CoulombSlip, WithoutFrictionThePointEndsUnderTheProbe) {
  const Eigen::Matrix3d k = 3 * Eigen::Matrix3d::Identity();
  const CoulombSlip slip = coulombSlip(k, {0, 0, 1}, {0.2, -0.1, -0.3}, 0);
  EXPECT_EQ(slip.friction, Friction::Slips);
  EXPECT_LE((slip.displacement - Eigen::Vector3d(0.2, -0.1, 0)).norm(), 1e-16);
}

TEST(CoulombSlip, BeginsWhereTheTangentOfTheForcesAngleExceedsMu) {
  const Eigen::Matrix3d k = 3 * Eigen::Matrix3d::Identity();
  for (double mu : {0.1, 0.5, 2.0})
    for (double turn : {0.0, 1.0, 2.5}) {
      const auto pushed = [&](double tangent) {
        const Eigen::Vector3d u(tangent * std::cos(turn), tangent * std::sin(turn), -1);
        return coulombSlip(k, {0, 0, 1}, 1e-3 * u, mu).friction;
      };
      EXPECT_EQ(pushed(mu * (1 - 1e-6)), Friction::Sticks);
      EXPECT_EQ(pushed(mu * (1 + 1e-6)), Friction::Slips);
    }
}

TEST(CoulombSlip, DoesNotDependOnUnits) {
  std::mt19937 random(2);
  const Eigen::Matrix3d k = randomStiffness(random);
  const Eigen::Vector3d n(0, 0, 1), u(0.9, 0.4, -0.5);
  const CoulombSlip one = coulombSlip(k, n, u, 0.3);
  ASSERT_EQ(one.friction, Friction::Slips);
  for (double stiff : {1e-9, 1e9})
    for (double length : {1e-9, 1e6}) {
      const CoulombSlip other = coulombSlip(stiff * k, n, length * u, 0.3);
      EXPECT_LE((other.displacement / length - one.displacement).norm(), kFound);
      EXPECT_NEAR(other.excess, one.excess, 1e-14);
    }
}

TEST(CoulombSlip, AProbeThatDoesNotPressHasNoForceToSlipUnder) {
  const CoulombSlip none =
      coulombSlip(Eigen::Matrix3d::Identity(), {0, 0, 1}, Eigen::Vector3d::Zero(), 0.5);
  EXPECT_EQ(none.friction, Friction::Sticks);
  EXPECT_EQ(none.excess, 0);
}

}  // namespace
}  // namespace palpate::test
