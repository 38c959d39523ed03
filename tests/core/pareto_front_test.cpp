// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/pareto_front.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace palpate::test {
namespace {

using Flags = std::vector<bool>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(ParetoFront, HoldsWhatNothingBeats) {
  //                             front, beaten by 3, front, front, slower than 2
  EXPECT_EQ(paretoFront({1, 2.5, 4, 2, 5}, {9, 6, 1, 5, 1}),
            (Flags{true, false, true, true, false}));
}

TEST(ParetoFront, OfOneWayIsIt) {
  EXPECT_EQ(paretoFront({3}, {2}), Flags{true});
  EXPECT_EQ(paretoFront({}, {}), Flags{});
}

TEST(ParetoFront, OfWaysThatAllTradeIsAllOfThem) {
  EXPECT_EQ(paretoFront({1, 2, 3, 4}, {4, 3, 2, 1}), Flags(4, true));
}

TEST(ParetoFront, TakesEqualWaysTogether) {
  EXPECT_EQ(paretoFront({1, 1, 2, 2}, {1, 1, 1, 1}), (Flags{true, true, false, false}));
}

TEST(ParetoFront, DoesNotDependOnTheOrder) {
  const std::vector<double> costs{5, 1, 3, 2, 4}, errors{1, 6, 2, 7, 2};
  const Flags flags = paretoFront(costs, errors);
  const Flags reversed =
      paretoFront({costs.rbegin(), costs.rend()}, {errors.rbegin(), errors.rend()});
  EXPECT_EQ(Flags(reversed.rbegin(), reversed.rend()), flags);
}

TEST(ParetoFront, LeavesOutWhatHasNoNumber) {
  EXPECT_EQ(paretoFront({1, 2, kNaN}, {kNaN, 3, 1}), (Flags{false, true, false}));
}

TEST(ParetoFront, RefusesACostWithoutError) {
  EXPECT_THROW(paretoFront({1, 2}, {1}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
