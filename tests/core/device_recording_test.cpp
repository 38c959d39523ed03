// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/device_recording.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <random>

#include "support/refusals.h"
#include "support/temporary_path.h"

namespace palpate::test {
namespace {

/// Any double at all but the many that are no number, which text does not tell apart.
double anyDouble(std::mt19937_64& random) {
  const std::uint64_t pattern = random();
  double value;
  std::memcpy(&value, &pattern, sizeof value);
  return std::isnan(value) ? 0.1 : value;
}

DeviceRecording someRecording() {
  std::mt19937_64 random(9);
  DeviceRecording recording;
  recording.info = {"stylus, left", 3.3, 0.1, 1.0 / 3};
  for (int i = 0; i < 500; ++i) {
    DeviceMoment moment;
    moment.isThere = i % 7 != 3;
    ToolPose& pose = moment.state.pose;
    moment.state.sequence = random();
    for (double& x : pose.position) x = anyDouble(random);
    for (double& x : pose.orientation.coeffs()) x = anyDouble(random);
    pose.buttons = static_cast<std::uint32_t>(random());
    pose.jointCount = i % (ToolPose::kMostJoints + 1);
    for (int j = 0; j < pose.jointCount; ++j) pose.joints[j] = anyDouble(random);
    recording.moments.push_back(moment);
  }
  return recording;
}

bool isSame(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool isSame(const ToolPose& a, const ToolPose& b) {
  bool same = a.buttons == b.buttons && a.jointCount == b.jointCount;
  for (int i = 0; i < 3; ++i) same = same && isSame(a.position[i], b.position[i]);
  for (int i = 0; i < 4; ++i)
    same = same && isSame(a.orientation.coeffs()[i], b.orientation.coeffs()[i]);
  for (int j = 0; same && j < a.jointCount; ++j) same = isSame(a.joints[j], b.joints[j]);
  return same;
}

TEST(DeviceRecordingFile, ComesBackBitForBit) {
  const DeviceRecording written = someRecording();
  const TemporaryPath file;
  writeDeviceRecording(written, file.path());
  const DeviceRecording read = readDeviceRecording(file.path());
  EXPECT_EQ(read.info.name, written.info.name);
  EXPECT_EQ(read.info.largestForce, written.info.largestForce);
  EXPECT_EQ(read.info.largestTorque, written.info.largestTorque);
  EXPECT_EQ(read.info.largestStiffness, written.info.largestStiffness);
  ASSERT_EQ(read.moments.size(), written.moments.size());
  for (std::size_t i = 0; i < read.moments.size(); ++i) {
    EXPECT_EQ(read.moments[i].isThere, written.moments[i].isThere);
    if (!written.moments[i].isThere) continue;
    EXPECT_EQ(read.moments[i].state.sequence, written.moments[i].state.sequence);
    EXPECT_TRUE(isSame(read.moments[i].state.pose, written.moments[i].state.pose)) << i;
  }
}

TEST(DeviceRecordingFile, StatesItsRateIfThatIsKnown) {
  DeviceRecording recording = someRecording();
  for (const double rate : {0.0, 1000.0, 1000 / 3.0}) {
    recording.rate = rate;
    const TemporaryPath file;
    writeDeviceRecording(recording, file.path());
    EXPECT_EQ(file.text().find("\nrate ") != std::string::npos, rate > 0);
    const DeviceRecording read = readDeviceRecording(file.path());
    EXPECT_EQ(read.rate, rate);
    EXPECT_EQ(read.moments.size(), recording.moments.size());
  }
  for (const double rate : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    recording.rate = rate;
    const TemporaryPath file;
    EXPECT_TRUE(isRefused([&] { writeDeviceRecording(recording, file.path()); },
                          "the rate of a recording must not be negative"));
  }
}

TEST(DeviceRecordingFile, WhatIsNoNumberStaysNone) {
  DeviceRecording recording;
  recording.moments.resize(1);
  recording.moments[0].state.pose.position.x() = std::numeric_limits<double>::quiet_NaN();
  recording.moments[0].state.pose.position.y() = -std::numeric_limits<double>::infinity();
  const TemporaryPath file;
  writeDeviceRecording(recording, file.path());
  const Eigen::Vector3d x = readDeviceRecording(file.path()).moments[0].state.pose.position;
  EXPECT_TRUE(std::isnan(x.x()));
  EXPECT_EQ(x.y(), -std::numeric_limits<double>::infinity());
}

const std::string kHead = "palpate-device-recording 1\nname stylus\nlimits 3 0 0\n";
const std::string kRated = "palpate-device-recording 2\nname stylus\nlimits 3 0 0\n";

TEST(DeviceRecordingFile, MistakesAreNamedByTheirLine) {
  const std::string state = "1 0 0 0 1 0 0 0 0 0";
  const std::pair<std::string, std::string> cases[] = {
      {"", "line 1 of '*': the file ends before its first line"},
      {"palpate-device-recording 3\n", "line 1 of '*': a recording begins with"},
      {"palpate-device-recording 1\nnom x\n", "line 2 of '*': 'name' is missing"},
      {"palpate-device-recording 1\nname x\nlimits 1 2\n", "line 3 of '*': a limit is missing"},
      {"palpate-device-recording 1\nname x\nlimits 1 -2 0\n", "line 3 of '*': a limit is negative"},
      {kHead, "line 4 of '*': the file ends before the number of moments"},
      {kHead + "rate 1000\n", "line 4 of '*': 'moments' is missing"},
      {kRated + "moments 1\n", "line 4 of '*': 'rate' is missing"},
      {kRated + "rate 0\n", "line 4 of '*': the rate must be positive"},
      {kRated + "rate inf\n", "line 4 of '*': the rate must be positive"},
      {kHead + "moments -1\n", "line 4 of '*': the number of moments is missing or not"},
      {kHead + "moments 1 1\n", "line 4 of '*': there is more than expected: ' 1'"},
      {kHead + "moments 2\n" + state + "\n", "line 6 of '*': the file ends before its last moment"},
      {kHead + "moments 1\n" + state + "\naway\n", "line 6 of '*': there are more lines"},
      {kHead + "moments 1\n-" + state + "\n", "line 5 of '*': the sequence number is missing"},
      {kHead + "moments 1\n" + state + " 0.5\n", "line 5 of '*': there is more than expected"},
      {kHead + "moments 1\n1 0 0 0 1 0 0 0 0 33\n", "line 5 of '*': there cannot be 33 joints"},
      {kHead + "moments 1\n1 0 0 0 1 0 0 0 0 2 0.1\n", "line 5 of '*': a joint angle is missing"},
      {kHead + "moments 1\n1 0 0 1e999 1 0 0 0 0 0\n", "line 5 of '*': the position is missing or"},
      {kHead + "moments 1\n1 0 0 0,5 1 0 0 0 0 0\n", "line 5 of '*': the position is missing or"},
  };
  for (const auto& [text, sentence] : cases) {
    const TemporaryPath file(text);
    std::string expected = sentence;
    expected.replace(expected.find('*'), 1, file.path());
    EXPECT_TRUE(isRefused([&] { readDeviceRecording(file.path()); }, expected)) << text;
  }
}

TEST(DeviceRecordingFile, CutShortAnywhereIsRefused) {
  DeviceRecording recording = someRecording();
  recording.moments.resize(3);
  const TemporaryPath whole;
  writeDeviceRecording(recording, whole.path());
  const std::string text = whole.text();
  // Without the line break at its end it still says all.
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    std::ofstream(whole.path(), std::ios::binary | std::ios::trunc) << text.substr(0, length);
    try {
      const DeviceRecording read = readDeviceRecording(whole.path());
      // A number that has lost digits is still a number: the last one's loss cannot be told.
      EXPECT_GT(length, text.rfind(' '));
    } catch (const std::invalid_argument& expected) {
      EXPECT_NE(std::string(expected.what()).find("line "), std::string::npos);
    }
  }
}

TEST(DeviceRecordingFile, MayHaveTheLineEndsOfWindows) {
  const TemporaryPath file(
      "palpate-device-recording 1\r\nname a b\r\nlimits 1 2 3\r\n"
      "moments 2\r\naway\r\n7 0 0 0.01 1 0 0 0 0 0\r\n");
  const DeviceRecording recording = readDeviceRecording(file.path());
  EXPECT_EQ(recording.info.name, "a b");
  EXPECT_FALSE(recording.moments[0].isThere);
  EXPECT_EQ(recording.moments[1].state.sequence, 7u);
}

TEST(DeviceRecordingFile, OfEndlessLinesOrFoldersIsRefused) {
  const TemporaryPath file(std::string(1 << 17, 'x'));
  EXPECT_TRUE(isRefused([&] { readDeviceRecording(file.path()); }, "line 1 of"));
  EXPECT_TRUE(isRefused([&] { readDeviceRecording(file.path()); }, "the line is too long"));
  EXPECT_TRUE(isRefused<std::runtime_error>([] { readDeviceRecording(::testing::TempDir()); },
                                            "is a folder"));
}

TEST(DeviceRecordingFile, IsWrittenWholeOrNotAtAll) {
  const std::string folder = ::testing::TempDir() + "palpate_no_such_folder/";
  EXPECT_TRUE(isRefused<std::runtime_error>(
      [&] { writeDeviceRecording(someRecording(), folder + "x"); }, "x cannot be written"));
  const TemporaryPath file("before");
  DeviceRecording recording;
  recording.info.name = "two\nlines";
  EXPECT_TRUE(isRefused([&] { writeDeviceRecording(recording, file.path()); }, "must be one line"));
  recording.info.name = "one";
  recording.moments.resize(2);
  recording.moments[1].state.pose.jointCount = 99;
  EXPECT_TRUE(isRefused([&] { writeDeviceRecording(recording, file.path()); },
                        "moment 1 of a recording cannot have 99 joints"));
  EXPECT_EQ(file.text(), "before");
  const std::string name = std::filesystem::path(file.path()).filename();
  for (const auto& entry : std::filesystem::directory_iterator(::testing::TempDir()))
    EXPECT_NE(entry.path().filename().string().rfind(name + ".", 0), 0u) << "left behind";
}

TEST(DeviceRecordingFile, AMissingFileIsNamedAsSuch) {
  EXPECT_TRUE(isRefused<std::runtime_error>([] { readDeviceRecording("no/such/file"); },
                                            "the recording 'no/such/file' cannot be opened"));
}

}  // namespace
}  // namespace palpate::test
