// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/force_safety.h"
#include "haptics/latency_histogram.h"
#include "haptics/touch_model.h"

namespace palpate {

/// What one hand does and feels.
struct ToolReport {
  ToolPose pose;    ///< the last valid one, in the device's frame
  Wrench rendered;  ///< on the hand, in the device's frame
  SafetyReport safety;
  double energy = 0;  ///< J, PassivityObserver::energy of the force rendered
};

/// A state of the loop after one of its ticks.
struct ServoSnapshot {
  ContactSnapshot contact;
  std::vector<ToolReport> tools;
  bool paused = false;
};

/// Counts and times of a loop; any thread reads them at any time.
struct ServoStatistics {
  std::atomic<std::int64_t> ticks{0};
  std::atomic<std::int64_t> missedTicks{0};  ///< left out because their time had passed
  std::atomic<std::int64_t> overruns{0};     ///< ticks that ended after the next should have begun
  std::atomic<std::int64_t> overBudget{0};   ///< ticks that computed longer than their budget
  std::atomic<std::int64_t> truncated{
      0};  ///< ticks whose contacts were more than there is room for
  std::atomic<bool> realTimeGranted{false};  ///< whether the system gave what was asked for
  LatencyHistogram compute;                  ///< computing time of a tick
  LatencyHistogram lateness;                 ///< from a tick's deadline to its begin

  /// Both histograms, printable.
  std::string table() const;
};

}  // namespace palpate
