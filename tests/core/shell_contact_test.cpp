// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Consumers of Green's functions on shells: thin, open and curved.

#include <gtest/gtest.h>

#include <cmath>

#include "contact/sliding_contact.h"
#include "contact/surface_stiffness.h"
#include "contact/unilateral_contact.h"
#include "support/obstacles.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

bool rimOfPlate(const Eigen::Vector3d& x) {
  return x.head<2>().cwiseAbs().maxCoeff() > 0.499;
}

/// A cap of a unit sphere above z = 1/2, open below, held nowhere but where it is fixed.
Shape dome(int n) {
  return disc(1, n).mapped([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const double radius = x.norm(), angle = radius * M_PI / 3;
    const double outwards = radius > 0 ? std::sin(angle) / radius : 0;
    return {outwards * x.x(), outwards * x.y(), std::cos(angle)};
  });
}
bool partOfItsRim(const Eigen::Vector3d& x) {
  return x.z() < 0.51 && x.x() < 0;
}

TEST(ShellContact, ABallPressesAPlateAsAForceDoes) {
  const ShellProblem square = shellProblem(plate(1, 16), rimOfPlate, {0.01});
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, square.mesh().vertexCount());
  const int middle = vertexNear(square.mesh(), {0, 0, 0});
  force(2, middle) = -1;
  const double compliance = -displacementUnder(square, force)(2, middle);
  // So shallow that a ball's next vertices, 1/16 away, are 4e-3 below it.
  UnilateralContact contact(square.greens(), square.model.sharedMesh(), ball(0.5), still(50));
  for (double depth : {1e-5, 1e-4}) {
    const RigidPose pose = at(0, 0, 0.5 - depth);
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    EXPECT_NEAR(contact.wrench(0).force.z() * compliance / depth, 1, 1e-6);
  }
}

TEST(ShellContact, ABallThatRollsOverADomeAndItsRimIsBorneAlways) {
  const ShellProblem problem = shellProblem(dome(8), partOfItsRim, {0.02});
  UnilateralContact contact(problem.greens(), problem.model.sharedMesh(), ball(0.3, 0.3),
                            still(150));
  double largest = 0;
  for (int tick = 0; tick <= 200; ++tick) {
    // From the top down to 15 degrees beyond the free rim, 60 degrees down.
    const double angle = tick / 200. * 75 * M_PI / 180, radius = 1.3 - 1e-3;
    const RigidPose pose = at(radius * std::sin(angle), 0, radius * std::cos(angle));
    ASSERT_LE(contact.step(&pose).residual, 1e-8) << "tick " << tick;
    const Eigen::Vector3d force = contact.wrench(0).force;
    ASSERT_TRUE(force.allFinite());
    // A unilateral contact pushes the ball away from the dome's middle.
    EXPECT_GE(force.dot(pose.position), 0) << "tick " << tick;
    largest = std::max(largest, force.norm());
  }
  EXPECT_GT(largest, 0);
}

TEST(ShellContact, SlidingOverTheRimOfADomeStaysOnIt) {
  const ShellProblem problem = shellProblem(dome(8), partOfItsRim, {0.02});
  const auto stiffness = std::make_shared<SurfaceStiffness>(
      problem.greens(), problem.model.sharedMesh(), MaskShape::Linear, 0.3);
  const auto surface = std::make_shared<TouchedSurface>(stiffness->sharedMesh());
  SlidingContact contact(stiffness, surface);
  contact.setFriction(0.2);
  contact.advance({0.1, 0.05, 1.01});
  double largest = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    const double angle = 0.1 + 1.3 * tick / 2000.;  // the rim is at 1.05
    const Eigen::Vector3d force =
        contact.advance({0.995 * std::sin(angle), 0.05, 0.995 * std::cos(angle)});
    ASSERT_TRUE(force.allFinite());
    if (!contact.isTouching()) continue;
    const Eigen::Vector3d place = placeOf(problem.mesh(), contact.point());
    ASSERT_NEAR(place.norm(), 1, 0.02);  // chords
    ASSERT_GE(place.z(), 0.5 - 1e-9);
    largest = std::max(largest, force.norm());
  }
  EXPECT_GT(largest, 0);
}

}  // namespace
}  // namespace palpate::test
