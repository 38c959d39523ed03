// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <vector>

#include "haptics/palpate_report.h"

namespace palpate::test {

/// A state with a number, which also says where the device is.
inline std::vector<std::uint8_t> stateReport(std::uint32_t sequence) {
  PalpateState state;
  state.flags = PalpateState::kCalibrated;
  state.sequence = sequence;
  state.pose.position.x() = 1e-6 * sequence;
  const PalpateReport report = encodePalpateState(state);
  return {report.begin(), report.end()};
}

inline Wrench push(double newtons) {
  return {Eigen::Vector3d(newtons, 0, 0), Eigen::Vector3d::Zero()};
}

}  // namespace palpate::test
