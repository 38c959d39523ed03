// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/latency_histogram.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace palpate {

// Only the recording thread changes a counter: a load and a store need no locked instruction.
static void increase(std::atomic<std::int64_t>& counter) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

/// Below kPerOctave ns a bucket each, above kPerOctave of equal width from each power of two on.
int LatencyHistogram::bucketOf(std::int64_t nanoseconds) noexcept {
  if (nanoseconds < kPerOctave) return static_cast<int>(nanoseconds);
  const int octave = std::ilogb(static_cast<double>(nanoseconds)) - kLogPerOctave;
  return octave * kPerOctave + static_cast<int>(nanoseconds >> octave);
}

double LatencyHistogram::middleOf(int bucket) noexcept {
  if (bucket < kPerOctave) return bucket;
  const int octave = bucket / kPerOctave - 1;
  return std::ldexp(bucket % kPerOctave + kPerOctave + 0.5, octave);
}

void LatencyHistogram::record(std::int64_t nanoseconds) noexcept {
  const std::int64_t time =
      std::clamp<std::int64_t>(nanoseconds, 0, (std::int64_t{1} << kLogLargest) - 1);
  increase(buckets_[bucketOf(time)]);
  increase(count_);
  if (time > largest_.load(std::memory_order_relaxed))
    largest_.store(time, std::memory_order_relaxed);
}

void LatencyHistogram::clear() noexcept {
  for (auto& bucket : buckets_) bucket.store(0, std::memory_order_relaxed);
  count_.store(0, std::memory_order_relaxed);
  largest_.store(0, std::memory_order_relaxed);
}

double LatencyHistogram::quantile(double share) const noexcept {
  // The sum over the buckets rather than count_, which may be ahead of them in another thread.
  std::int64_t total = 0;
  for (const auto& bucket : buckets_) total += bucket.load(std::memory_order_relaxed);
  const double rank = std::max(1.0, std::ceil(share * static_cast<double>(total)));
  std::int64_t below = 0;
  for (int b = 0; b < kBuckets; ++b) {
    below += buckets_[b].load(std::memory_order_relaxed);
    if (static_cast<double>(below) >= rank) return std::min(1e-9 * middleOf(b), largest());
  }
  return 0;
}

std::string latencyTable(
    const std::vector<std::pair<std::string, const LatencyHistogram*>>& histograms) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << std::left << std::setw(16) << "microseconds"
       << std::right;
  for (const char* title : {"count", "p50", "p99", "p99.9", "max"}) text << std::setw(11) << title;
  text << '\n';
  for (const auto& [name, histogram] : histograms) {
    text << std::left << std::setw(16) << name << std::right << std::setw(11) << histogram->count();
    for (double share : {0.5, 0.99, 0.999})
      text << std::setw(11) << 1e6 * histogram->quantile(share);
    text << std::setw(11) << 1e6 * histogram->largest() << '\n';
  }
  return text.str();
}

}  // namespace palpate
