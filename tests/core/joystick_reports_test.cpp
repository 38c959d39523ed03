// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/joystick_reports.h"

#include <gtest/gtest.h>

#include "support/pid_joystick.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
const AxisScale kScale{0.04, 0.5, 1};

TEST(JoystickReports, FullDeflectionIsTheScalesReach) {
  const JoystickInput input{HidDescriptor(PidJoystick::descriptor())};
  ToolPose pose;
  const Bytes right = {1, 0xff, 0x7f, 0x00, 0x00, 0x85};
  ASSERT_TRUE(input.parse(right.data(), right.size(), kScale, pose));
  EXPECT_EQ(pose.position, Eigen::Vector3d(0.04, 0, 0));
  EXPECT_EQ(pose.buttons, 0x85u);
  const Bytes away = {1, 0x00, 0x00, 0x00, 0x80, 0x00};  // even one beyond the logical range
  ASSERT_TRUE(input.parse(away.data(), away.size(), kScale, pose));
  EXPECT_EQ(pose.position, Eigen::Vector3d(0, 0, -0.04));
  EXPECT_EQ(pose.orientation.w(), 1);
}

TEST(JoystickReports, AnyOtherLengthOrNumberIsNotTaken) {
  const JoystickInput input{HidDescriptor(PidJoystick::descriptor())};
  for (std::size_t length = 0; length < 16; ++length)
    for (std::uint8_t number : {0, 1, 2}) {
      Bytes bytes(length, number);
      ToolPose pose;
      EXPECT_EQ(input.parse(bytes.data(), length, kScale, pose), length == 6 && number == 1);
    }
}

TEST(JoystickReports, UnnumberedOnesAndUnsignedAxesAreReadAsWell) {
  // X in 0..255, then Rz in 0..3 with four bits of padding before it.
  const JoystickInput input{
      HidDescriptor({0x05, 0x01, 0x09, 0x30, 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 0x08, 0x95, 0x01,
                     0x81, 0x02, 0x75, 0x04, 0x81, 0x03, 0x09, 0x35, 0x25, 0x03, 0x81, 0x02})};
  ToolPose pose;
  const Bytes report = {255, 0x30};
  ASSERT_TRUE(input.parse(report.data(), report.size(), kScale, pose));
  EXPECT_EQ(pose.position.x(), 0.04);
  EXPECT_NEAR(pose.orientation.angularDistance(Eigen::Quaterniond::Identity()), 0.5, 1e-12);
}

TEST(JoystickReports, ADeviceWithoutAxesIsRefused) {
  EXPECT_TRUE(isRefused([] { JoystickInput input{HidDescriptor()}; }, "describes no axis"));
  // An axis whose range is empty cannot be read either.
  EXPECT_TRUE(isRefused(
      [] {
        JoystickInput input{
            HidDescriptor({0x05, 0x01, 0x09, 0x30, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02})};
      },
      "describes no axis"));
}

}  // namespace
}  // namespace palpate::test
