// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_bus.h"

#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "haptics/hidraw_path.h"
#include "haptics/joystick_reports.h"
#include "haptics/palpate_report.h"
#include "haptics/pid_reports.h"
#include "haptics/spacemouse_reports.h"

namespace palpate {
namespace {

bool hasUsage(const HidRecord& record, std::uint32_t usage) {
  return std::find(record.usages.begin(), record.usages.end(), usage) != record.usages.end();
}

std::string nameOf(const HidRecord& record) {
  return record.name.empty() ? record.path : record.name;
}

}  // namespace

HidKind kindOf(const HidRecord& record) noexcept {
  if (hasUsage(record, hidUsage(kPalpateUsagePage, kPalpateUsage))) return HidKind::PalpateReports;
  // Some receivers have other collections beside that of the six axes, the multi-axis controller.
  if (isSpaceMouse(record.vendor, record.product))
    return hasUsage(record, hidUsage(0x01, 0x08)) ? HidKind::SpaceMouse : HidKind::Unknown;
  const bool isStick = hasUsage(record, hidUsage(0x01, 0x04)) ||
                       hasUsage(record, hidUsage(0x01, 0x05)) ||
                       hasUsage(record, hidUsage(0x01, 0x08));
  if (!isStick) return HidKind::Unknown;
  try {
    const HidDescriptor descriptor(record.descriptor);
    const JoystickInput input(descriptor);
    return PidOutput::isComplete(descriptor) ? HidKind::ForceFeedback : HidKind::Joystick;
  } catch (const std::exception&) {
    return HidKind::Unknown;
  }
}

bool mayOpen(const HidRecord& record) noexcept {
  return access(record.path.c_str(), R_OK | W_OK) == 0;
}

HidOpener openerOf(const HidRecord& record) {
  return [record]() -> std::unique_ptr<HidTransport> {
    const std::string path = hidrawPathOf(record);
    return path.empty() ? nullptr : openHidTransport(path);
  };
}

std::unique_ptr<HidDevice> openHidDevice(const HidRecord& record, const AxisScale& scale) {
  std::unique_ptr<HidProtocol> protocol;
  switch (kindOf(record)) {
    case HidKind::PalpateReports:
      protocol = makePalpateProtocol();
      break;
    case HidKind::SpaceMouse:
      protocol = makeSpaceMouseProtocol(scale);
      break;
    case HidKind::ForceFeedback:
    case HidKind::Joystick:
      protocol = makeJoystickProtocol(HidDescriptor(record.descriptor), scale);
      break;
    case HidKind::Unknown:
      throw std::invalid_argument("what the reports of '" + nameOf(record) +
                                  "' mean is not known: it needs a description");
  }
  return std::make_unique<HidDevice>(nameOf(record), openerOf(record), std::move(protocol));
}

std::unique_ptr<HidDevice> openHidDevice(const HidDescription& description) {
  for (const HidRecord& record : listHidDevices())
    if (record.vendor == description.vendor && record.product == description.product)
      return std::make_unique<HidDevice>(description.info.name, openerOf(record),
                                         makeDescribedProtocol(description));
  throw std::runtime_error("the device '" + description.info.name + "' is not there");
}

}  // namespace palpate
