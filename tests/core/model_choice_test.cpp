// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/model_choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::test {
namespace {

/// Four probes of three markers each, all displacements of 1 m.
Measurements table() {
  Measurements m;
  for (int p = 0; p < 4; ++p) {
    m.probes.emplace_back();
    for (int i = 0; i < 3; ++i) {
      MeasuredDisplacement u;
      u.probe = p;
      u.displacement = {0, 0, 1};
      m.displacements.push_back(u);
    }
  }
  return m;
}

/// Off by so much at all markers of each probe.
TriedModel offBy(const Eigen::Vector4d& errors) {
  TriedModel model;
  model.heldOut.setZero(3, 12);
  for (int i = 0; i < 12; ++i) model.heldOut(0, i) = errors[i / 3];
  return model;
}

TEST(ModelChoice, ErrorsAreOverTheDisplacements) {
  const ModelChoice choice = chooseModel(table(), {offBy({0.1, 0.1, 0.1, 0.1})});
  EXPECT_EQ(choice.taken, 0);
  EXPECT_NEAR(choice.errors[0], 0.1, 1e-15);
}

TEST(ModelChoice, TakesWhatIsBetterUnderAllProbes) {
  EXPECT_EQ(chooseModel(table(), {offBy({0.2, 0.2, 0.3, 0.2}), offBy({0.1, 0.1, 0.1, 0.1})}).taken,
            1);
}

// A tenth better in all, but by one probe alone: within the standard error of the difference.
TEST(ModelChoice, TakesTheSimplerWhereOneProbeMakesTheDifference) {
  EXPECT_EQ(chooseModel(table(), {offBy({0.1, 0.1, 0.1, 0.2}), offBy({0.1, 0.1, 0.1, 0.1})}).taken,
            0);
}

TEST(ModelChoice, WhatOneKindAloneCallsAnOutlierCountsAgainstIt) {
  TriedModel proud = offBy({0.05, 0.05, 0.05, 0.8});
  proud.outliers = {9, 10, 11};
  const ModelChoice choice = chooseModel(table(), {proud, offBy({0.1, 0.1, 0.1, 0.1})});
  EXPECT_GT(choice.errors[0], 0.4);
  TriedModel other = offBy({0.1, 0.1, 0.1, 0.1});
  other.outliers = {9, 10, 11};
  const ModelChoice agreed = chooseModel(table(), {proud, other});
  EXPECT_NEAR(agreed.errors[0], 0.05, 1e-15);
  EXPECT_EQ(agreed.taken, 0);
}

TEST(ModelChoice, KindsWithoutPredictionsAreNotTaken) {
  const ModelChoice choice = chooseModel(table(), {{}, offBy({0.1, 0.1, 0.1, 0.1})});
  EXPECT_EQ(choice.taken, 1);
  EXPECT_TRUE(std::isnan(choice.errors[0]));
  EXPECT_EQ(chooseModel(table(), {{}, {}}).taken, -1);
}

}  // namespace
}  // namespace palpate::test
