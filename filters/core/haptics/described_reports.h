// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>

#include "contact/wrench.h"
#include "haptics/hid_description.h"

/// Reports of boards that a HidDescription describes.
namespace palpate {

/// Takes a report as it comes.
/// @param sequence  set if the board numbers its states.
/// @return false, with the pose untouched, unless length and number are right, all numbers are
///         finite and the orientation's length is within 0.5..1.5; it is made a unit quaternion.
bool parseDescribedInput(const HidDescription::Input& input, const std::uint8_t* bytes,
                         std::size_t count, ToolPose& pose, std::uint32_t& sequence) noexcept;

/// Numbers beyond a field's range end at it; what is no number becomes a count for zero.
/// @param bytes  describedOutputBytes() of them, overwritten; as hidapi wants them, the report's
///               number first, 0 if it has none.
void encodeDescribedOutput(const HidDescription::Output& output, const Wrench& wrench,
                           std::uint32_t sequence, std::uint8_t* bytes) noexcept;
std::size_t describedOutputBytes(const HidDescription::Output& output) noexcept;

}  // namespace palpate
