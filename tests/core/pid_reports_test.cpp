// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/pid_reports.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/pid_joystick.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool take(PidJoystick& joystick, const Bytes& report) {
  return joystick.takeOutput(report.data(), report.size());
}

TEST(PidReports, ADeviceUnderstandsThemFromCreationToRest) {
  const PidOutput output{HidDescriptor(PidJoystick::descriptor())};
  EXPECT_EQ(output.axes(), (std::vector<int>{0, 1}));
  PidJoystick joystick;
  EXPECT_TRUE(take(joystick, output.resetDevice()));
  EXPECT_TRUE(take(joystick, output.enableActuators()));
  EXPECT_TRUE(take(joystick, output.largestGain()));
  EXPECT_TRUE(joystick.isEnabled);
  EXPECT_EQ(joystick.gain, 255);
  for (int axis : output.axes()) {
    const Bytes create = output.createEffect();
    ASSERT_TRUE(joystick.takeFeature(create.data(), create.size()));
    const Bytes answer = joystick.feature(output.blockLoad()[0]);
    const auto block = output.loadedBlock(answer.data(), answer.size());
    ASSERT_TRUE(block);
    EXPECT_TRUE(take(joystick, output.setEffect(*block, axis)));
    EXPECT_TRUE(take(joystick, output.startEffect(*block)));
    const PidJoystick::Effect& effect = joystick.effects.at(*block);
    EXPECT_EQ(effect.type, 1);
    EXPECT_EQ(effect.duration, 0xffff) << "without end";
    EXPECT_EQ(effect.gain, 255);
    EXPECT_EQ(effect.axes, 1 << axis) << "that axis and no direction";
    EXPECT_TRUE(effect.isPlaying);
  }
  EXPECT_EQ(joystick.effects.size(), 2u);
  EXPECT_TRUE(take(joystick, output.stopEffects()));
  EXPECT_FALSE(joystick.effects.at(1).isPlaying);
}

TEST(PidReports, MagnitudesAreFractionsOfTheLargestForce) {
  const PidOutput output{HidDescriptor(PidJoystick::descriptor())};
  PidJoystick joystick;
  joystick.effects[1] = {};
  Bytes report(output.constantForceBytes());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::pair<double, int> cases[] = {{0, 0},      {1, 10000},         {-1, -10000},
                                          {0.5, 5000}, {-0.0001, -1},      {7, 10000},
                                          {nan, 0},    {-infinite, -10000}};
  for (const auto& [fraction, magnitude] : cases) {
    output.constantForce(1, fraction, report.data());
    ASSERT_TRUE(take(joystick, report));
    EXPECT_EQ(joystick.effects[1].magnitude, magnitude) << fraction;
  }
}

TEST(PidReports, ADeviceWithoutRoomLoadsNoBlock) {
  const PidOutput output{HidDescriptor(PidJoystick::descriptor())};
  const auto loaded = [&](const Bytes& bytes) {
    return output.loadedBlock(bytes.data(), bytes.size());
  };
  EXPECT_EQ(loaded({0x12, 3, 1, 0, 0}), 3);
  EXPECT_FALSE(loaded({0x12, 3, 2, 0, 0})) << "full";
  EXPECT_FALSE(loaded({0x12, 0, 1, 0, 0})) << "block 0 is none";
  EXPECT_FALSE(loaded({0x11, 3, 1, 0, 0}));
  EXPECT_FALSE(loaded({0x12, 3, 1, 0}));
  EXPECT_FALSE(loaded({}));
}

TEST(PidReports, WhatADescriptorLacksIsNamed) {
  Bytes bytes = PidJoystick::descriptor();
  EXPECT_TRUE(PidOutput::isComplete(HidDescriptor(bytes)));
  EXPECT_TRUE(isRefused([] { PidOutput output{HidDescriptor()}; },
                        "describes no block of a constant force"));
  // Another usage in place of "create new effect", of "axes enable", of "effect operation".
  const std::pair<std::uint8_t, const char*> cases[] = {
      {0xab, "describes no way to create a constant force"},
      {0x55, "describes no axis"},
      {0x77, "describes no effect to start"}};
  for (const auto& [usage, sentence] : cases) {
    Bytes lacking = bytes;
    for (std::size_t i = 0; i + 2 < lacking.size(); ++i)
      if (lacking[i] == 0x09 && lacking[i + 1] == usage && lacking[i + 2] == 0xa1)
        lacking[i + 1] = 0xf0;
    EXPECT_TRUE(isRefused([&] { PidOutput output{HidDescriptor(lacking)}; }, sentence));
    EXPECT_FALSE(PidOutput::isComplete(HidDescriptor(lacking)));
  }
}

}  // namespace
}  // namespace palpate::test
