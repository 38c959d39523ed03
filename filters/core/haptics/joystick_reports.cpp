// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/joystick_reports.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {
namespace {

constexpr std::uint16_t kGenericDesktop = 0x01, kX = 0x30, kButtons = 0x09;

/// -1..1 over the logical range, 0 in its middle.
double normalized(const HidField& field, std::int64_t value) noexcept {
  const double middle = 0.5 * (static_cast<double>(field.least) + static_cast<double>(field.most));
  const double half = 0.5 * (static_cast<double>(field.most) - static_cast<double>(field.least));
  return std::clamp((static_cast<double>(value) - middle) / half, -1.0, 1.0);
}

bool isAxis(const HidField& field) {
  if (field.kind != HidReportKind::Input || field.isSelector || field.most <= field.least ||
      field.usages.size() != 1)
    return false;
  const std::uint32_t first = hidUsage(kGenericDesktop, kX);
  return field.usages.front() >= first && field.usages.front() < first + 6;
}

}  // namespace

JoystickInput::JoystickInput(const HidDescriptor& descriptor)
    : isNumbered_(descriptor.numbersReports()) {
  for (const HidField& field : descriptor.fields()) {
    if (!isAxis(field) || (!fields_.empty() && field.report != report_)) continue;
    report_ = field.report;
    fields_.push_back(field);
  }
  if (fields_.empty()) throw std::invalid_argument("the device describes no axis to read");
  bytes_ = static_cast<std::size_t>(descriptor.reportBytes(HidReportKind::Input, report_));
  for (const HidField& field : descriptor.fields())
    if (field.kind == HidReportKind::Input && field.report == report_ && !field.isSelector &&
        field.bits == 1 && field.usages.size() == 1 && field.usages.front() >> 16 == kButtons &&
        buttons_.size() < 32)
      buttons_.push_back(field);
}

bool JoystickInput::parse(const std::uint8_t* bytes, std::size_t count, const AxisScale& scale,
                          ToolPose& pose) const noexcept {
  if (isNumbered_) {
    if (count == 0 || bytes[0] != report_) return false;
    ++bytes;
    --count;
  }
  if (count != bytes_) return false;
  double axes[6] = {};
  for (const HidField& field : fields_)
    axes[field.usages.front() - hidUsage(kGenericDesktop, kX)] =
        normalized(field, readHidField(field, bytes, count));
  pose = deflectedPose(Eigen::Vector3d(axes[0], axes[1], axes[2]),
                       Eigen::Vector3d(axes[3], axes[4], axes[5]), scale);
  for (std::size_t i = 0; i < buttons_.size(); ++i)
    pose.buttons |= static_cast<std::uint32_t>(readHidField(buttons_[i], bytes, count)) << i;
  return true;
}

}  // namespace palpate
