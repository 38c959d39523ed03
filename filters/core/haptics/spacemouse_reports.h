// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "haptics/hid_axes.h"

namespace palpate {

/// What a SpaceMouse has reported so far: its reports each hold a part.
struct SpaceMouseState {
  std::array<std::int16_t, 6> axes{};  ///< x y z rx ry rz in HID's axes, +-350 at full deflection
  std::uint32_t buttons = 0;           ///< a bit each
};

/// Whether a device belongs to 3Dconnexion's six-axis family: 046d:c603..c62b and
/// 256f:c62e..c652.
bool isSpaceMouse(std::uint16_t vendor, std::uint16_t product) noexcept;

/// Takes one report, with its number in front. Older devices report translation (1) and rotation
/// (2) in 7 bytes each, newer ones both (1) in 13; buttons (3) come in 3, 5 or 7 bytes.
/// @return false, with `state` untouched, for any other number or length.
bool parseSpaceMouseReport(const std::uint8_t* bytes, std::size_t count,
                           SpaceMouseState& state) noexcept;

/// Always finite, within the scale's reach per axis.
ToolPose spaceMousePose(const SpaceMouseState& state, const AxisScale& scale) noexcept;

}  // namespace palpate
