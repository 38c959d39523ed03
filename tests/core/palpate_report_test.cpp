// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/palpate_report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "haptics/hid_descriptor.h"
#include "haptics/little_endian.h"

namespace palpate::test {
namespace {

PalpateState someState() {
  PalpateState state;
  state.flags = PalpateState::kCalibrated | PalpateState::kActuatorsOn;
  state.sequence = 0xfedcba98;
  state.microseconds = 12345678;
  state.pose.position = Eigen::Vector3d(0.123456789, -0.05, 1e-9);
  state.pose.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  state.pose.buttons = 0x80000001;
  state.pose.jointCount = 2;
  state.pose.joints[0] = 1.5;
  state.pose.joints[1] = -0.0123;
  return state;
}

bool parse(const PalpateReport& report, PalpateState& state) {
  return parsePalpateState(report.data(), report.size(), state);
}

TEST(PalpateReports, StatesComeBackToTheStepOfTheirUnits) {
  const PalpateState sent = someState();
  PalpateState got;
  ASSERT_TRUE(parse(encodePalpateState(sent), got));
  EXPECT_EQ(got.flags, sent.flags);
  EXPECT_EQ(got.sequence, sent.sequence);
  EXPECT_EQ(got.microseconds, sent.microseconds);
  EXPECT_LE((got.pose.position - sent.pose.position).norm(), 1e-9);
  EXPECT_LE((got.pose.orientation.coeffs() - sent.pose.orientation.coeffs()).norm(), 2e-9);
  EXPECT_EQ(got.pose.buttons, sent.pose.buttons);
  ASSERT_EQ(got.pose.jointCount, 2);
  EXPECT_NEAR(got.pose.joints[0], 1.5, 5e-5);
  EXPECT_NEAR(got.pose.joints[1], -0.0123, 5e-5);
}

TEST(PalpateReports, WrenchesAndCapabilitiesComeBackToo) {
  PalpateWrench sent;
  sent.flags = PalpateWrench::kEnable;
  sent.sequence = 7;
  sent.answers = 0xffffffff;
  sent.wrench = {Eigen::Vector3d(3.3, -0.000001, 0), Eigen::Vector3d(0, 0.25, -0.1)};
  const PalpateReport report = encodePalpateWrench(sent);
  PalpateWrench got;
  ASSERT_TRUE(parsePalpateWrench(report.data(), report.size(), got));
  EXPECT_EQ(got.flags, 1);
  EXPECT_EQ(got.sequence, 7u);
  EXPECT_EQ(got.answers, 0xffffffffu);
  EXPECT_LE((got.wrench.force - sent.wrench.force).norm(), 1e-6);
  EXPECT_LE((got.wrench.torque - sent.wrench.torque).norm(), 1e-6);

  const PalpateReport second = encodePalpateCapability({3.3, 0.15, 1200, 2000, 15});
  PalpateCapability capability;
  ASSERT_TRUE(parsePalpateCapability(second.data(), second.size(), capability));
  EXPECT_EQ(capability.largestForce, 3.3);
  EXPECT_EQ(capability.largestTorque, 0.15);
  EXPECT_EQ(capability.largestStiffness, 1200);
  EXPECT_EQ(capability.reportsPerSecond, 2000);
  EXPECT_EQ(capability.watchdogMilliseconds, 15);
}

TEST(PalpateReports, BytesStandWhereTheDocumentSaysThem) {
  const PalpateReport state = encodePalpateState(someState());
  EXPECT_EQ(state[0], 1);
  EXPECT_EQ(state[1], 1);
  EXPECT_EQ(readLittleEndian<std::uint16_t>(&state[2]), 3);
  EXPECT_EQ(readLittleEndian<std::uint32_t>(&state[4]), 0xfedcba98u);
  EXPECT_EQ(readLittleEndian<std::uint32_t>(&state[8]), 12345678u);
  EXPECT_EQ(readLittleEndian<std::int32_t>(&state[12]), 123456789);
  EXPECT_EQ(readLittleEndian<std::int32_t>(&state[16]), -50000000);
  EXPECT_EQ(readLittleEndian<std::int32_t>(&state[24]), 1 << 29);
  EXPECT_EQ(readLittleEndian<std::int32_t>(&state[36]), -(1 << 29));
  EXPECT_EQ(readLittleEndian<std::uint32_t>(&state[40]), 0x80000001u);
  EXPECT_EQ(readLittleEndian<std::int16_t>(&state[44]), 15000);
  EXPECT_EQ(state[60], 2);
  PalpateWrench push;
  push.wrench = {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -0.5)};
  const PalpateReport wrench = encodePalpateWrench(push);
  EXPECT_EQ(wrench[0], 2);
  EXPECT_EQ(readLittleEndian<std::int32_t>(&wrench[12]), 1000000);
  EXPECT_EQ(readLittleEndian<std::int32_t>(&wrench[32]), -500000);
}

TEST(PalpateReports, AnyOtherLengthNumberOrVersionIsNotTaken) {
  PalpateReport report = encodePalpateState(someState());
  std::array<std::uint8_t, 128> longer{};
  std::copy(report.begin(), report.end(), longer.begin());
  PalpateState state;
  for (std::size_t length = 0; length <= longer.size(); ++length)
    EXPECT_EQ(parsePalpateState(longer.data(), length, state), length == 64) << length;
  for (int number = 0; number < 256; ++number) {
    report[0] = static_cast<std::uint8_t>(number);
    EXPECT_EQ(parse(report, state), number == 1);
  }
  report[0] = 1;
  for (int version : {0, 2, 255}) {
    report[1] = static_cast<std::uint8_t>(version);
    EXPECT_FALSE(parse(report, state));
  }
}

TEST(PalpateReports, OrientationsThatAreNoneAreNotTaken) {
  PalpateState sent = someState(), got;
  for (double length : {0.0, 0.49, 1.51, 1.99}) {
    sent.pose.orientation = Eigen::Quaterniond(0, length, 0, 0);
    EXPECT_FALSE(parse(encodePalpateState(sent), got)) << length;
  }
  EXPECT_EQ(got.sequence, 0u) << "nothing was touched";
  for (double length : {0.51, 1.0, 1.49}) {
    sent.pose.orientation = Eigen::Quaterniond(0, 0, length, 0);
    ASSERT_TRUE(parse(encodePalpateState(sent), got));
    EXPECT_NEAR(got.pose.orientation.norm(), 1, 1e-15);
  }
  PalpateReport report = encodePalpateState(someState());
  report[60] = 9;
  EXPECT_FALSE(parse(report, got)) << "more joints than there is room for";
}

TEST(PalpateReports, ForcesBeyondTheRangeEndAtItAndWhatIsNoneIsZero) {
  PalpateWrench sent, got;
  sent.wrench.force = Eigen::Vector3d(1e9, -1e9, std::numeric_limits<double>::quiet_NaN());
  sent.wrench.torque = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  const PalpateReport report = encodePalpateWrench(sent);
  ASSERT_TRUE(parsePalpateWrench(report.data(), report.size(), got));
  EXPECT_NEAR(got.wrench.force.x(), 2147.483647, 1e-9);
  EXPECT_NEAR(got.wrench.force.y(), -2147.483648, 1e-9);
  EXPECT_EQ(got.wrench.force.z(), 0);
  EXPECT_TRUE(got.wrench.torque.allFinite());
}

TEST(PalpateReports, TheDescriptorDescribesThem) {
  const HidDescriptor descriptor(
      {kPalpateReportDescriptor.begin(), kPalpateReportDescriptor.end()});
  EXPECT_TRUE(descriptor.numbersReports());
  const int size = static_cast<int>(kPalpateReportSize) - 1;
  EXPECT_EQ(descriptor.reportBytes(HidReportKind::Input, kStateReport), size);
  EXPECT_EQ(descriptor.reportBytes(HidReportKind::Output, kWrenchReport), size);
  EXPECT_EQ(descriptor.reportBytes(HidReportKind::Feature, kCapabilityReport), size);
  EXPECT_TRUE(descriptor.fields().front().isIn(hidUsage(kPalpateUsagePage, kPalpateUsage)));
}

TEST(PalpateReports, TheDocumentsDescriptorIsTheFirmwares) {
  std::ifstream file(PALPATE_REPORT_DOCUMENT);
  ASSERT_TRUE(file);
  std::string line;
  while (std::getline(file, line) && line != "```") {
  }
  std::vector<std::uint8_t> bytes;
  while (std::getline(file, line) && line != "```") {
    std::istringstream words(line);
    std::string word;
    while (words >> word && word.size() == 2 &&
           word.find_first_not_of("0123456789ABCDEF") == std::string::npos)
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(word, nullptr, 16)));
  }
  EXPECT_EQ(bytes, std::vector<std::uint8_t>(kPalpateReportDescriptor.begin(),
                                             kPalpateReportDescriptor.end()));
}

