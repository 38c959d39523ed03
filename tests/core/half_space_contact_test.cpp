// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Contact with half-spaces against the closed forms of Hertz and of a flat punch.

#include <gtest/gtest.h>

#include <cmath>

#include "contact/capacitance_solver.h"
#include "contact/sliding_contact.h"
#include "contact/surface_stiffness.h"
#include "contact/unilateral_contact.h"
#include "support/half_space.h"
#include "support/obstacles.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kModulus = 1 / (1 - 0.3 * 0.3);  ///< E* of E = 1, nu = 0.3

struct Pressed {
  double force, profileError, innerRadius, outerRadius;
};

/// A rigid ball of radius 1 pressed in by A15's depth for a contact radius, on a disc of 1.25 times
/// that. Hertz's contact is small: what the surface moves sideways, by a part of radius / R of the
/// radius, makes gaps differ from his.
Pressed pressBall(int rings, double radius = 0.002) {
  const double depth = radius * radius, exact = 4. / 3 * kModulus * std::pow(radius, 3);
  const HalfSpace body = halfSpace(disc(1.25 * radius, rings));
  UnilateralContact contact(body.greens, body.mesh, ball(1), still(600, radius / 4));
  const RigidPose pose = at(0, 0, 1 - depth);
  EXPECT_LE(contact.step(&pose).residual, 1e-9);
  Pressed pressed{contact.wrench(0).force.z() / exact, 0, 1e9, 0};
  double difference = 0, norm = 0;
  const double peak = 3 * exact / (2 * kPi * radius * radius);
  for (int i = 0; i < contact.watchedCount(); ++i) {
    const auto watched = contact.watched(i);
    const double r = body.mesh->points().col(watched.vertex).norm(),
                 area = body.greens->vertexArea(watched.vertex);
    const double pressure = -watched.force.z() / area;
    const double hertz = r < radius ? peak * std::sqrt(1 - r * r / radius / radius) : 0;
    difference += area * std::pow(pressure - hertz, 2);
    norm += area * hertz * hertz;
    if (pressure > 0) pressed.outerRadius = std::max(pressed.outerRadius, r / radius);
    if (pressure <= 0) pressed.innerRadius = std::min(pressed.innerRadius, r / radius);
  }
  pressed.profileError = std::sqrt(difference / norm);
  return pressed;
}

TEST(HalfSpaceContact, ABallPressesAsHertzFound) {
  const Pressed coarse = pressBall(6), fine = pressBall(12);
  RecordProperty("force_error_6", std::to_string(coarse.force - 1));
  RecordProperty("force_error_12", std::to_string(fine.force - 1));
  RecordProperty("profile_error_6", std::to_string(coarse.profileError));
  RecordProperty("profile_error_12", std::to_string(fine.profileError));
  EXPECT_NEAR(fine.force, 1, 0.005);
  EXPECT_LE(fine.profileError, 0.1);
  EXPECT_LE(fine.profileError, coarse.profileError);
  // The contact ends within a ring of Hertz's radius.
  EXPECT_NEAR(fine.outerRadius, 1, 1.25 / 12);
  EXPECT_NEAR(fine.innerRadius, 1, 2 * 1.25 / 12);
}

TEST(HalfSpaceContact, ForceGrowsWithThePowerThreeHalvesOfDepth) {
  const HalfSpace body = halfSpace(disc(0.003, 12));
  UnilateralContact contact(body.greens, body.mesh, ball(1), still(600, 0.0005));
  for (double radius : {0.0015, 0.002, 0.0025}) {
    const RigidPose pose = at(0, 0, 1 - radius * radius);
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    EXPECT_NEAR(contact.wrench(0).force.z() / (4. / 3 * kModulus * std::pow(radius, 3)), 1, 0.01);
  }
}

TEST(HalfSpaceContact, ALargeContactGathersTheSurfaceUnderTheBall) {
  // A15 itself: the material moves inwards by (1 - 2 nu)(1 + nu) p0 / 3 E of the radius, one
  // percent here, so that the ball meets more of it than Hertz's does.
  const double force = pressBall(12, 0.0880442).force;
  EXPECT_GT(force, 1.005);
  EXPECT_LT(force, 1.02);
}

/// F / (2 E* a delta) of a flat punch without friction, on a disc of its own size.
double punch(int rings, double poissonRatio) {
  const HalfSpace body = halfSpace(disc(1, rings), poissonRatio);
  BoundaryValues values;
  for (int v = 0; v < body.mesh->vertexCount(); ++v)
    values.switches.push_back({v, Eigen::Vector3d::UnitZ()});
  values.prescribed = Eigen::VectorXd::Constant(body.mesh->vertexCount(), -0.01);
  const BoundarySolution solution = CapacitanceSolver(body.greens, body.mesh).solve(values);
  const double force = -(solution.traction * body.greens->info().vertexAreas).z();
  return force * (1 - poissonRatio * poissonRatio) / (2 * 0.01);
}

TEST(HalfSpaceContact, AFlatPunchSinksAsItsClosedForm) {
  const double coarse = punch(6, 0.3) - 1, fine = punch(12, 0.3) - 1;
  RecordProperty("error_6", std::to_string(coarse));
  RecordProperty("error_12", std::to_string(fine));
  EXPECT_LE(std::abs(fine), 0.02);
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 1, 0.4);  // pressure is singular at the rim
  for (double nu : {-0.9, 0., 0.5}) EXPECT_NEAR(punch(12, nu), 1 + fine, 1e-10);
}

TEST(HalfSpaceContact, SlidingToTheRimStaysOnTheSurface) {
  const HalfSpace body = halfSpace(plate(1, 8));
  const auto stiffness =
      std::make_shared<SurfaceStiffness>(body.greens, body.mesh, MaskShape::Linear, 0.25);
  const auto surface = std::make_shared<TouchedSurface>(stiffness->sharedMesh());
  SlidingContact contact(stiffness, surface);
  contact.setFriction(0.2);
  contact.advance({0.1, 0.05, 0.01});
  for (int tick = 0; tick < 2000; ++tick) {
    // In, then aslant over the rim and on round its corner.
    const Eigen::Vector3d probe(0.1 + 0.0006 * tick, 0.05 + 0.0004 * tick, -0.002);
    const Eigen::Vector3d force = contact.advance(probe);
    ASSERT_TRUE(force.allFinite());
    const Eigen::Vector3d place = placeOf(*body.mesh, contact.point());
    ASSERT_LE(place.cwiseAbs().maxCoeff(), 0.5 + 1e-12) << "tick " << tick;
  }
  EXPECT_NEAR(placeOf(*body.mesh, contact.point()).x(), 0.5, 1e-9);
}

}  // namespace
}  // namespace palpate::test
