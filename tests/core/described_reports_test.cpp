// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/described_reports.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "haptics/little_endian.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Type = HidNumber::Type;

HidDescription::Input someInput() {
  HidDescription::Input input;
  input.report = 4;
  input.length = 20;
  input.position = {HidNumber{1, Type::Int16, 1e-4, 0.5}, {}, HidNumber{3, Type::Int8, 1e-2, 0}};
  input.orientation = {
      HidNumber{4, Type::Float32, 1, 0}, HidNumber{8, Type::Float32, 1, 0}, {}, {}};
  input.joints = {HidNumber{12, Type::Uint32, 1e-9, 0}};
  input.sequence = HidNumber{16, Type::Uint16, 1, 0};
  input.buttons = HidNumber{18, Type::Uint16, 1, 0};
  return input;
}

Bytes someReport(float w) {
  Bytes bytes(20);
  bytes[0] = 4;
  writeLittleEndian<std::int16_t>(-1000, &bytes[1]);
  bytes[3] = 0x80;
  std::uint32_t pattern;
  std::memcpy(&pattern, &w, sizeof pattern);
  writeLittleEndian(pattern, &bytes[4]);
  writeLittleEndian<std::uint32_t>(4000000000u, &bytes[12]);
  writeLittleEndian<std::uint16_t>(65535, &bytes[16]);
  writeLittleEndian<std::uint16_t>(0x8001, &bytes[18]);
  return bytes;
}

TEST(DescribedReports, NumbersAreBiasPlusScaleTimesCount) {
  ToolPose pose;
  std::uint32_t sequence = 0;
  const Bytes bytes = someReport(-1.25f);
  ASSERT_TRUE(parseDescribedInput(someInput(), bytes.data(), bytes.size(), pose, sequence));
  EXPECT_EQ(pose.position, Eigen::Vector3d(0.5 - 0.1, 0, -1.28));
  EXPECT_EQ(pose.orientation.w(), -1) << "made a unit quaternion";
  EXPECT_EQ(pose.jointCount, 1);
  EXPECT_NEAR(pose.joints[0], 4, 1e-15);
  EXPECT_EQ(pose.buttons, 0x8001u);
  EXPECT_EQ(sequence, 65535u);
}

TEST(DescribedReports, AnyOtherLengthOrNumberIsNotTaken) {
  Bytes bytes = someReport(1);
  bytes.resize(64);
  ToolPose pose;
  std::uint32_t sequence = 0;
  for (std::size_t length = 0; length <= 64; ++length)
    EXPECT_EQ(parseDescribedInput(someInput(), bytes.data(), length, pose, sequence), length == 20);
  bytes[0] = 5;
  EXPECT_FALSE(parseDescribedInput(someInput(), bytes.data(), 20, pose, sequence));
}

TEST(DescribedReports, NothingThatIsNoNumberComesOfThem) {
  ToolPose pose;
  std::uint32_t sequence = 0;
  for (float w : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                  0.0f, 0.4f, 1.6f}) {
    const Bytes bytes = someReport(w);
    EXPECT_FALSE(parseDescribedInput(someInput(), bytes.data(), bytes.size(), pose, sequence)) << w;
  }
  HidDescription::Input input = someInput();
  input.orientation.clear();
  input.position[1] = HidNumber{4, Type::Float32, 1, 0};
  const Bytes bytes = someReport(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(parseDescribedInput(input, bytes.data(), bytes.size(), pose, sequence));
  EXPECT_EQ(pose.position, Eigen::Vector3d::Zero()) << "nothing was touched";
}

TEST(DescribedReports, WrenchesAreCountedInTheirUnitsAndEndAtTheRange) {
  HidDescription::Output output;
  output.report = 2;
  output.length = 13;
  output.force = {HidNumber{1, Type::Int16, -1e-3, 0}, {}, HidNumber{3, Type::Float32, 1, 0}};
  output.torque = {HidNumber{7, Type::Uint16, 1e-4, -1}, {}, {}};
  output.sequence = HidNumber{9, Type::Uint16, 1, 0};
  Bytes bytes(describedOutputBytes(output));
  ASSERT_EQ(bytes.size(), 13u);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  encodeDescribedOutput(output, {Eigen::Vector3d(2.5, 9, -0.25), Eigen::Vector3d(0.5, 0, 0)},
                        0x12345, bytes.data());
  EXPECT_EQ(bytes[0], 2);
  EXPECT_EQ(readLittleEndian<std::int16_t>(&bytes[1]), -2500);
  EXPECT_EQ(readLittleEndian<std::uint32_t>(&bytes[3]), 0xbe800000u);
  EXPECT_EQ(readLittleEndian<std::uint16_t>(&bytes[7]), 15000);
  EXPECT_EQ(readLittleEndian<std::uint16_t>(&bytes[9]), 0x2345) << "it wraps around";
  encodeDescribedOutput(output, {Eigen::Vector3d(1e9, 0, 1e300), Eigen::Vector3d(nan, 0, 0)}, 0,
                        bytes.data());
  EXPECT_EQ(readLittleEndian<std::int16_t>(&bytes[1]), -32768);
  EXPECT_LT(readLittleEndian<std::uint32_t>(&bytes[3]), 0x7f800000u) << "not infinite";
  EXPECT_EQ(readLittleEndian<std::uint16_t>(&bytes[7]), 10000) << "a count for zero";
}

TEST(DescribedReports, UnnumberedOutputHasAZeroBeforeItsData) {
  HidDescription::Output output;
  output.length = 4;
  output.force = {HidNumber{0, Type::Int16, 1, 0}, HidNumber{2, Type::Int16, 1, 0}, {}};
  Bytes bytes(describedOutputBytes(output));
  ASSERT_EQ(bytes.size(), 5u);
  encodeDescribedOutput(output, {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d::Zero()}, 0,
                        bytes.data());
  EXPECT_EQ(bytes, (Bytes{0, 1, 0, 2, 0}));
}

}  // namespace
}  // namespace palpate::test
