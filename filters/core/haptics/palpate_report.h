// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "contact/wrench.h"
#include "haptics/haptic_device.h"

/// Palpate's own HID reports for open hardware, as palpate_report.md tells: pose in, force out,
/// numbered, 64 bytes each with the report's number in front, least significant byte first.
namespace palpate {

constexpr std::size_t kPalpateReportSize = 64;
using PalpateReport = std::array<std::uint8_t, kPalpateReportSize>;

/// The top-level collection by which such a device is known, whoever its vendor is.
constexpr std::uint16_t kPalpateUsagePage = 0xff50, kPalpateUsage = 0x01;
constexpr std::uint8_t kStateReport = 1, kWrenchReport = 2, kCapabilityReport = 3;
constexpr std::uint8_t kPalpateReportVersion = 1;
constexpr int kPalpateReportJoints = 8;

/// The report descriptor that the firmware gives.
constexpr std::array<std::uint8_t, 35> kPalpateReportDescriptor = {
    0x06, 0x50, 0xff,                    // usage page (vendor-defined 0xff50)
    0x09, 0x01,                          // usage (force device)
    0xa1, 0x01,                          // collection (application)
    0x15, 0x00, 0x26, 0xff, 0x00,        //   logical range 0..255
    0x75, 0x08, 0x95, 0x3f,              //   63 bytes
    0x85, 0x01, 0x09, 0x02, 0x81, 0x02,  //   report 1: input, state
    0x85, 0x02, 0x09, 0x03, 0x91, 0x02,  //   report 2: output, wrench
    0x85, 0x03, 0x09, 0x04, 0xb1, 0x02,  //   report 3: feature, capabilities
    0xc0,                                // end collection
};

/// Report 1, device to host.
struct PalpateState {
  static constexpr std::uint16_t kCalibrated = 1;     ///< the pose is absolute
  static constexpr std::uint16_t kActuatorsOn = 2;    ///< it renders wrenches
  static constexpr std::uint16_t kWatchdogSlack = 4;  ///< none came in time, it renders zero

  std::uint16_t flags = 0;
  std::uint32_t sequence = 0;      ///< one more with each report
  std::uint32_t microseconds = 0;  ///< of the device's own clock
  ToolPose pose;                   ///< not more than kPalpateReportJoints joints
};

/// Report 2, host to device.
struct PalpateWrench {
  static constexpr std::uint16_t kEnable = 1;  ///< render it; without, switch off

  std::uint16_t flags = 0;
  std::uint32_t sequence = 0;  ///< one more with each report
  std::uint32_t answers = 0;   ///< sequence of the state that it answers
  Wrench wrench = kNoWrench;
};

/// Report 3, a feature that the host reads when it opens the device.
struct PalpateCapability {
  double largestForce = 0;      ///< N, in steps of 1 mN
  double largestTorque = 0;     ///< N m, in steps of 1 mN m
  double largestStiffness = 0;  ///< N/m, in steps of 1 N/m
  int reportsPerSecond = 1000;
  int watchdogMilliseconds = 20;
};

/// @return false, with the result untouched, unless the bytes are exactly one such report: its
///         length, number and version, in a state also a count of joints within range and an
///         orientation whose length is within 0.5..1.5, which is then made a unit quaternion.
bool parsePalpateState(const std::uint8_t* bytes, std::size_t count, PalpateState& state) noexcept;
bool parsePalpateWrench(const std::uint8_t* bytes, std::size_t count,
                        PalpateWrench& wrench) noexcept;
bool parsePalpateCapability(const std::uint8_t* bytes, std::size_t count,
                            PalpateCapability& capability) noexcept;

/// Numbers beyond a field's range end at it; what is no number becomes 0.
PalpateReport encodePalpateState(const PalpateState& state) noexcept;
PalpateReport encodePalpateWrench(const PalpateWrench& wrench) noexcept;
PalpateReport encodePalpateCapability(const PalpateCapability& capability) noexcept;

/// Tells new reports from late and repeated ones by their numbers, which wrap around.
class ReportNumbering {
 public:
  /// After so many late reports in a row the device has begun to count anew.
  static constexpr int kLateBeforeAnew = 100;

  /// @return whether a report is newer than all before it.
  bool isNew(std::uint32_t sequence) noexcept;

 private:
  bool hasBegun_ = false;
  std::uint32_t last_ = 0;
  int late_ = 0;
};

}  // namespace palpate
