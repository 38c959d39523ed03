// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_descriptor.h"

#include <gtest/gtest.h>

#include "support/pid_joystick.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A mouse, as in appendix E.10 of the HID specification: three buttons, padding, X and Y.
const Bytes kMouse = {0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x09, 0x01, 0xa1, 0x00, 0x05, 0x09, 0x19,
                      0x01, 0x29, 0x03, 0x15, 0x00, 0x25, 0x01, 0x95, 0x03, 0x75, 0x01, 0x81, 0x02,
                      0x95, 0x01, 0x75, 0x05, 0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
                      0x81, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xc0, 0xc0};

TEST(HidDescriptors, TheSpecificationsMouseHasItsFields) {
  const HidDescriptor mouse(kMouse);
  ASSERT_EQ(mouse.fields().size(), 5u);
  EXPECT_FALSE(mouse.numbersReports());
  EXPECT_EQ(mouse.reportBytes(HidReportKind::Input, 0), 3);
  EXPECT_EQ(mouse.reportBytes(HidReportKind::Output, 0), 0);
  EXPECT_TRUE(mouse.fields()[1].hasUsage(hidUsage(0x09, 2)));
  EXPECT_EQ(mouse.fields()[1].bit, 1);
  const HidField* y = mouse.find(HidReportKind::Input, hidUsage(0x01, 0x02), hidUsage(0x01, 0x31));
  ASSERT_TRUE(y);
  EXPECT_EQ(y->bit, 16);
  EXPECT_EQ(y->bits, 8);
  EXPECT_EQ(y->least, -127);
  EXPECT_EQ(y->most, 127);
  EXPECT_FALSE(y->isSelector);
}

TEST(HidDescriptors, SelectorsKnowAllTheirChoices) {
  const HidDescriptor joystick(PidJoystick::descriptor());
  EXPECT_TRUE(joystick.numbersReports());
  const HidField* type =
      joystick.find(HidReportKind::Output, hidUsage(0x0f, 0x21), hidUsage(0x0f, 0x27));
  ASSERT_TRUE(type);
  EXPECT_TRUE(type->isSelector);
  EXPECT_EQ(type->usages.size(), 3u);
  EXPECT_EQ(type->bit, 8);
  EXPECT_EQ(joystick.reportBytes(HidReportKind::Output, 1), 17);
  EXPECT_EQ(joystick.reportBytes(HidReportKind::Feature, 0x12), 4);
}

TEST(HidDescriptors, AMaximumWithItsTopBitSetIsPositiveWhereNothingIsNegative) {
  const HidDescriptor a({0x15, 0x00, 0x25, 0xff, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02});
  EXPECT_EQ(a.fields()[0].most, 255);
  const HidDescriptor b({0x15, 0x81, 0x25, 0xff, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02});
  EXPECT_EQ(b.fields()[0].most, -1);
}

TEST(HidDescriptors, PushedSettingsComeBack) {
  const HidDescriptor d({0x75, 0x08, 0x95, 0x01, 0xa4, 0x75, 0x10, 0x81, 0x02, 0xb4, 0x81, 0x02});
  ASSERT_EQ(d.fields().size(), 2u);
  EXPECT_EQ(d.fields()[0].bits, 16);
  EXPECT_EQ(d.fields()[1].bits, 8);
  EXPECT_EQ(d.fields()[1].bit, 16);
}

TEST(HidDescriptors, CutShortWithinAnItemOrACollectionAreRefused) {
  for (long length = 1; length < static_cast<long>(kMouse.size()); ++length) {
    if (length == 2 || length == 4) continue;  // whole items, and no collection has begun
    EXPECT_TRUE(
        isRefused([&] { HidDescriptor descriptor(Bytes(kMouse.begin(), kMouse.begin() + length)); },
                  "the report descriptor is wrong before byte"))
        << length;
  }
}

TEST(HidDescriptors, ImpossibleItemsAreRefusedWithTheirPlace) {
  const std::pair<Bytes, const char*> cases[] = {
      {{0xc0}, "before byte 1: a collection ends that did not begin"},
      {{0xa1, 0x01}, "before byte 2: a collection does not end"},
      {{0xb4}, "a pop has no push"},
      {{0xa4}, "a push has no pop"},
      {{0x85, 0x00}, "a report's number must be 1..255"},
      {{0x75}, "an item is cut short"},
      {{0xfe, 0x04, 0x00, 0x01}, "a long item is cut short"},
      {{0x0c}, "an item has a reserved type"},
      {{0x1a, 0x00, 0x00, 0x2a, 0xff, 0xff}, "a range of usages is backwards or too wide"},
      {{0x19, 0x05, 0x29, 0x04}, "a range of usages is backwards or too wide"},
      {{0x77, 0xff, 0xff, 0xff, 0xff, 0x97, 0xff, 0xff, 0xff, 0xff, 0x81, 0x02}, "too long"},
      {Bytes(20000, 0x00), "it is too long"},
      {Bytes(200, 0xa1), "collections lie too deep"},
  };
  for (const auto& [bytes, sentence] : cases)
    EXPECT_TRUE(isRefused([&, b = bytes] { HidDescriptor descriptor(b); }, sentence));
}

TEST(HidFields, ComeBackFromAnyPlace) {
  for (int bits = 1; bits <= 32; ++bits)
    for (int bit = 0; bit < 17; ++bit)
      for (bool isSigned : {false, true}) {
        const std::int64_t most =
            isSigned ? (std::int64_t{1} << (bits - 1)) - 1 : (std::int64_t{1} << bits) - 1;
        const std::int64_t least = isSigned ? -most - 1 : 0;
        const HidField field{HidReportKind::Output, 0, bit, bits, least, most, false, {}, {}};
        for (std::int64_t value : {least, most, (least + most) / 2, least + 1}) {
          if (value > most) continue;
          for (std::uint8_t around : {0x00, 0xff}) {
            Bytes report(7, around);
            writeHidField(field, value, report.data(), report.size());
            EXPECT_EQ(readHidField(field, report.data(), report.size()), value);
            // Nothing else changed: the other bits are as they were.
            writeHidField(field, around ? -1 : 0, report.data(), report.size());
            EXPECT_EQ(report, Bytes(7, around));
          }
        }
      }
}

TEST(HidFields, BeyondAReportAreZeroAndWriteNothing) {
  const HidField field{HidReportKind::Output, 0, 20, 8, 0, 255, false, {}, {}};
  Bytes report(3, 0x7f);
  EXPECT_EQ(readHidField(field, report.data(), report.size()), 0);
  writeHidField(field, 255, report.data(), report.size());
  EXPECT_EQ(report, Bytes(3, 0x7f));
}

}  // namespace
}  // namespace palpate::test
