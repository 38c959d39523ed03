// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/palpate_report.h"

#include <algorithm>
#include <cmath>

#include "haptics/little_endian.h"

namespace palpate {
namespace {

constexpr double kMetre = 1e9;          // nm
constexpr double kUnit = 1 << 30;       // of a quaternion
constexpr double kRadian = 1e4;         // 0.1 mrad
constexpr double kNewton = 1e6;         // uN, and uN m
constexpr double kNewtonRoughly = 1e3;  // mN, and mN m

bool isReport(const std::uint8_t* bytes, std::size_t count, std::uint8_t number) noexcept {
  return count == kPalpateReportSize && bytes[0] == number && bytes[1] == kPalpateReportVersion;
}

PalpateReport emptyReport(std::uint8_t number) noexcept {
  PalpateReport report{};
  report[0] = number;
  report[1] = kPalpateReportVersion;
  return report;
}

Eigen::Vector3d readVector(const std::uint8_t* bytes, double unit) noexcept {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = readLittleEndian<std::int32_t>(bytes + 4 * i) / unit;
  return v;
}

void writeVector(const Eigen::Vector3d& v, double unit, std::uint8_t* bytes) noexcept {
  for (int i = 0; i < 3; ++i)
    writeLittleEndian(saturated<std::int32_t>(unit * v[i]), bytes + 4 * i);
}

}  // namespace

bool parsePalpateState(const std::uint8_t* bytes, std::size_t count, PalpateState& state) noexcept {
  if (!isReport(bytes, count, kStateReport) || bytes[60] > kPalpateReportJoints) return false;
  Eigen::Vector4d q;  // w x y z
  for (int i = 0; i < 4; ++i) q[i] = readLittleEndian<std::int32_t>(bytes + 24 + 4 * i) / kUnit;
  const double length = q.norm();
  if (length < 0.5 || length > 1.5) return false;
  q /= length;
  state.flags = readLittleEndian<std::uint16_t>(bytes + 2);
  state.sequence = readLittleEndian<std::uint32_t>(bytes + 4);
  state.microseconds = readLittleEndian<std::uint32_t>(bytes + 8);
  state.pose.position = readVector(bytes + 12, kMetre);
  state.pose.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  state.pose.buttons = readLittleEndian<std::uint32_t>(bytes + 40);
  state.pose.jointCount = bytes[60];
  for (int j = 0; j < state.pose.jointCount; ++j)
    state.pose.joints[j] = readLittleEndian<std::int16_t>(bytes + 44 + 2 * j) / kRadian;
  return true;
}

bool parsePalpateWrench(const std::uint8_t* bytes, std::size_t count,
                        PalpateWrench& wrench) noexcept {
  if (!isReport(bytes, count, kWrenchReport)) return false;
  wrench.flags = readLittleEndian<std::uint16_t>(bytes + 2);
  wrench.sequence = readLittleEndian<std::uint32_t>(bytes + 4);
  wrench.answers = readLittleEndian<std::uint32_t>(bytes + 8);
  wrench.wrench.force = readVector(bytes + 12, kNewton);
  wrench.wrench.torque = readVector(bytes + 24, kNewton);
  return true;
}

bool parsePalpateCapability(const std::uint8_t* bytes, std::size_t count,
                            PalpateCapability& capability) noexcept {
  if (!isReport(bytes, count, kCapabilityReport)) return false;
  capability.largestForce = readLittleEndian<std::uint32_t>(bytes + 4) / kNewtonRoughly;
  capability.largestTorque = readLittleEndian<std::uint32_t>(bytes + 8) / kNewtonRoughly;
  capability.largestStiffness = readLittleEndian<std::uint32_t>(bytes + 12);
  capability.reportsPerSecond = readLittleEndian<std::uint16_t>(bytes + 16);
  capability.watchdogMilliseconds = readLittleEndian<std::uint16_t>(bytes + 18);
  return true;
}

PalpateReport encodePalpateState(const PalpateState& state) noexcept {
  PalpateReport report = emptyReport(kStateReport);
  writeLittleEndian(state.flags, &report[2]);
  writeLittleEndian(state.sequence, &report[4]);
  writeLittleEndian(state.microseconds, &report[8]);
  writeVector(state.pose.position, kMetre, &report[12]);
  const Eigen::Quaterniond& q = state.pose.orientation;
  const double components[] = {q.w(), q.x(), q.y(), q.z()};
  for (int i = 0; i < 4; ++i)
    writeLittleEndian(saturated<std::int32_t>(kUnit * components[i]), &report[24 + 4 * i]);
  writeLittleEndian(state.pose.buttons, &report[40]);
  const int joints = std::clamp(state.pose.jointCount, 0, kPalpateReportJoints);
  for (int j = 0; j < joints; ++j)
    writeLittleEndian(saturated<std::int16_t>(kRadian * state.pose.joints[j]), &report[44 + 2 * j]);
  report[60] = static_cast<std::uint8_t>(joints);
  return report;
}

PalpateReport encodePalpateWrench(const PalpateWrench& wrench) noexcept {
  PalpateReport report = emptyReport(kWrenchReport);
  writeLittleEndian(wrench.flags, &report[2]);
  writeLittleEndian(wrench.sequence, &report[4]);
  writeLittleEndian(wrench.answers, &report[8]);
  writeVector(wrench.wrench.force, kNewton, &report[12]);
  writeVector(wrench.wrench.torque, kNewton, &report[24]);
  return report;
}

PalpateReport encodePalpateCapability(const PalpateCapability& capability) noexcept {
  PalpateReport report = emptyReport(kCapabilityReport);
  writeLittleEndian(saturated<std::uint32_t>(kNewtonRoughly * capability.largestForce), &report[4]);
  writeLittleEndian(saturated<std::uint32_t>(kNewtonRoughly * capability.largestTorque),
                    &report[8]);
  writeLittleEndian(saturated<std::uint32_t>(capability.largestStiffness), &report[12]);
  writeLittleEndian(saturated<std::uint16_t>(capability.reportsPerSecond), &report[16]);
  writeLittleEndian(saturated<std::uint16_t>(capability.watchdogMilliseconds), &report[18]);
  return report;
}

bool ReportNumbering::isNew(std::uint32_t sequence) noexcept {
  const auto ahead = static_cast<std::int32_t>(sequence - last_);
  if (hasBegun_ && ahead == 0) return false;
  if (hasBegun_ && ahead < 0 && ++late_ < kLateBeforeAnew) return false;
  hasBegun_ = true;
  last_ = sequence;
  late_ = 0;
  return true;
}

}  // namespace palpate
