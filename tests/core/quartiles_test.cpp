// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/quartiles.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace palpate::test {
namespace {

TEST(Quartiles, OfFiveAreTheSecondThirdAndFourth) {
  const Quartiles found = quartilesOf({5, 1, 4, 2, 3});
  EXPECT_EQ(found.lower, 2);
  EXPECT_EQ(found.median, 3);
  EXPECT_EQ(found.upper, 4);
}

TEST(Quartiles, LieBetweenMembersInProportion) {
  const Quartiles found = quartilesOf({2, 1});
  EXPECT_EQ(found.lower, 1.25);
  EXPECT_EQ(found.median, 1.5);
  EXPECT_EQ(found.upper, 1.75);
}

TEST(Quartiles, OfOneAreIt) {
  const Quartiles found = quartilesOf({7});
  EXPECT_EQ(found.lower, 7);
  EXPECT_EQ(found.upper, 7);
}

TEST(Quartiles, AreNotThrownByOneOutlier) {
  EXPECT_EQ(quartilesOf({1, 1, 1, 1, 1000}).upper, 1);
}

TEST(Quartiles, RefuseAnEmptySample) {
  EXPECT_THROW(quartilesOf({}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
