// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/triangle_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::bem {
namespace {

/// Mean of a^i b^j c^k over a triangle, a, b, c barycentric: 2 i! j! k! / (i + j + k + 2)!.
double exactMean(int i, int j, int k) {
  return 2 * std::tgamma(i + 1) * std::tgamma(j + 1) * std::tgamma(k + 1) /
         std::tgamma(i + j + k + 3);
}

double ruleMean(const TriangleRule& rule, int i, int j, int k) {
  double sum = 0;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    sum += rule.weights[q] * std::pow(rule.barycentric(0, q), i) *
           std::pow(rule.barycentric(1, q), j) * std::pow(rule.barycentric(2, q), k);
  return sum;
}

class TriangleRuleOf : public testing::TestWithParam<int> {};

TEST_P(TriangleRuleOf, IntegratesPolynomialsOfItsDegreeExactlyAndNoHigherOnes) {
  const TriangleRule rule = triangleRule(GetParam());
  double worstBeyond = 0;
  for (int degree = 0; degree <= rule.degree + 1; ++degree)
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        const double error = ruleMean(rule, i, j, degree - i - j) - exactMean(i, j, degree - i - j);
        if (degree <= rule.degree)
          EXPECT_NEAR(error, 0, 1e-14) << i << j << degree;  // the tables have fifteen digits
        else
          worstBeyond = std::max(worstBeyond, std::abs(error));
      }
  EXPECT_GT(worstBeyond, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Points, TriangleRuleOf, testing::Values(3, 7, 16));

TEST(TriangleRule, OfAnUnknownSizeIsRefused) {
  EXPECT_THROW(triangleRule(5), std::invalid_argument);
}

TEST(PanelRules, ReachNearerAsTheToleranceIsLoosened) {
  PanelRule near[2], far[2];
  choosePanelRules(1e-4, near[0], far[0]);
  choosePanelRules(1e-8, near[1], far[1]);
  EXPECT_LT(near[0].smallestDistance, near[1].smallestDistance);
  EXPECT_LT(far[0].smallestDistance, far[1].smallestDistance);
  EXPECT_LT(near[0].smallestDistance, far[0].smallestDistance);
}

TEST(PanelRules, AreTheTabulatedRules) {
  PanelRule near, far;
  choosePanelRules(1e-6, near, far);
  const TriangleRule seven = triangleRule(7), three = triangleRule(3);
  EXPECT_NEAR(near.centroidWeight + 3 * (near.weight[0] + near.weight[1]), 1, 1e-15);
  EXPECT_NEAR(near.near[0], seven.barycentric.col(1).maxCoeff(), 1e-15);
  EXPECT_NEAR(far.weight[0], three.weights[0], 1e-16);
  EXPECT_NEAR(far.near[0], three.barycentric.col(0).maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace palpate::bem
