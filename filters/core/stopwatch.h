// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <chrono>
#include <string>

#include "diagnostics.h"

namespace palpate {

/// Wall-clock time since it was made or last asked.
class Stopwatch {
 public:
  double seconds() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

inline void addSeconds(Diagnostics& diagnostics, const std::string& stage, double seconds) {
  for (auto& entry : diagnostics.seconds)
    if (entry.first == stage) {
      entry.second += seconds;
      return;
    }
  diagnostics.seconds.emplace_back(stage, seconds);
}

}  // namespace palpate
