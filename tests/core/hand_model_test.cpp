// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hand_model.h"

#include <gtest/gtest.h>

#include <random>

#include "support/allocation_count.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

// Rounding of a chain of rotations, over a hand of 0.2 m.
constexpr double kRounding = 1e-15;

/// Numbers of the bones, as HandCapsules has them.
constexpr int kThumb = 0, kIndex = 3, kMiddle = 6, kRing = 9, kLittle = 12, kPalm = 15;

class Hands : public testing::Test {
 protected:
  double angle() { return std::uniform_real_distribution<double>(-0.3, 1.3)(random_); }

  ToolPose randomPose() {
    ToolPose pose;
    pose.position = Eigen::Vector3d(angle(), angle(), angle());
    pose.orientation = Eigen::Quaterniond(angle(), angle(), angle(), 1).normalized();
    pose.jointCount = HandJointCount;
    for (int j = 0; j < HandJointCount; ++j) pose.joints[j] = angle();
    return pose;
  }

  std::mt19937 random_{5};
  HandModel hand_;
};

TEST_F(Hands, AFlatHandIsAsLongAsItIsSaidToBeAndFlat) {
  const HandCapsules bones = hand_.capsules({});
  // The table's middle finger with its metacarpal makes 0.99 hand lengths, along a fan.
  EXPECT_NEAR(bones[kMiddle + 2].end.z(), -0.19, 0.004);
  for (const Capsule& bone : bones) {
    EXPECT_EQ(bone.begin.y(), 0);
    EXPECT_EQ(bone.end.y(), 0);
  }
  EXPECT_LT(bones[kThumb].begin.x(), 0) << "the thumb of a right hand that lies on its palm";
  EXPECT_GT(bones[kLittle].begin.x(), bones[kIndex].begin.x());
}

TEST_F(Hands, BonesKeepTheirLengthsAndHangTogether) {
  const HandCapsules flat = hand_.capsules({});
  for (int trial = 0; trial < 50; ++trial) {
    const HandCapsules bones = hand_.capsules(randomPose());
    for (int b = 0; b < kHandCapsuleCount; ++b) {
      EXPECT_NEAR((bones[b].end - bones[b].begin).norm(), (flat[b].end - flat[b].begin).norm(),
                  10 * kRounding);
      EXPECT_EQ(bones[b].radius, flat[b].radius);
    }
    for (int b : {kThumb, kIndex, kMiddle, kRing, kLittle})
      for (int k = 0; k < 2; ++k) EXPECT_EQ(bones[b + k].end, bones[b + k + 1].begin);
    for (int f = 0; f < 4; ++f) {
      EXPECT_EQ(bones[kPalm + f].end, bones[kIndex + 3 * f].begin);
      EXPECT_EQ(bones[kPalm + f].begin, bones[kPalm].begin);
    }
  }
}

TEST_F(Hands, TheForearmsPoseCarriesThemRigidly) {
  ToolPose pose = randomPose();
  const HandCapsules moved = hand_.capsules(pose);
  const Eigen::Vector3d position = pose.position;
  const Eigen::Quaterniond orientation = pose.orientation;
  pose.position.setZero();
  pose.orientation.setIdentity();
  const HandCapsules still = hand_.capsules(pose);
  for (int b = 0; b < kHandCapsuleCount; ++b)
    EXPECT_LE((moved[b].end - (position + orientation * still[b].end)).norm(), 10 * kRounding);
}

