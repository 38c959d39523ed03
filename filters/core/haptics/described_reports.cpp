// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/described_reports.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "haptics/little_endian.h"

namespace palpate {
namespace {

/// The number as it stands, before scale and bias.
double countAt(const HidNumber& number, const std::uint8_t* bytes) noexcept {
  const std::uint8_t* at = bytes + number.offset;
  switch (number.type) {
    case HidNumber::Type::Int8:
      return readLittleEndian<std::int8_t>(at);
    case HidNumber::Type::Uint8:
      return readLittleEndian<std::uint8_t>(at);
    case HidNumber::Type::Int16:
      return readLittleEndian<std::int16_t>(at);
    case HidNumber::Type::Uint16:
      return readLittleEndian<std::uint16_t>(at);
    case HidNumber::Type::Int32:
      return readLittleEndian<std::int32_t>(at);
    case HidNumber::Type::Uint32:
      return readLittleEndian<std::uint32_t>(at);
    case HidNumber::Type::Float32:
      break;
  }
  const auto pattern = readLittleEndian<std::uint32_t>(at);
  float value;
  std::memcpy(&value, &pattern, sizeof value);
  return value;
}

void writeCount(const HidNumber& number, double count, std::uint8_t* bytes) noexcept {
  std::uint8_t* at = bytes + number.offset;
  switch (number.type) {
    case HidNumber::Type::Int8:
      return writeLittleEndian(saturated<std::int8_t>(count), at);
    case HidNumber::Type::Uint8:
      return writeLittleEndian(saturated<std::uint8_t>(count), at);
    case HidNumber::Type::Int16:
      return writeLittleEndian(saturated<std::int16_t>(count), at);
    case HidNumber::Type::Uint16:
      return writeLittleEndian(saturated<std::uint16_t>(count), at);
    case HidNumber::Type::Int32:
      return writeLittleEndian(saturated<std::int32_t>(count), at);
    case HidNumber::Type::Uint32:
      return writeLittleEndian(saturated<std::uint32_t>(count), at);
    case HidNumber::Type::Float32:
      break;
  }
  constexpr double most = 3.4e38;
  const float value = static_cast<float>(std::clamp(count, -most, most));
  std::uint32_t pattern;
  std::memcpy(&pattern, &value, sizeof pattern);
  writeLittleEndian(pattern, at);
}

double valueAt(const HidDescription::Component& number, const std::uint8_t* bytes) noexcept {
  return number ? number->bias + number->scale * countAt(*number, bytes) : 0;
}

void writeValue(const HidDescription::Component& number, double value,
                std::uint8_t* bytes) noexcept {
  if (!number) return;
  writeCount(*number, ((std::isnan(value) ? 0 : value) - number->bias) / number->scale, bytes);
}

}  // namespace

bool parseDescribedInput(const HidDescription::Input& input, const std::uint8_t* bytes,
                         std::size_t count, ToolPose& pose, std::uint32_t& sequence) noexcept {
  if (count != static_cast<std::size_t>(input.length) ||
      (input.report != 0 && bytes[0] != input.report))
    return false;
  ToolPose parsed;
  for (int i = 0; i < 3; ++i) parsed.position[i] = valueAt(input.position[i], bytes);
  if (!input.orientation.empty()) {
    Eigen::Vector4d q;
    for (int i = 0; i < 4; ++i) q[i] = valueAt(input.orientation[i], bytes);
    const double length = q.norm();
    if (!(length >= 0.5 && length <= 1.5)) return false;
    parsed.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    parsed.orientation.coeffs() /= length;
  }
  bool isFinite = parsed.position.allFinite();
  parsed.jointCount = static_cast<int>(input.joints.size());
  for (int j = 0; j < parsed.jointCount; ++j) {
    parsed.joints[j] = valueAt(input.joints[j], bytes);
    isFinite = isFinite && std::isfinite(parsed.joints[j]);
  }
  if (!isFinite) return false;
  if (input.buttons) parsed.buttons = saturated<std::uint32_t>(countAt(*input.buttons, bytes));
  if (input.sequence) sequence = saturated<std::uint32_t>(countAt(*input.sequence, bytes));
  pose = parsed;
  return true;
}

std::size_t describedOutputBytes(const HidDescription::Output& output) noexcept {
  return static_cast<std::size_t>(output.length) + (output.report == 0 ? 1 : 0);
}

void encodeDescribedOutput(const HidDescription::Output& output, const Wrench& wrench,
                           std::uint32_t sequence, std::uint8_t* bytes) noexcept {
  std::fill(bytes, bytes + describedOutputBytes(output), std::uint8_t{0});
  bytes[0] = static_cast<std::uint8_t>(output.report);
  std::uint8_t* const data = output.report == 0 ? bytes + 1 : bytes;
  for (int i = 0; i < 3; ++i) writeValue(output.force[i], wrench.force[i], data);
  for (std::size_t i = 0; i < output.torque.size(); ++i)
    writeValue(output.torque[i], wrench.torque[static_cast<int>(i)], data);
  if (!output.sequence) return;
  // Only as many bits as the field has: it wraps around.
  const HidNumber& number = *output.sequence;
  const int bytesOfSequence = number.type == HidNumber::Type::Uint8    ? 1
                              : number.type == HidNumber::Type::Uint16 ? 2
                                                                       : 4;
  for (int i = 0; i < bytesOfSequence; ++i)
    data[number.offset + i] = static_cast<std::uint8_t>(sequence >> (8 * i));
}

}  // namespace palpate