TEST(ReportNumbers, LateAndRepeatedOnesAreNotNewAndNoneIsMissed) {
  ReportNumbering numbering;
  EXPECT_TRUE(numbering.isNew(0xfffffffe));
  EXPECT_TRUE(numbering.isNew(0xffffffff));
  EXPECT_TRUE(numbering.isNew(0)) << "they wrap around";
  EXPECT_FALSE(numbering.isNew(0));
  EXPECT_FALSE(numbering.isNew(0xffffffff));
  EXPECT_TRUE(numbering.isNew(5)) << "some were lost";
  for (std::uint32_t late : {1u, 2u, 3u, 4u, 5u}) EXPECT_FALSE(numbering.isNew(late));
  EXPECT_TRUE(numbering.isNew(6));
}

TEST(ReportNumbers, ADeviceThatCountsAnewIsFollowedBeforeLong) {
  ReportNumbering numbering;
  EXPECT_TRUE(numbering.isNew(1000000));
  std::uint32_t restarted = 0;
  while (restarted < 1000 && !numbering.isNew(restarted)) ++restarted;
  EXPECT_EQ(restarted, ReportNumbering::kLateBeforeAnew - 1);
  EXPECT_TRUE(numbering.isNew(restarted + 1));
  EXPECT_FALSE(numbering.isNew(restarted));
}

}  // namespace
}  // namespace palpate::test
