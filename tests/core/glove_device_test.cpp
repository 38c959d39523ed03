// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/glove_device.h"

#include <gtest/gtest.h>

#include "support/refusals.h"
#include "support/temporary_path.h"

namespace palpate::test {
namespace {

TEST(GloveDevices, ReplayTheirTraceThroughAFile) {
  ToolPose wrist;
  wrist.position = Eigen::Vector3d(0.1, 0.2, 0.3);
  const DeviceRecording trace = closingHand(200, wrist);
  const TemporaryPath file;
  writeDeviceRecording(trace, file.path());
  GloveDevice device(readDeviceRecording(file.path()));
  EXPECT_EQ(device.info().name, "closing hand");
  EXPECT_EQ(device.info().largestForce, 0);
  DeviceState state;
  for (const DeviceMoment& moment : trace.moments) {
    ASSERT_TRUE(device.read(state));
    EXPECT_EQ(state.sequence, moment.state.sequence);
    EXPECT_EQ(state.pose.joints, moment.state.pose.joints);
    EXPECT_EQ(state.pose.jointCount, 22);
    EXPECT_EQ(state.pose.position, wrist.position);
  }
  EXPECT_TRUE(device.script().isFinished());
  EXPECT_TRUE(device.write({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}));
}

TEST(GloveDevices, AClosingHandBringsItsTipsToThePalmWithoutJumps) {
  GloveDevice device(closingHand(1000));
  DeviceState state;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double first = 0, last = 0;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(device.read(state));
    const HandCapsules bones = device.hand().capsules(state.pose);
    const Eigen::Vector3d tip = bones[8].end;  // of the middle finger
    const double fromWrist = tip.norm();
    if (i == 0) first = fromWrist;
    EXPECT_TRUE(i == 0 || (tip - before).norm() < 0.001) << "m in a thousandth of the way";
    last = fromWrist;
    before = tip;
  }
  EXPECT_NEAR(first, 0.19, 0.005);
  EXPECT_LT(last, 0.6 * first);
}

TEST(GloveDevices, NeedAllTheirJoints) {
  DeviceRecording trace = closingHand(5);
  trace.moments[2].isThere = false;
  trace.moments[2].state.pose.jointCount = 0;
  GloveDevice away(trace);  // a moment without a glove has no joints
  trace.moments[3].state.pose.jointCount = 21;
  EXPECT_TRUE(isRefused([&] { GloveDevice device(trace); },
                        "moment 3 of a glove's trace has 21 joints, not the 22 of a hand"));
  EXPECT_TRUE(isRefused([] { GloveDevice device{DeviceRecording()}; }, "needs a moment"));
  EXPECT_TRUE(isRefused([] { closingHand(1); }, "in 2 moments at least, not 1"));
}

}  // namespace
}  // namespace palpate::test
