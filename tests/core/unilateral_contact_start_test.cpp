// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Contact that begins with a tool, or another body, inside the surface.

#include <gtest/gtest.h>

#include "contact/mesh_shape.h"
#include "contact/unilateral_contact.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/obstacles.h"

namespace palpate::test {
namespace {

const TouchedBody& body() {
  static const TouchedBody sphere = touchedSphere(3, true);
  return sphere;
}

const Eigen::Vector3d kOut = Eigen::Vector3d(0.11, 0.07, 1).normalized();
constexpr int kTicks = 500;  // half a second, in which safety lets no force through at all

RigidPose deep(double radius, double depth) {
  RigidPose pose;
  pose.position = (1 + radius - depth) * kOut;
  pose.orientation.setFromTwoVectors(Eigen::Vector3d::UnitZ(), kOut);
  return pose;
}

/// Steps at one pose after a reset. The force never draws the tool in, and grows from zero by less
/// than a third of what it comes to in a step.
/// @return what it comes to.
Eigen::Vector3d begin(UnilateralContact& contact, const RigidPose& pose, bool isDeep) {
  contact.reset();
  std::vector<Eigen::Vector3d> forces{Eigen::Vector3d::Zero()};
  for (int tick = 0; tick < kTicks; ++tick) {
    EXPECT_EQ(contact.step(&pose).startedInside, isDeep && tick == 0);
    forces.push_back(contact.force(0));
    EXPECT_GE(forces.back().dot(kOut), 0) << tick;
  }
  for (int tick = 1; isDeep && tick <= kTicks; ++tick)
    EXPECT_LE((forces[tick] - forces[tick - 1]).norm(), 0.3 * forces.back().norm()) << tick;
  return forces.back();
}

TEST(UnilateralContactStart, ABallThatBeginsDeepComesInFromOutsideAndPressesAsOneThatWasPressedIn) {
  for (const double radius : {0.15, 0.3})
    for (const double radii : {0.2, 0.4, 0.6, 0.9, 1.1, 1.5, 2.0, 2.5, 3.0})
      for (const double friction : {0.0, 0.3}) {
        if (friction == 0 && radii > 1.1) continue;  // the surface slips off to all sides
        const std::string what = std::to_string(radius) + ' ' + std::to_string(radii);
        UnilateralContact contact(body().greens, body().mesh, ball(radius, friction, 0), {});
        for (int tick = -40; tick <= 400; ++tick) {
          const RigidPose pose = deep(radius, radii * radius * std::min(tick, 400) / 400);
          contact.step(&pose);
        }
        const Eigen::Vector3d pressed = contact.force(0);
        ASSERT_GT(pressed.dot(kOut), 0) << what;
        const Eigen::Vector3d force = begin(contact, deep(radius, radii * radius), radii > 0.5);
        // With friction it depends on the way in.
        EXPECT_LE((force - pressed).norm(), 0.1 * pressed.norm()) << what;
      }
}

TEST(UnilateralContactStart, OtherShapesComeInFromOutsideToo) {
  const Shape box = test::box({0.4, 0.4, 0.4}, {4, 4, 4});
  Shape centred = box;
  centred.points.colwise() -= Eigen::Vector3d::Constant(0.2);
  const std::shared_ptr<const RigidShape> shapes[] = {
      std::make_shared<CapsuleShape>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 0.2),
      std::make_shared<CapsuleShape>(-0.2 * Eigen::Vector3d::UnitX(),
                                     0.2 * Eigen::Vector3d::UnitX(), 0.2),
      std::make_shared<MeshShape>(centred.mesh())};
  for (const auto& shape : shapes) {
    UnilateralContact contact(body().greens, body().mesh, {{shape, 0.3}}, {});
    EXPECT_GT(begin(contact, deep(0.2, 0.25), true).dot(kOut), 0);
  }
}

TEST(UnilateralContactStart, AToolThatLeavesBeforeItIsInFeelsNothingMore) {
  UnilateralContact contact(body().greens, body().mesh, ball(0.3), {});
  const RigidPose inside = deep(0.3, 0.6), outside = deep(0.3, -0.3);
  for (int tick = 0; tick < 20; ++tick) contact.step(&inside);
  for (int tick = 0; tick < 3; ++tick) contact.step(&outside);
  EXPECT_EQ(contact.force(0), Eigen::Vector3d::Zero());
}

TEST(UnilateralContactStart, ElasticBodiesThatOverlapPushEachOtherApart) {
  const TouchedBody other = touchedSphere(2, true);
  UnilateralContact contact(
      body().greens, body().mesh,
      {{std::make_shared<MeshShape>(other.mesh), 0, other.greens, other.mesh}}, {});
  RigidPose pose;
  pose.position = 1.7 * kOut;
  EXPECT_GT(begin(contact, pose, true).dot(kOut), 0);
}

TEST(UnilateralContactStart, ABallDeepInABodyIsTakenToHaveComeTheNearestWay) {
  UnilateralContact contact(body().greens, body().mesh, ball(0.15, 0.3), {});
  const RigidPose pose = at(0.8, 0, 0);
  contact.step(&pose);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int tick = 0; tick < kTicks; ++tick) {
    contact.step(&pose);
    force = contact.force(0);
  }
  EXPECT_GT(force.x(), 0) << "pressed in from the side that is nearest";
  EXPECT_GT(force.x(), 5 * std::abs(force.z()));
}

TEST(UnilateralContactStart, BeginningDoesNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  UnilateralContact contact(body().greens, body().mesh, ball(0.3, 0.3), {});
  const RigidPose pose = deep(0.3, 0.7);
  const long before = allocationCount();
  for (int tick = 0; tick < 30; ++tick) {
    if (tick % 10 == 0) contact.reset();
    contact.step(&pose);
  }
  EXPECT_EQ(allocationCount(), before);
}

}  // namespace
}  // namespace palpate::test
