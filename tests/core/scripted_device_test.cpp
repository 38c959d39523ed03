// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/scripted_device.h"

#include <gtest/gtest.h>

#include "support/allocation_count.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

DeviceRecording pathAlongX(int count) {
  DeviceRecording recording;
  recording.info = {"path", 3, 0, 500};
  for (int i = 0; i < count; ++i) {
    DeviceMoment moment;
    moment.state.sequence = static_cast<std::uint64_t>(i) + 1;
    moment.state.pose.position.x() = 0.001 * i;
    recording.moments.push_back(moment);
  }
  return recording;
}

const Wrench kPush{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0.1, 0, 0)};

TEST(ScriptedDevices, GiveOneMomentAReadAndFallSilentAtTheirEnd) {
  ScriptedDevice device(pathAlongX(3));
  DeviceState state;
  for (std::uint64_t i = 1; i <= 3; ++i) {
    EXPECT_FALSE(device.isFinished());
    ASSERT_TRUE(device.read(state));
    EXPECT_EQ(state.sequence, i);
    EXPECT_EQ(device.momentsRead(), i);
  }
  EXPECT_TRUE(device.isFinished());
  ASSERT_TRUE(device.read(state));
  EXPECT_EQ(state.sequence, 3u);
  EXPECT_EQ(state.pose.position.x(), 0.002);
  EXPECT_EQ(device.info().name, "path");
}

TEST(ScriptedDevices, SayThatARecordingIsOverOnceItsLastMomentIsRepeated) {
  DeviceRecording recording;
  recording.moments.resize(2);
  ScriptedDevice device(recording);
  DeviceState state;
  for (const bool isOver : {false, false, true, true}) {
    ASSERT_TRUE(device.read(state));
    EXPECT_EQ(state.isOver, isOver);
  }
}

TEST(ScriptedDevices, WhereTheyAreAwayNothingArrives) {
  DeviceRecording recording = pathAlongX(3);
  recording.moments[1].isThere = false;
  ScriptedDevice device(recording);
  DeviceState state;
  EXPECT_FALSE(device.write(kPush)) << "before the first read";
  ASSERT_TRUE(device.read(state));
  EXPECT_TRUE(device.write(kPush));
  EXPECT_FALSE(device.read(state));
  EXPECT_EQ(state.sequence, 1u) << "the state stays untouched";
  EXPECT_FALSE(device.write(kPush));
  ASSERT_TRUE(device.read(state));
  EXPECT_EQ(state.sequence, 3u);
}

TEST(ScriptedDevices, RememberTheLastWrenchOfEachMoment) {
  ScriptedDevice device(pathAlongX(3));
  DeviceState state;
  device.read(state);
  device.write({Eigen::Vector3d(9, 9, 9), Eigen::Vector3d::Zero()});
  device.write(kPush);
  device.read(state);
  device.read(state);
  device.write(kPush);
  ASSERT_EQ(device.wrenches().size(), 3u);
  EXPECT_EQ(device.wrenches()[0].force, kPush.force);
  EXPECT_EQ(device.wrenches()[1].force, Eigen::Vector3d::Zero());
  EXPECT_EQ(device.wrenches()[2].torque, kPush.torque);
}

TEST(ScriptedDevices, NeedAMoment) {
  EXPECT_TRUE(isRefused([] { ScriptedDevice device{DeviceRecording()}; }, "needs a moment"));
}

TEST(RecordingDevices, KeepWhatTheyPassOn) {
  DeviceRecording path = pathAlongX(5);
  path.moments[2].isThere = false;
  auto scripted = std::make_unique<ScriptedDevice>(path);
  const ScriptedDevice& inner = *scripted;
  RecordingDevice device(std::move(scripted), 4, 500);
  EXPECT_EQ(device.info().name, "path");
  EXPECT_EQ(device.recording().rate, 500);
  DeviceState state;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(device.read(state), i != 2);
    EXPECT_EQ(device.write(kPush), i != 2);
  }
  EXPECT_EQ(inner.wrenches()[4].force, kPush.force);
  const DeviceRecording& kept = device.recording();
  ASSERT_EQ(kept.moments.size(), 4u) << "as many as were asked for";
  EXPECT_EQ(device.leftOut(), 1u) << "and it tells how many are missing";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(kept.moments[i].isThere, path.moments[i].isThere);
    EXPECT_EQ(kept.moments[i].state.sequence, i == 2 ? 0 : path.moments[i].state.sequence);
  }
  EXPECT_EQ(kept.info.largestStiffness, 500);
}

TEST(RecordingDevices, NeitherTheyNorScriptsAllocateWhileTheyAreUsed) {
  ASSERT_TRUE(allocationsAreCounted());
  RecordingDevice device(std::make_unique<ScriptedDevice>(pathAlongX(100)), 50);
  DeviceState state;
  const long before = allocationCount();
  for (int i = 0; i < 200; ++i) {
    device.read(state);
    device.write(kPush);
  }
  EXPECT_EQ(allocationCount(), before);
}

TEST(RecordingDevices, NeedADevice) {
  EXPECT_TRUE(isRefused([] { RecordingDevice(nullptr, 1); }, "no device to record"));
}

}  // namespace
}  // namespace palpate::test
