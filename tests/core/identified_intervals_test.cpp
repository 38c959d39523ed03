// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <algorithm>

#include "support/interval_coverage.h"

namespace palpate::test {
namespace {

constexpr int kSets = 200;

class IdentifiedIntervals : public testing::TestWithParam<std::tuple<double, bool>> {};

TEST_P(IdentifiedIntervals, HoldTheTruthInNineToNineAndAHalfOfTenSets) {
  const auto [poisson, yields] = GetParam();
  BentBar bar(poisson, yields);
  int sets = kSets;
  const std::vector<int> all = coveredOf(bar, sets);
  EXPECT_GE(sets, 0.95 * kSets);
  for (int covered : all) {
    EXPECT_GE(covered, 0.90 * sets);
    EXPECT_LE(covered, 0.99 * sets);
  }
}

// One table of a thousand may.
TEST(IdentifiedIntervals, OfNoiseAloneAreNotCalledTooSmall) {
  BentBar bar(0.3, false);
  int called = 0;
  std::vector<double> ratios;
  for (int set = 1; set <= kSets; ++set) {
    const MaterialIdentification result = bar.identified(set, 0, 5);
    for (const std::string& warning : result.warnings)
      called += warning.find("neighbouring markers") != std::string::npos;
    const IdentifiedParameter& modulus = result.parameters[0];
    ratios.push_back(modulus.probewiseDeviation / modulus.deviation);
  }
  EXPECT_LE(called, 3);
  std::sort(ratios.begin(), ratios.end());
  EXPECT_NEAR(ratios[kSets / 2], 1, 0.25);  // of five probes the jackknife itself varies by half
}

INSTANTIATE_TEST_SUITE_P(NearTheBoundAndFar, IdentifiedIntervals,
                         testing::Combine(testing::Values(0.3, 0.4, 0.48), testing::Bool()));

}  // namespace
}  // namespace palpate::test
