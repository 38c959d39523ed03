// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/spacemouse_reports.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool parse(const Bytes& bytes, SpaceMouseState& state) {
  return parseSpaceMouseReport(bytes.data(), bytes.size(), state);
}

TEST(SpaceMouseReports, OlderOnesHoldTranslationAndRotationApart) {
  SpaceMouseState state;
  EXPECT_TRUE(parse({1, 0x5e, 0x01, 0xa2, 0xfe, 3, 0}, state));
  EXPECT_TRUE(parse({2, 4, 0, 0xff, 0xff, 0x06, 0x80}, state));
  EXPECT_TRUE(parse({3, 2, 0}, state));
  EXPECT_EQ(state.axes, (std::array<std::int16_t, 6>{350, -350, 3, 4, -1, -32762}));
  EXPECT_EQ(state.buttons, 2u);
}

TEST(SpaceMouseReports, NewerOnesHoldAllSix) {
  SpaceMouseState state;
  EXPECT_TRUE(parse({1, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 0xfa, 0xff}, state));
  EXPECT_EQ(state.axes, (std::array<std::int16_t, 6>{1, 2, 3, 4, 5, -6}));
  EXPECT_TRUE(parse({3, 1, 2, 3, 4}, state));
  EXPECT_EQ(state.buttons, 0x04030201u);
  EXPECT_TRUE(parse({3, 0, 0, 0, 0x80, 7, 7}, state)) << "more buttons than bits";
  EXPECT_EQ(state.buttons, 0x80000000u);
}

TEST(SpaceMouseReports, AnyOtherLengthOrNumberChangesNothing) {
  for (std::size_t length = 0; length <= 64; ++length)
    for (int number = 0; number < 256; ++number) {
      const bool isReport = (number == 1 && (length == 7 || length == 13)) ||
                            (number == 2 && length == 7) ||
                            (number == 3 && (length == 3 || length == 5 || length == 7));
      Bytes bytes(length, 0x55);
      if (length > 0) bytes[0] = static_cast<std::uint8_t>(number);
      SpaceMouseState state;
      EXPECT_EQ(parse(bytes, state), isReport);
      if (!isReport) {
        EXPECT_EQ(state.axes, SpaceMouseState().axes);
        EXPECT_EQ(state.buttons, 0u);
      }
    }
}

TEST(SpaceMousePose, PushedRightAwayAndDownGoesThere) {
  // HID's axes: X to the right, Y towards the hand, Z down.
  const AxisScale scale{0.05, 0.8, 1};
  SpaceMouseState state;
  state.axes = {350, 0, 0, 0, 0, 0};
  EXPECT_EQ(spaceMousePose(state, scale).position, Eigen::Vector3d(0.05, 0, 0));
  state.axes = {0, -350, 0, 0, 0, 0};
  EXPECT_EQ(spaceMousePose(state, scale).position, Eigen::Vector3d(0, 0, -0.05));
  state.axes = {0, 0, 350, 0, 0, 0};
  EXPECT_EQ(spaceMousePose(state, scale).position, Eigen::Vector3d(0, -0.05, 0));
}

TEST(SpaceMousePose, TurnsAboutTheAxisThatItIsTwistedAbout) {
  SpaceMouseState state;
  state.axes = {0, 0, 0, 0, 0, -175};  // about HID's Z, which points down
  const Eigen::AngleAxisd turn(spaceMousePose(state, {0.05, 0.8, 1}).orientation);
  EXPECT_NEAR(turn.angle(), 0.4, 1e-15);
  EXPECT_LE((turn.axis() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

TEST(SpaceMousePose, StaysWithinReach) {
  const AxisScale scale{0.05, 0.8, 1};
  for (std::int16_t axis : {-32768, -501, -350, 0, 350, 501, 32767}) {
    SpaceMouseState state;
    state.axes.fill(axis);
    const ToolPose pose = spaceMousePose(state, scale);
    EXPECT_LE(pose.position.cwiseAbs().maxCoeff(), 0.05);
    EXPECT_NEAR(pose.orientation.norm(), 1, 1e-15);
    EXPECT_LE(pose.orientation.angularDistance(Eigen::Quaterniond::Identity()),
              0.8 * std::sqrt(3) + 1e-12);
  }
}

TEST(SpaceMouseFamily, IsKnownByVendorAndProduct) {
  EXPECT_TRUE(isSpaceMouse(0x046d, 0xc626));   // SpaceNavigator
  EXPECT_TRUE(isSpaceMouse(0x256f, 0xc635));   // SpaceMouse Compact
  EXPECT_FALSE(isSpaceMouse(0x046d, 0xc077));  // a mouse
  EXPECT_FALSE(isSpaceMouse(0x046d, 0xc62c));
  EXPECT_FALSE(isSpaceMouse(0x256f, 0xc626));
}

}  // namespace
}  // namespace palpate::test
