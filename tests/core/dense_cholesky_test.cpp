// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/dense_cholesky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Core>
#include <limits>
#include <random>

namespace palpate::test {
namespace {

/// Eigenvalues between about 1 and 4, whatever the size.
Eigen::MatrixXd definiteMatrix(int size) {
  std::mt19937 random(size);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd part(size, size);
  for (double& entry : part.reshaped()) entry = normal(random);
  part /= 2 * std::sqrt(double(size));
  return Eigen::MatrixXd::Identity(size, size) + part * part.transpose();
}

TEST(DenseCholesky, FactorsAndInvertsForSizesAroundItsBlocks) {
  for (int size : {1, 2, 3, 16, 255, 256, 257, 511, 512, 513, 700}) {
    const Eigen::MatrixXd matrix = definiteMatrix(size);
    Eigen::MatrixXd factor = matrix;
    ASSERT_EQ(factorCholesky(factor.data(), size, Progress()), 0);
    EXPECT_EQ(Eigen::MatrixXd(factor.triangularView<Eigen::StrictlyUpper>()),
              Eigen::MatrixXd(matrix.triangularView<Eigen::StrictlyUpper>()));
    const Eigen::MatrixXd lower = factor.triangularView<Eigen::Lower>();
    const double rounding = 30 * std::numeric_limits<double>::epsilon() * std::sqrt(double(size));
    EXPECT_LE((lower * lower.transpose() - matrix).norm(), rounding * matrix.norm()) << size;
    invertCholesky(factor.data(), size, Progress());
    const Eigen::MatrixXd inverse = factor.selfadjointView<Eigen::Lower>();
    EXPECT_LE((inverse * matrix - Eigen::MatrixXd::Identity(size, size)).norm(),
              rounding * std::sqrt(double(size)))
        << size;
  }
}

TEST(DenseCholesky, TellsWhereAMatrixIsNotPositive) {
  for (int row : {0, 3, 255, 256, 500}) {
    Eigen::MatrixXd matrix = definiteMatrix(501);
    matrix(row, row) = -1;
    EXPECT_EQ(factorCholesky(matrix.data(), 501, Progress()), row + 1);
  }
}

TEST(DenseCholesky, ReportsAndCanBeAborted) {
  double last = 0;
  int reports = 0;
  const Progress counting([&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return ++reports > 0;
  });
  Eigen::MatrixXd matrix = definiteMatrix(600);
  factorCholesky(matrix.data(), 600, counting);
  EXPECT_EQ(reports, 3);
  EXPECT_EQ(last, 1);
  const Progress aborting([](double, const char*) { return false; });
  EXPECT_THROW(invertCholesky(matrix.data(), 600, aborting), Aborted);
}

}  // namespace
}  // namespace palpate::test
