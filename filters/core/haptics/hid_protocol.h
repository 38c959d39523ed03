// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "haptics/hid_axes.h"
#include "haptics/hid_description.h"
#include "haptics/hid_descriptor.h"
#include "haptics/hid_transport.h"

namespace palpate {

/// What one device's reports mean. Used by the thread that owns the device.
class HidProtocol {
 public:
  virtual ~HidProtocol() = default;

  virtual bool rendersWrenches() const noexcept { return false; }
  /// Whether the device reports only what changed, so that its silence says that it stands still.
  virtual bool reportsOnlyChanges() const noexcept { return false; }

  /// Prepares a device that was just opened, and forgets the one before.
  /// @param info  gets the limits that the device tells.
  /// @throws std::runtime_error with what it lacks.
  virtual void start(HidTransport& transport, DeviceInfo& info) = 0;

  /// @return whether a report was a new state; anything else is ignored.
  virtual bool take(const std::uint8_t* bytes, std::size_t count) noexcept = 0;

  /// What was last taken, or known from the start; null before.
  virtual const ToolPose* pose() const noexcept = 0;

  /// @return false if it did not arrive.
  virtual bool render(HidTransport&, const Wrench&) noexcept { return true; }
  /// Renders nothing until the next wrench.
  virtual void rest(HidTransport&) noexcept {}
};

/// The SpaceMouse family: six axes in, nothing out.
std::unique_ptr<HidProtocol> makeSpaceMouseProtocol(const AxisScale& scale);

/// Sticks that describe their axes, with force feedback if they describe all of it (PidOutput).
/// PID has no watchdog: killed rather than closed, this program leaves a stick with its last force.
/// @throws std::invalid_argument if there is no axis.
std::unique_ptr<HidProtocol> makeJoystickProtocol(const HidDescriptor& descriptor,
                                                  const AxisScale& scale);

/// Palpate's own reports. States of a device that is not calibrated are not taken.
std::unique_ptr<HidProtocol> makePalpateProtocol();

/// A board that a description maps.
std::unique_ptr<HidProtocol> makeDescribedProtocol(const HidDescription& description);

}  // namespace palpate
