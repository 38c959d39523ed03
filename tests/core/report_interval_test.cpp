// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/report_interval.h"

#include <gtest/gtest.h>

namespace palpate::test {
namespace {

constexpr double kPeriod = 1e-3, kLongest = 0.02;

TEST(ReportIntervals, AreTheLongestUntilADeviceHasReportedTwice) {
  for (double stated : {0.0, 4e-3}) {
    ReportInterval interval(stated, kPeriod, kLongest);
    EXPECT_EQ(interval.seconds(), kLongest);
    interval.add(3e-3);
    EXPECT_EQ(interval.seconds(), stated > 0 ? stated : 3e-3);
  }
}

TEST(ReportIntervals, AreNeverShorterThanATickNorLongerThanTheLongest) {
  ReportInterval interval(1e-4, kPeriod, kLongest);
  interval.add(1e-4);
  EXPECT_EQ(interval.seconds(), kPeriod);
  interval.add(1);
  EXPECT_EQ(interval.seconds(), kLongest);
  ReportInterval slow(1, kPeriod, kLongest);
  slow.add(kPeriod);
  EXPECT_EQ(slow.seconds(), kLongest);
  EXPECT_EQ(ReportInterval(0, kPeriod, kPeriod / 2).seconds(), kPeriod);
}

TEST(ReportIntervals, AreTheLongestOfTheLastEightAndNoLessThanStated) {
  for (double stated : {0.0, 2e-3}) {
    ReportInterval interval(stated, kPeriod, kLongest);
    interval.add(5e-3);
    for (int i = 0; i < 7; ++i) {
      interval.add(1e-3);
      EXPECT_EQ(interval.seconds(), 5e-3);
    }
    interval.add(1e-3);
    EXPECT_EQ(interval.seconds(), stated > 0 ? stated : 1e-3);
  }
}

TEST(ReportIntervals, AreTooLongWhenAllOfThemAre) {
  ReportInterval interval(0, kPeriod, kLongest);
  EXPECT_FALSE(interval.isTooLong());
  for (int i = 0; i < 10; ++i) {
    interval.add(0.021);
    EXPECT_TRUE(interval.isTooLong());
  }
  interval.add(kLongest);
  EXPECT_FALSE(interval.isTooLong());
}

TEST(ReportIntervals, AreForgottenWhenADeviceWasAway) {
  ReportInterval interval(0, kPeriod, kLongest);
  interval.add(1e-3);
  EXPECT_EQ(interval.seconds(), 1e-3);
  interval.restart();
  EXPECT_EQ(interval.seconds(), kLongest);
  EXPECT_FALSE(interval.isTooLong());
}

}  // namespace
}  // namespace palpate::test
