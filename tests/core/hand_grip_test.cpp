// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hand_grip.h"

#include <gtest/gtest.h>

#include "support/contact_bodies.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

/// A hand that could hold a ball of unit radius, its palm over the ball: fingers along x.
struct Held {
  TouchedBody body = touchedSphere(3, true);
  HandModel hand{3.4};
  HandGrip grip{hand, body.mesh, body.greens->info().conditions};
  ToolPose open;

  Held() {
    open.jointCount = HandJointCount;
    open.joints[ThumbAbduction] = 0.7;
    open.joints[ThumbRotation] = 0.2;
    Eigen::Matrix3d frame;
    frame << -Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitX();
    open.orientation = Eigen::Quaterniond(frame);
    open.position = {-0.446 * 3.4, 0, 3};
  }
};

TEST(HandGrips, LowerThePalmToTheDepthThatIsAsked) {
  const Held held;
  for (double depth : {0.0, 0.03, 0.1}) {
    const ToolPose low = held.grip.lowered(held.open, -Eigen::Vector3d::UnitZ(), 3, depth);
    EXPECT_LE(held.grip.depth(low, 15, 4), depth);
    EXPECT_GE(held.grip.depth(low, 15, 4), depth - 6e-5);  // steps of 3e-5 of a way of 3
    EXPECT_EQ((low.position - held.open.position).head<2>().norm(), 0);
  }
}

TEST(HandGrips, StopWhereThereIsNothingToMeet) {
  const Held held;
  const ToolPose up = held.grip.lowered(held.open, Eigen::Vector3d::UnitZ(), 1, 0.1);
  EXPECT_NEAR(up.position.z(), held.open.position.z() + 1, 0.011);  // a step of a hundredth
  ToolPose away = held.open;
  away.position.z() += 100;
  const ToolPose fist = held.grip.closed(away, 0.1);
  for (int joint : {IndexProximal, MiddleProximal, RingProximal, LittleProximal})
    EXPECT_NEAR(fist.joints[static_cast<std::size_t>(joint)], 1.5, 0.011);  // all the way
}

TEST(HandGrips, PressEachFingerAsDeepAsIsAskedAndNoDeeper) {
  const Held held;
  const double depth = 0.08;
  const ToolPose low = held.grip.lowered(held.open, -Eigen::Vector3d::UnitZ(), 3, 0.02);
  const ToolPose closed = held.grip.closed(low, depth);
  for (const HandFinger& finger : kHandFingers) {
    if (finger.firstBone == 15) continue;
    const double free = held.grip.depth(closed, finger.firstBone, finger.boneCount);
    const double fixed = held.grip.depth(closed, finger.firstBone, finger.boneCount, true);
    EXPECT_LE(free, depth) << finger.name;
    EXPECT_LE(fixed, 0) << finger.name;
    // A step turns a bone of length 1 by a hundredth.
    EXPECT_TRUE(free > depth - 0.03 || fixed > -0.03) << finger.name << ": " << free;
  }
  for (int joint = 0; joint < HandJointCount; ++joint)
    EXPECT_GE(closed.joints[static_cast<std::size_t>(joint)],
              low.joints[static_cast<std::size_t>(joint)]);
}

TEST(HandGrips, NeedASurfaceAndItsConditions) {
  const TouchedBody body = touchedSphere(2, true), other = touchedSphere(1, true);
  EXPECT_TRUE(isRefused([&] { HandGrip(HandModel(), nullptr, body.greens->info().conditions); },
                        "no surface"));
  EXPECT_TRUE(isRefused([&] { HandGrip(HandModel(), body.mesh, other.greens->info().conditions); },
                        "not of"));
}

}  // namespace
}  // namespace palpate::test
