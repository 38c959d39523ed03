// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "haptics/hid_descriptor.h"

namespace palpate {

/// Force feedback by USB's Physical Interface Device class (PID 1.0, usage page 0x0f), as far as a
/// force per axis needs it: one effect of constant force for each axis, created and started once,
/// whose magnitude then changes. Layouts come from the device's own report descriptor.
///
/// Reports are as hidapi wants them: the report's number first, 0 if it has none.
class PidOutput {
 public:
  using Report = std::vector<std::uint8_t>;

  /// Whether a descriptor has all that it takes.
  static bool isComplete(const HidDescriptor& descriptor) noexcept;

  /// @throws std::invalid_argument with what the descriptor lacks.
  explicit PidOutput(const HidDescriptor& descriptor);

  /// Axes of HID that effects act on: 0, 1, 2 for X, Y, Z.
  const std::vector<int>& axes() const noexcept { return axes_; }

  /// Feature to set: creates an effect of constant force.
  Report createEffect() const;
  /// Feature to get after it; its first byte is the number to ask for.
  Report blockLoad() const;
  /// The new effect's block, from what was got.
  /// @return nothing if the device had no room, or the bytes are not that report.
  std::optional<int> loadedBlock(const std::uint8_t* bytes, std::size_t count) const noexcept;

  /// Output reports. An effect acts on one axis, without end, as strongly as the device can.
  Report resetDevice() const;
  Report enableActuators() const;
  Report largestGain() const;  ///< empty if the device has no gain
  Report setEffect(int block, int axis) const;
  Report startEffect(int block) const;
  Report stopEffects() const;

  /// @param fraction  of the device's largest force, cut off at -1 and 1; 0 if it is no number.
  /// @param report    as long as constantForceBytes(), overwritten.
  void constantForce(int block, double fraction, std::uint8_t* report) const noexcept;
  std::size_t constantForceBytes() const noexcept { return forceBytes_; }

 private:
  Report empty(const HidField& field) const;
  Report operation(int block, std::uint16_t usage) const;
  Report control(std::uint16_t usage) const;
  const HidField& need(HidReportKind kind, std::uint16_t collection, std::uint32_t usage,
                       const char* what) const;

  HidDescriptor descriptor_;
  std::vector<int> axes_;
  HidField forceBlock_, forceMagnitude_;
  std::size_t forceBytes_ = 0;
};

}  // namespace palpate
