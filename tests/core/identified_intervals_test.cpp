// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <algorithm>

#include "support/interval_coverage.h"
#include "support/registered_rig.h"

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

/// How many of some sets have the truth within both intervals' bounds, a parameter; and those that
/// are called too small.
struct Held {
  int modulus = 0, poisson = 0, called = 0;
};

Held heldOf(int sets, bool isCarried) {
  constexpr double kPlaceNoise = 5e-4;  // on a body of 10 cm
  WavyEllipsoid body;
  Held held;
  for (int set = 1; set <= sets; ++set) {
    const MaterialIdentification result =
        body.identified(body.measured(set, kPlaceNoise), isCarried);
    const IdentifiedParameter &e = result.parameters[0], &nu = result.parameters[1];
    held.modulus += e.lower <= body.kYoung && body.kYoung <= e.upper;
    held.poisson += nu.lower <= body.kPoisson && body.kPoisson <= nu.upper;
    for (const std::string& warning : result.warnings)
      held.called += warning.find("neighbouring markers") != std::string::npos;
  }
  return held;
}

// Of 200 sets they hold it in 90 to 99 % (README); so few tell whether they do at all.
TEST(IdentifiedIntervals, HoldTheTruthOfARegisteredTable) {
  constexpr int kRegistered = 40;
  const Held held = heldOf(kRegistered, true);
  for (int count : {held.modulus, held.poisson}) EXPECT_GE(count, 0.87 * kRegistered);
  EXPECT_LE(held.called, 1);
  EXPECT_LE(heldOf(20, false).modulus, 0.7 * 20) << "else there would be nothing to carry";
}

INSTANTIATE_TEST_SUITE_P(NearTheBoundAndFar, IdentifiedIntervals,
                         testing::Combine(testing::Values(0.3, 0.4, 0.48), testing::Bool()));

}  // namespace
}  // namespace palpate::test
