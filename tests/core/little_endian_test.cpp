// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/little_endian.h"

#include <gtest/gtest.h>

namespace palpate::test {
namespace {

TEST(LittleEndian, TheLeastSignificantByteComesFirst) {
  const std::uint8_t bytes[] = {0x01, 0x02, 0x03, 0xff};
  EXPECT_EQ(readLittleEndian<std::uint8_t>(bytes), 1);
  EXPECT_EQ(readLittleEndian<std::uint16_t>(bytes), 0x0201);
  EXPECT_EQ(readLittleEndian<std::uint32_t>(bytes), 0xff030201u);
  EXPECT_EQ(readLittleEndian<std::int32_t>(bytes), -0x00fcfdff);
  EXPECT_EQ(readLittleEndian<std::int8_t>(bytes + 3), -1);
}

TEST(LittleEndian, WhatIsWrittenIsRead) {
  for (std::int32_t value : {0, 1, -1, 65536, std::numeric_limits<std::int32_t>::min()}) {
    std::uint8_t bytes[4];
    writeLittleEndian(value, bytes);
    EXPECT_EQ(readLittleEndian<std::int32_t>(bytes), value);
  }
}

TEST(Saturation, RoundsWithinTheRangeAndEndsAtIt) {
  EXPECT_EQ(saturated<std::int16_t>(1.4), 1);
  EXPECT_EQ(saturated<std::int16_t>(-1.6), -2);
  EXPECT_EQ(saturated<std::int16_t>(32767.4), 32767);
  EXPECT_EQ(saturated<std::int16_t>(1e300), 32767);
  EXPECT_EQ(saturated<std::int16_t>(-std::numeric_limits<double>::infinity()), -32768);
  EXPECT_EQ(saturated<std::uint8_t>(-3), 0);
  EXPECT_EQ(saturated<std::uint32_t>(5e9), 4294967295u);
  EXPECT_EQ(saturated<std::int32_t>(std::numeric_limits<double>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace palpate::test
