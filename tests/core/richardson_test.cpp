// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/richardson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace palpate::test {
namespace {

double norm(const Eigen::VectorXd& difference) {
  return difference.norm();
}

const Eigen::VectorXd kLimit = Eigen::Vector3d(3, -1, 0.5);
const Eigen::VectorXd kError = Eigen::Vector3d(0.2, 0.1, -0.4);

/// u + c h^p for h = 1, 1/2, ...
std::vector<Eigen::VectorXd> powerLaw(double order, int count) {
  std::vector<Eigen::VectorXd> answers;
  for (int level = 0; level < count; ++level)
    answers.push_back(kLimit + kError * std::exp2(-order * level));
  return answers;
}

TEST(Richardson, OfAPowerLawFindsOrderAndLimit) {
  for (double order : {0.6, 1.0, 1.7, 2.0, 3.5}) {
    const RichardsonExtrapolation found = extrapolate(powerLaw(order, 3), norm);
    EXPECT_TRUE(found.isObserved);
    EXPECT_NEAR(found.order, order, 1e-12);  // rounding, of differences 0.03 of the answers
    EXPECT_LT((found.values - kLimit).norm(), 1e-12);
    // Both pairs lead to the same limit: a quarter of the last error is left.
    EXPECT_NEAR(found.uncertainty, 0.25 * kError.norm() * std::exp2(-2 * order), 1e-12);
  }
}

TEST(Richardson, OfTwoAnswersGoesByTheOrderThatIsStated) {
  for (double order : {1.0, 2.0}) {
    const RichardsonExtrapolation found = extrapolate(powerLaw(order, 2), norm, order);
    EXPECT_FALSE(found.isObserved);
    EXPECT_EQ(found.order, order);
    EXPECT_LT((found.values - kLimit).norm(), 1e-14);
    EXPECT_NEAR(found.uncertainty, kError.norm() * std::exp2(-order), 1e-14);
  }
}

TEST(Richardson, UsesTheFinestThree) {
  std::vector<Eigen::VectorXd> answers = powerLaw(2, 4);
  answers.front().setConstant(100);
  EXPECT_LT((extrapolate(answers, norm).values - kLimit).norm(), 1e-12);
}

TEST(Richardson, OfAnswersThatDoNotSettleClaimsNoMoreThanTheirLastDifference) {
  for (double order : {-1.0, 0.1, 6.0}) {  // diverging, hardly moving, suspiciously fast
    const std::vector<Eigen::VectorXd> answers = powerLaw(order, 3);
    const RichardsonExtrapolation found = extrapolate(answers, norm);
    EXPECT_FALSE(found.isObserved);
    EXPECT_EQ(found.order, 1);
    EXPECT_NEAR(found.uncertainty, (answers[2] - answers[1]).norm(), 1e-14);
  }
}

/// A second power in the error is what an extrapolation with one does not see.
TEST(Richardson, IsUncertainByAtLeastWhatAnotherTermOfTheErrorLeaves) {
  std::vector<Eigen::VectorXd> answers = powerLaw(1, 3);
  for (int level = 0; level < 3; ++level)
    answers[level] += Eigen::Vector3d(-0.1, 0.05, 0.1) * std::exp2(-3.0 * level);
  const RichardsonExtrapolation found = extrapolate(answers, norm);
  EXPECT_TRUE(found.isObserved);
  EXPECT_GE(found.uncertainty, (found.values - kLimit).norm());
}

TEST(Richardson, OfEqualAnswersIsThemAndCertain) {
  const RichardsonExtrapolation found = extrapolate({kLimit, kLimit, kLimit}, norm);
  EXPECT_EQ(found.values, kLimit);
  EXPECT_EQ(found.uncertainty, 0);
}

TEST(Richardson, RefusesAnswersOfNoSequence) {
  EXPECT_THROW(extrapolate({kLimit}, norm), std::invalid_argument);
  EXPECT_THROW(extrapolate({kLimit, Eigen::Vector2d(1, 2)}, norm), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
