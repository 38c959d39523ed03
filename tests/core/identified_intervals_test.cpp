// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(NearTheBoundAndFar, IdentifiedIntervals,
                         testing::Combine(testing::Values(0.3, 0.4, 0.48), testing::Bool()));

}  // namespace
}  // namespace palpate::test
