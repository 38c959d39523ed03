// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hand_tool.h"

#include <gtest/gtest.h>

#include <random>

#include "support/allocation_count.h"

namespace palpate::test {
namespace {

ToolPose randomPose(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  ToolPose pose;
  pose.position = {any(random), any(random), any(random)};
  pose.orientation =
      Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
  pose.jointCount = HandJointCount;
  for (int j = 0; j < HandJointCount; ++j) pose.joints[j] = 0.8 * any(random);
  return pose;
}

/// The shapes as they are placed are the capsules of the kinematics.
TEST(HandTools, TouchWhereTheBonesAre) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-0.2, 0.2);
  for (const HandSide side : {HandSide::Left, HandSide::Right}) {
    const HandModel hand(0.18, side);
    const HandTool tool(hand);
    ASSERT_EQ(tool.partCount(), kHandCapsuleCount);
    for (int trial = 0; trial < 20; ++trial) {
      const ToolPose pose = randomPose(random);
      const HandCapsules capsules = hand.capsules(pose);
      RigidPose placed[kHandCapsuleCount];
      tool.place(pose, placed);
      for (int part = 0; part < kHandCapsuleCount; ++part) {
        const CapsuleShape exact(capsules[part].begin, capsules[part].end, capsules[part].radius);
        const Eigen::Vector3d place =
            pose.position + Eigen::Vector3d(any(random), any(random), any(random));
        const double distance = tool.shape(part)->proximity(placed[part].toOwn(place)).distance;
        EXPECT_NEAR(distance, exact.proximity(place).distance, 1e-13);  // lengths of 0.1 m
      }
    }
  }
}

/// A rolling forearm rolls every bone: what sticks to a finger goes round with it.
TEST(HandTools, TurnAsTheForearmTurns) {
  std::mt19937 random(2);
  const HandTool tool((HandModel()));
  const ToolPose before = randomPose(random);
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()));
  ToolPose after = before;
  after.orientation = roll * before.orientation;
  RigidPose first[kHandCapsuleCount], second[kHandCapsuleCount];
  tool.place(before, first);
  tool.place(after, second);
  for (int part = 0; part < kHandCapsuleCount; ++part)
    EXPECT_LE((roll * first[part].orientation).angularDistance(second[part].orientation), 1e-7);
}

/// A mirrored pose moves the other hand's bones as a mirror shows them.
TEST(HandTools, OfTheLeftMirrorTheRight) {
  std::mt19937 random(3);
  ToolPose pose = randomPose(random);
  pose.position.setZero();
  pose.orientation.setIdentity();
  const HandTool right(HandModel(0.2, HandSide::Right)), left(HandModel(0.2, HandSide::Left));
  RigidPose of[2][kHandCapsuleCount];
  right.place(pose, of[0]);
  left.place(pose, of[1]);
  const Eigen::Vector3d mirror(-1, 1, 1);
  for (int part = 0; part < kHandCapsuleCount; ++part)
    for (const Eigen::Vector3d& own :
         {Eigen::Vector3d(0.01, 0.02, -0.05), Eigen::Vector3d(0, 0, 0)})
      EXPECT_LE((of[0][part].toWorld(own).cwiseProduct(mirror) -
                 of[1][part].toWorld(own.cwiseProduct(mirror)))
                    .norm(),
                1e-15);
}

TEST(HandTools, AreMovedWithoutAllocating) {
  ASSERT_TRUE(allocationsAreCounted());
  std::mt19937 random(4);
  const HandTool tool((HandModel()));
  const ToolPose pose = randomPose(random);
  RigidPose placed[kHandCapsuleCount];
  const long before = allocationCount();
  tool.place(pose, placed);
  EXPECT_EQ(allocationCount() - before, 0);
}

}  // namespace
}  // namespace palpate::test