TEST_F(Hands, EachAngleMovesWhatLiesBeyondItsJointAndNothingElse) {
  const auto movedBones = [this](int joint) {
    const HandCapsules before = hand_.capsules({});
    ToolPose pose;
    pose.joints[joint] = 0.1;
    const HandCapsules after = hand_.capsules(pose);
    std::vector<int> moved;
    for (int b = 0; b < kHandCapsuleCount; ++b)
      if ((after[b].end - before[b].end).norm() > 1e-6) moved.push_back(b);
    return moved;
  };
  const auto from = [](int first, int last) {
    std::vector<int> list;
    for (int b = first; b <= last; ++b) list.push_back(b);
    return list;
  };
  EXPECT_EQ(movedBones(ThumbAbduction), from(0, 2));
  EXPECT_EQ(movedBones(ThumbProximal), from(1, 2));
  EXPECT_EQ(movedBones(ThumbDistal), from(2, 2));
  const int proximal[] = {IndexProximal, MiddleProximal, RingProximal, LittleProximal};
  for (int f = 0; f < 4; ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(movedBones(proximal[f] + k), from(kIndex + 3 * f + k, kIndex + 3 * f + 2));
  EXPECT_EQ(movedBones(MiddleIndexAbduction), from(kIndex, kIndex + 2));
  EXPECT_EQ(movedBones(RingMiddleAbduction), from(kRing, kLittle + 2))
      << "it takes the little finger along";
  EXPECT_EQ(movedBones(LittleRingAbduction), from(kLittle, kLittle + 2));
  EXPECT_EQ(movedBones(PalmArch), (std::vector<int>{9, 10, 11, 12, 13, 14, 17, 18}));
  EXPECT_EQ(movedBones(WristFlexion), from(0, 18));
  EXPECT_EQ(movedBones(WristAbduction), from(0, 18));
}

TEST_F(Hands, FlexionGoesToThePalmAndAbductionApart) {
  ToolPose pose;
  for (int j = 0; j < HandJointCount; ++j) pose.joints[j] = 0;
  pose.joints[IndexProximal] = M_PI / 2;
  const Capsule index = hand_.capsules(pose)[kIndex];
  EXPECT_LE(((index.end - index.begin).normalized() + Eigen::Vector3d::UnitY()).norm(), 1e-12);
  pose.joints[IndexProximal] = 0;
  pose.joints[WristFlexion] = 0.5;
  EXPECT_LT(hand_.capsules(pose)[kMiddle].end.y(), 0);
  pose.joints[WristFlexion] = 0;
  pose.joints[WristAbduction] = 0.5;
  EXPECT_LT(hand_.capsules(pose)[kMiddle + 2].end.x(), -0.05) << "towards the thumb";
  pose.joints[WristAbduction] = 0;
  const auto gap = [&](int joint, int a, int b) {
    const HandCapsules flat = hand_.capsules(pose);
    pose.joints[joint] = 0.2;
    const HandCapsules spread = hand_.capsules(pose);
    pose.joints[joint] = 0;
    return (spread[a].end - spread[b].end).norm() - (flat[a].end - flat[b].end).norm();
  };
  EXPECT_GT(gap(MiddleIndexAbduction, kIndex + 2, kMiddle + 2), 0.01);
  EXPECT_GT(gap(RingMiddleAbduction, kRing + 2, kMiddle + 2), 0.01);
  EXPECT_GT(gap(LittleRingAbduction, kLittle + 2, kRing + 2), 0.01);
  const double thumb = hand_.capsules(pose)[kThumb + 2].end.x();
  pose.joints[ThumbAbduction] = 0.2;
  EXPECT_LT(hand_.capsules(pose)[kThumb + 2].end.x(), thumb - 0.01);
}

TEST_F(Hands, TheThumbSwingsUnderThePalm) {
  ToolPose pose;
  pose.joints[ThumbAbduction] = 0.8;
  EXPECT_NEAR(hand_.capsules(pose)[kThumb + 2].end.y(), 0, kRounding);
  pose.joints[ThumbRotation] = M_PI / 2;
  EXPECT_LT(hand_.capsules(pose)[kThumb + 2].end.y(), -0.05);
}

TEST_F(Hands, LeftHandsMirrorRightOnes) {
  const HandModel left(0.19, HandSide::Left);
  ToolPose pose = randomPose();
  pose.position.setZero();
  pose.orientation.setIdentity();
  const HandCapsules a = hand_.capsules(pose), b = left.capsules(pose);
  for (int i = 0; i < kHandCapsuleCount; ++i) {
    EXPECT_EQ(a[i].end.x(), -b[i].end.x());
    EXPECT_EQ(a[i].end.tail<2>(), b[i].end.tail<2>());
  }
}

TEST_F(Hands, ScaleWithTheirLength) {
  ToolPose pose = randomPose();
  pose.position.setZero();
  const HandCapsules small = hand_.capsules(pose), large = HandModel(0.38).capsules(pose);
  for (int i = 0; i < kHandCapsuleCount; ++i) {
    EXPECT_LE((large[i].end - 2 * small[i].end).norm(), 10 * kRounding);
    EXPECT_EQ(large[i].radius, 2 * small[i].radius);
  }
}

TEST_F(Hands, AllocateNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  const ToolPose pose = randomPose();
  const long before = allocationCount();
  const HandCapsules bones = hand_.capsules(pose);
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(bones[0].radius, 0);
}

TEST_F(Hands, WithoutLengthAreRefused) {
  EXPECT_TRUE(isRefused([] { HandModel hand(0); }, "the length of a hand must be a positive"));
  EXPECT_TRUE(isRefused([] { HandModel hand(std::nan("")); }, "must be a positive"));
}

}  // namespace
}  // namespace palpate::test
