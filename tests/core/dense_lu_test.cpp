// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/dense_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "linear_algebra/lapack.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Random entries in [-1, 1]: rows are interchanged at nearly every pivot.
template <class Scalar>
Matrix<Scalar> randomMatrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Matrix<Scalar> matrix(rows, columns);
  for (Scalar& entry : matrix.reshaped()) entry = static_cast<Scalar>(uniform(random));
  return matrix;
}

template <class Scalar>
class DenseLuOf : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(DenseLuOf, Scalars);

TYPED_TEST(DenseLuOf, SolutionsSatisfyTheSystemForSizesAroundItsBlocks) {
  for (int size : {1, 2, 3, 7, 16, 65, 128, 255, 256, 257, 300, 511, 512, 513, 700})
    for (int gap : {0, 5}) {
      const int columns = size % 4 + 1;
      const Matrix<TypeParam> a = randomMatrix<TypeParam>(size, size, size);
      const Matrix<TypeParam> b = randomMatrix<TypeParam>(size, columns, size + 1);
      Matrix<TypeParam> factors = randomMatrix<TypeParam>(size + gap, size, 1);
      Matrix<TypeParam> x = randomMatrix<TypeParam>(size + gap, columns, 2);
      factors.topRows(size) = a;
      x.topRows(size) = b;
      const Matrix<TypeParam> below = factors.bottomRows(gap), belowX = x.bottomRows(gap);
      const DenseLu<TypeParam> lu(factors.data(), size, size + gap, Progress());
      lu.solve(x.data(), columns, size + gap);
      // Backward error of partial pivoting, whatever the condition.
      const double residual = (a.template cast<double>() * x.topRows(size).template cast<double>() -
                               b.template cast<double>())
                                  .norm();
      EXPECT_LE(residual,
                30 * std::numeric_limits<TypeParam>::epsilon() * a.norm() * x.topRows(size).norm())
          << size;
      EXPECT_EQ(factors.bottomRows(gap), below);
      EXPECT_EQ(x.bottomRows(gap), belowX);
    }
}

TEST(DenseLu, SolutionsAndFactorsAreThoseOfEigen) {
  for (int size : {1, 40, 256, 400, 600}) {
    const Eigen::MatrixXd a = randomMatrix<double>(size, size, size);
    const Eigen::MatrixXd b = randomMatrix<double>(size, 3, size + 1);
    Eigen::MatrixXd factors = a, x = b;
    const DenseLu<double> lu(factors.data(), size, size, Progress());
    lu.solve(x.data(), 3, size);
    const Eigen::PartialPivLU<Eigen::MatrixXd> reference(a);
    // The condition of random matrices of this size is about 1e4.
    EXPECT_LE((x - reference.solve(b)).norm(), 1e-9 * x.norm());
    EXPECT_LE((factors - reference.matrixLU()).norm(), 1e-9 * factors.norm());
  }
}

TYPED_TEST(DenseLuOf, ConditionEstimateIsAtMostTheConditionAndNotFarBelowIt) {
  for (int size : {1, 5, 60, 300}) {
    Matrix<TypeParam> a = randomMatrix<TypeParam>(size, size, size);
    a.row(0) *= TypeParam(0.01);
    const Eigen::MatrixXd exact = a.template cast<double>();
    const double condition = exact.cwiseAbs().colwise().sum().maxCoeff() *
                             exact.inverse().cwiseAbs().colwise().sum().maxCoeff();
    const DenseLu<TypeParam> lu(a.data(), size, size, Progress());
    // LAPACK's estimator is a lower bound, hardly ever below a third; float's is rounded.
    EXPECT_LE(lu.conditionEstimate(), condition * 1.01);
    EXPECT_GE(lu.conditionEstimate(), condition / 3);
  }
}

TYPED_TEST(DenseLuOf, SingularMatricesAreRefusedNamingThePivot) {
  for (int zero : {0, 3, 299}) {
    // Triangular with a zero on the diagonal: elimination leaves it as it is.
    Matrix<TypeParam> a =
        randomMatrix<TypeParam>(300, 300, 5).template triangularView<Eigen::Upper>();
    a.diagonal().setOnes();
    a(zero, zero) = 0;
    EXPECT_TRUE(isRefused<std::runtime_error>(
        [&] { DenseLu<TypeParam>(a.data(), 300, 300, Progress()); },
        "the system matrix is singular: pivot " + std::to_string(zero) + " is zero"));
  }
}

TEST(DenseLu, OverflowingConditionIsInfinite) {
  Eigen::MatrixXd a = Eigen::Vector2d(1, 1e-320).asDiagonal();
  const DenseLu<double> lu(a.data(), 2, 2, Progress());
  EXPECT_EQ(lu.conditionEstimate(), std::numeric_limits<double>::infinity());
}

TEST(DenseLu, ProgressGrowsToOneAndCanAbort) {
  std::vector<double> fractions;
  const auto record = [&](double fraction, const char* stage) {
    EXPECT_STREQ(stage, "factor");
    fractions.push_back(fraction);
    return true;
  };
  Eigen::MatrixXd a = randomMatrix<double>(700, 700, 1);
  DenseLu<double>(a.data(), 700, 700, Progress(record));
  ASSERT_GE(fractions.size(), 3u);
  EXPECT_GT(fractions.front(), 0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);

  int calls = 0;
  const auto stopAtSecond = [&](double, const char*) { return ++calls < 2; };
  EXPECT_TRUE(isRefused<Aborted>(
      [&] { DenseLu<double>(a.data(), 700, 700, Progress(stopAtSecond)); }, "aborted on request"));
  EXPECT_EQ(calls, 2);
}

TEST(BlasThreads, AreSetWhileItLivesAndRestoredAfterwards) {
  const int before = lapack::blasThreads();
  {
    const BlasThreads two(2);
    const int outer = lapack::blasThreads();
    {
      const BlasThreads one(1);
      EXPECT_EQ(lapack::blasThreads(), 1);
    }
    EXPECT_EQ(lapack::blasThreads(), outer);
  }
  EXPECT_EQ(lapack::blasThreads(), before);
}

}  // namespace
}  // namespace palpate::test
