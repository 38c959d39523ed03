// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "haptics/hid_axes.h"
#include "haptics/hid_descriptor.h"

namespace palpate {

/// Six axes and 32 buttons of whatever describes itself by HID's generic axes (usage page 0x01).
/// All are in one report; axes that the device lacks stay at 0.
class JoystickInput {
 public:
  /// @throws std::invalid_argument if the descriptor has no axis that can be read.
  explicit JoystickInput(const HidDescriptor& descriptor);

  /// Takes one report as it comes, with its number in front if it is numbered.
  /// @return false, with `pose` untouched, for any other number or length.
  bool parse(const std::uint8_t* bytes, std::size_t count, const AxisScale& scale,
             ToolPose& pose) const noexcept;

 private:
  std::vector<HidField> fields_, buttons_;
  std::uint8_t report_ = 0;
  bool isNumbered_ = false;
  std::size_t bytes_ = 0;  ///< after the number
};

}  // namespace palpate
