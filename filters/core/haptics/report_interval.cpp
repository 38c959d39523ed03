// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/report_interval.h"

#include <algorithm>

namespace palpate {

// Gaps are sums of periods: a millionth of one more or less is rounding.
static constexpr double kRounding = 1e-6;

ReportInterval::ReportInterval(double stated, double period, double longest) noexcept
    : stated_(stated), period_(period), longest_(std::max(longest, period)) {}

void ReportInterval::add(double gap) noexcept {
  gaps_[count_ % kRemembered] = gap;
  ++count_;
}

double ReportInterval::seconds() const noexcept {
  if (count_ == 0) return longest_;
  double interval = stated_;
  for (long i = 0; i < std::min<long>(count_, kRemembered); ++i)
    interval = std::max(interval, gaps_[i]);
  return std::clamp(interval, period_, longest_);
}

bool ReportInterval::isTooLong() const noexcept {
  const long known = std::min<long>(count_, kRemembered);
  return known > 0 &&
         *std::min_element(gaps_.begin(), gaps_.begin() + known) > longest_ + kRounding * period_;
}

}  // namespace palpate
