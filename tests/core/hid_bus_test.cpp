// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a record tells without any device; hidapi_bus_test.cpp has the devices.

#include "haptics/hid_bus.h"

#include <gtest/gtest.h>

#include "haptics/palpate_report.h"
#include "support/pid_joystick.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

HidRecord record(std::uint16_t vendor, std::uint16_t product, std::uint32_t usage,
                 std::vector<std::uint8_t> descriptor = {}) {
  HidRecord record;
  record.vendor = vendor;
  record.product = product;
  record.usages = {usage};
  record.descriptor = std::move(descriptor);
  return record;
}

constexpr std::uint32_t kStick = hidUsage(0x01, 0x04), kMultiAxis = hidUsage(0x01, 0x08);

TEST(HidKinds, OurReportsAreKnownByTheirUsageWhoeverTheVendorIs) {
  const std::uint32_t usage = hidUsage(kPalpateUsagePage, kPalpateUsage);
  EXPECT_EQ(kindOf(record(0x1209, 1, usage)), HidKind::PalpateReports);
  EXPECT_EQ(kindOf(record(0xffff, 9, usage)), HidKind::PalpateReports);
  EXPECT_EQ(kindOf(record(0x1209, 1, usage + 1)), HidKind::Unknown);
}

TEST(HidKinds, SpaceMiceAreKnownByTheirFamilyWhereTheirAxesAre) {
  EXPECT_EQ(kindOf(record(0x046d, 0xc626, kMultiAxis)), HidKind::SpaceMouse);
  EXPECT_EQ(kindOf(record(0x256f, 0xc652, hidUsage(0x01, 0x06))), HidKind::Unknown)
      << "a receiver's keyboard";
}

TEST(HidKinds, SticksAreKnownByWhatTheyDescribe) {
  EXPECT_EQ(kindOf(record(0x1209, 0xffb0, kStick, PidJoystick::descriptor())),
            HidKind::ForceFeedback);
  EXPECT_EQ(kindOf(record(0x1209, 0xffb0, hidUsage(0x01, 0x06), PidJoystick::descriptor())),
            HidKind::Unknown);
  std::vector<std::uint8_t> lacking = PidJoystick::descriptor();
  for (std::size_t i = 0; i + 2 < lacking.size(); ++i)
    if (lacking[i] == 0x09 && lacking[i + 1] == 0xab && lacking[i + 2] == 0xa1)
      lacking[i + 1] = 0xf0;  // no way to create an effect
  EXPECT_EQ(kindOf(record(0x1209, 0xffb0, kStick, lacking)), HidKind::Joystick);
  lacking.resize(40);
  EXPECT_EQ(kindOf(record(0x1209, 0xffb0, kStick, lacking)), HidKind::Unknown);
  EXPECT_EQ(kindOf(record(0x1209, 0xffb0, kStick)), HidKind::Unknown);
}

TEST(HidKinds, WhatIsNotKnownNeedsADescription) {
  HidRecord board = record(0x1209, 2, hidUsage(0xff00, 1));
  board.path = "/dev/hidraw7";
  EXPECT_TRUE(isRefused([&] { openHidDevice(board); },
                        "what the reports of '/dev/hidraw7' mean is not known"));
}

}  // namespace
}  // namespace palpate::test
