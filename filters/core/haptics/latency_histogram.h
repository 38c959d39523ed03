// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace palpate {

/// Times of a loop that runs for hours, in fixed memory: 32 buckets per octave from 1 ns to 2^40 ns
/// (18 minutes; longer ones count as that), so that a quantile is off by at most 1/64 of itself, or
/// by half a nanosecond. One thread records; any thread reads meanwhile, without locks.
class LatencyHistogram {
 public:
  static constexpr double kRelativeError = 1.0 / 64;

  LatencyHistogram() = default;
  LatencyHistogram(const LatencyHistogram&) = delete;
  LatencyHistogram& operator=(const LatencyHistogram&) = delete;

  /// Neither allocates nor waits.
  /// @param nanoseconds  what is negative counts as 0.
  void record(std::int64_t nanoseconds) noexcept;

  /// Forgets everything. For the recording thread only.
  void clear() noexcept;

  std::int64_t count() const noexcept { return count_.load(std::memory_order_relaxed); }

  /// Seconds that a share of the times does not exceed; 0 without any.
  /// @param share  0 to 1, e.g. 0.5 for the median.
  double quantile(double share) const noexcept;

  /// Seconds, exact.
  double largest() const noexcept { return 1e-9 * largest_.load(std::memory_order_relaxed); }

 private:
  static constexpr int kLogPerOctave = 5, kPerOctave = 1 << kLogPerOctave, kLogLargest = 40;
  static constexpr int kBuckets = (kLogLargest - kLogPerOctave + 1) * kPerOctave;

  static int bucketOf(std::int64_t nanoseconds) noexcept;
  static double middleOf(int bucket) noexcept;

  std::array<std::atomic<std::int64_t>, kBuckets> buckets_{};
  std::atomic<std::int64_t> count_{0}, largest_{0};
};

/// A table with a line for each histogram: name, count, p50, p99, p99.9 and largest in
/// microseconds.
std::string latencyTable(
    const std::vector<std::pair<std::string, const LatencyHistogram*>>& histograms);

}  // namespace palpate
