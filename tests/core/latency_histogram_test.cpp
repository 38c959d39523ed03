// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/latency_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "support/allocation_count.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

TEST(LatencyHistogram, WithoutTimesEverythingIsZero) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.count(), 0);
  EXPECT_EQ(histogram.quantile(0.5), 0);
  EXPECT_EQ(histogram.largest(), 0);
}

TEST(LatencyHistogram, EveryTimeFromNanosecondsToMinutesIsKeptToItsStatedError) {
  for (double time = 1; time < 1e12; time *= 1.01) {
    LatencyHistogram histogram;
    const auto nanoseconds = static_cast<std::int64_t>(time);
    histogram.record(nanoseconds);
    const double error = std::max(0.5, LatencyHistogram::kRelativeError * nanoseconds);
    EXPECT_NEAR(1e9 * histogram.quantile(0.5), nanoseconds, error * (1 + 1e-12));
    EXPECT_DOUBLE_EQ(1e9 * histogram.largest(), nanoseconds);
  }
}

TEST(LatencyHistogram, QuantilesAreThoseOfTheSortedTimes) {
  std::mt19937 random(3);
  std::lognormal_distribution<double> distribution(std::log(5e4), 1);
  LatencyHistogram histogram;
  std::vector<std::int64_t> times(20000);
  for (auto& time : times) histogram.record(time = static_cast<std::int64_t>(distribution(random)));
  std::sort(times.begin(), times.end());
  for (double share : {0.01, 0.5, 0.9, 0.99, 0.999}) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * times.size())) - 1;
    const double exact = static_cast<double>(times[rank]);
    EXPECT_NEAR(1e9 * histogram.quantile(share), exact, LatencyHistogram::kRelativeError * exact);
  }
  EXPECT_DOUBLE_EQ(1e9 * histogram.largest(), times.back());
  EXPECT_LE(histogram.quantile(1), histogram.largest());
  EXPECT_EQ(histogram.count(), 20000);
}

TEST(LatencyHistogram, TimesOutOfRangeCountAsTheNearestInIt) {
  LatencyHistogram histogram;
  histogram.record(-5);
  EXPECT_EQ(histogram.quantile(1), 0);
  histogram.record(INT64_MAX);
  EXPECT_NEAR(histogram.quantile(1), 1099.5, 1099.5 * LatencyHistogram::kRelativeError);
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0);
  EXPECT_EQ(histogram.quantile(1), 0);
}

TEST(LatencyHistogram, RecordingAllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  LatencyHistogram histogram;
  const long before = allocationCount();
  for (int i = 0; i < 1000; ++i) histogram.record(i * i);
  histogram.quantile(0.5);
  EXPECT_EQ(allocationCount(), before);
}

TEST(LatencyHistogram, ItIsReadWhileAnotherThreadRecords) {
  LatencyHistogram histogram;
  std::thread recorder([&] {
    for (int i = 0; i < 100000; ++i) histogram.record(1000);
  });
  while (histogram.count() < 100000) {
    if (histogram.count() > 0) {
      EXPECT_NEAR(histogram.quantile(0.5), 1e-6, 1e-6 / 64);
    }
  }
  recorder.join();
}

TEST(LatencyHistogram, ItsTableShowsEachHistogramInMicroseconds) {
  LatencyHistogram histogram;
  for (int i = 0; i < 100; ++i) histogram.record(2000);
  const std::string table = latencyTable({{"wake-up", &histogram}});
  EXPECT_TRUE(contains(table, "microseconds"));
  EXPECT_TRUE(contains(table, "p99.9"));
  EXPECT_TRUE(contains(table, "wake-up                 100        2.0        2.0"));
}

}  // namespace
}  // namespace palpate::test
