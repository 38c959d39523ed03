// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/spacemouse_reports.h"

#include <algorithm>

#include "haptics/little_endian.h"

namespace palpate {
namespace {

constexpr double kFullDeflection = 350;

void takeAxes(const std::uint8_t* bytes, int first, int count, SpaceMouseState& state) noexcept {
  for (int i = 0; i < count; ++i)
    state.axes[first + i] = readLittleEndian<std::int16_t>(bytes + 2 * i);
}

}  // namespace

bool isSpaceMouse(std::uint16_t vendor, std::uint16_t product) noexcept {
  return (vendor == 0x046d && product >= 0xc603 && product <= 0xc62b) ||
         (vendor == 0x256f && product >= 0xc62e && product <= 0xc652);
}

bool parseSpaceMouseReport(const std::uint8_t* bytes, std::size_t count,
                           SpaceMouseState& state) noexcept {
  if (count == 0) return false;
  const std::uint8_t number = bytes[0];
  if (number == 1 && count == 13) {
    takeAxes(bytes + 1, 0, 6, state);
  } else if ((number == 1 || number == 2) && count == 7) {
    takeAxes(bytes + 1, number == 1 ? 0 : 3, 3, state);
  } else if (number == 3 && (count == 3 || count == 5 || count == 7)) {
    state.buttons = 0;
    for (std::size_t i = 1; i < std::min<std::size_t>(count, 5); ++i)
      state.buttons |= std::uint32_t{bytes[i]} << (8 * (i - 1));
  } else {
    return false;
  }
  return true;
}

ToolPose spaceMousePose(const SpaceMouseState& state, const AxisScale& scale) noexcept {
  double deflection[6];
  for (int i = 0; i < 6; ++i)
    deflection[i] = std::clamp(state.axes[i] / kFullDeflection, -1.0, 1.0);
  ToolPose pose =
      deflectedPose(Eigen::Vector3d(deflection[0], deflection[1], deflection[2]),
                    Eigen::Vector3d(deflection[3], deflection[4], deflection[5]), scale);
  pose.buttons = state.buttons;
  return pose;
}

}  // namespace palpate
