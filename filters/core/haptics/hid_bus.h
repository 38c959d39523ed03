// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "haptics/hid_device.h"

/// HID devices of this machine. The library hidapi is loaded by the first call, so that whoever
/// needs no device does not need it.
namespace palpate {

/// One device as the system lists it.
struct HidRecord {
  std::string path, manufacturer, name, serial;
  std::uint16_t vendor = 0, product = 0;
  int interface = -1;                    ///< of USB; -1 if it has none
  std::vector<std::uint32_t> usages;     ///< of its top-level collections, see hidUsage
  std::vector<std::uint8_t> descriptor;  ///< its report descriptor; empty if it cannot be read
};

/// What Palpate can do with a device.
enum class HidKind { PalpateReports, SpaceMouse, ForceFeedback, Joystick, Unknown };
HidKind kindOf(const HidRecord& record) noexcept;

/// @throws std::runtime_error if hidapi is not there.
std::vector<HidRecord> listHidDevices();

/// Opens a device by its path.
/// @throws std::runtime_error if hidapi is not there, or with how to mend that it cannot be opened.
std::unique_ptr<HidTransport> openHidTransport(const std::string& path);

/// Whether this user may open it.
bool mayOpen(const HidRecord& record) noexcept;

/// Opens the device of a record, or the same model and serial number when it has come back under
/// another path.
HidOpener openerOf(const HidRecord& record);

/// Opens a device of a known kind.
/// @throws std::invalid_argument if its kind is Unknown: a description is needed;
///         as HidDevice does.
std::unique_ptr<HidDevice> openHidDevice(const HidRecord& record, const AxisScale& scale = {});

/// Opens the first device that a description is for.
/// @throws std::runtime_error if there is none; as HidDevice does.
std::unique_ptr<HidDevice> openHidDevice(const HidDescription& description);

}  // namespace palpate
