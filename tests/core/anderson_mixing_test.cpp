// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/anderson_mixing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>

namespace palpate::test {
namespace {

Eigen::MatrixXd someMatrix(int size) {
  Eigen::MatrixXd matrix(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) matrix(i, j) = std::sin(1 + 3.7 * i + 1.3 * j * j);
  return matrix;
}

TEST(AndersonMixing, EndsAnAffineIterationAfterOneStepMoreThanItsSize) {
  for (const double factor : {0.3, 0.9, 3.0}) {  // the last would diverge
    const int size = 5;
    const Eigen::MatrixXd matrix = factor * someMatrix(size) / someMatrix(size).operatorNorm();
    const Eigen::VectorXd shift = Eigen::VectorXd::LinSpaced(size, 1, 2);
    const Eigen::VectorXd exact =
        (Eigen::MatrixXd::Identity(size, size) - matrix).partialPivLu().solve(shift);
    AndersonMixing mixing(size, size);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
    for (int step = 0; step <= size; ++step) mixing.next(x, matrix * x + shift);
    EXPECT_LE((x - exact).norm(), 1e-9 * exact.norm()) << factor;
  }
}

TEST(AndersonMixing, KeepsToItsDepthAndForgets) {
  const int size = 12;
  const Eigen::MatrixXd matrix = Eigen::VectorXd::LinSpaced(size, 0.1, 0.99).asDiagonal();
  const Eigen::VectorXd shift = Eigen::VectorXd::LinSpaced(size, 1, 2);
  AndersonMixing mixing(size, 3);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size), plain = x;
  for (int step = 0; step < 30; ++step) {
    mixing.next(x, matrix * x + shift);
    plain = matrix * plain + shift;
  }
  EXPECT_LT((matrix * x + shift - x).norm(), 0.1 * (matrix * plain + shift - plain).norm());
  mixing.restart();
  const Eigen::VectorXd value = matrix * x + shift;
  mixing.next(x, value);
  EXPECT_EQ(x, value) << "the first step is the iteration's own";
}

TEST(AndersonMixing, TakesStepsThatTellNothingNew) {
  AndersonMixing mixing(2, 2);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  for (int step = 0; step < 6; ++step) mixing.next(x, Eigen::Vector2d(1, 2));
  EXPECT_EQ(x, Eigen::Vector2d(1, 2));
}

}  // namespace
}  // namespace palpate::test
