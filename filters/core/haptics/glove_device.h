// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "haptics/hand_model.h"
#include "haptics/scripted_device.h"

namespace palpate {

/// A hand in a data glove of 22 angles (HandJoint), replayed from a trace. Its pose is the
/// forearm's at the wrist; it takes wrenches as a scripted device does.
class GloveDevice final : public HapticDevice {
 public:
  /// @throws std::invalid_argument if a moment of the trace has other than 22 joints, or there is
  ///         none.
  explicit GloveDevice(DeviceRecording trace, const HandModel& hand = HandModel());

  const DeviceInfo& info() const override { return script_.info(); }
  bool read(DeviceState& state) noexcept override { return script_.read(state); }
  bool write(const Wrench& wrench) noexcept override { return script_.write(wrench); }

  const HandModel& hand() const noexcept { return hand_; }
  const ScriptedDevice& script() const noexcept { return script_; }

 private:
  ScriptedDevice script_;
  HandModel hand_;
};

/// @throws std::invalid_argument naming the first moment that has other than 22 joints.
void requireHandJoints(const DeviceRecording& trace);

/// A trace of a hand that closes from flat to a fist-like grasp, smoothly.
/// @param moments  at least 2.
/// @param pose     of the forearm, kept.
/// @throws std::invalid_argument for fewer.
DeviceRecording closingHand(int moments, const ToolPose& pose = {});

}  // namespace palpate
