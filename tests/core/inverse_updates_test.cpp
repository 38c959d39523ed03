// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/inverse_updates.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>

namespace palpate::test {
namespace {

/// A random block of the given shape with the rest of its memory zero, as the updates expect.
struct Padded {
  Padded(int rows, int columns, int stride) : all(Eigen::MatrixXd::Zero(stride, columns)) {
    all.topRows(rows).setRandom();
  }
  double* data() { return all.data(); }
  Eigen::MatrixXd all;
};

class InverseUpdates : public testing::TestWithParam<int> {
 protected:
  /// Runs a check for every number of rows that fits, with and without room to spare.
  template <class Check>
  void forSizes(const Check& check) {
    for (int size = 0; size <= 41; ++size)
      for (int spare : {0, 3 * kInversePadding})
        check(size, (size + kInversePadding - 1) / kInversePadding * kInversePadding + spare);
  }
  // Sums of up to 41 products of numbers below one.
  static constexpr double kTolerance = 41 * std::numeric_limits<double>::epsilon();
};

TEST_P(InverseUpdates, ProductsOnBothSidesAreThoseOfThePlainMatrix) {
  forSizes([&](int size, int stride) {
    const int count = GetParam();
    Padded inverse(size, size, stride), b(size, count, stride), c(size, count, stride);
    Eigen::MatrixXd x = Eigen::MatrixXd::Constant(stride, count, 7), y = x;
    multiplyBothSides(inverse.data(), size, stride, b.data(), c.data(), count, x.data(), y.data());
    const Eigen::MatrixXd matrix = inverse.all.topRows(size);
    const Eigen::MatrixXd expectedX = matrix * b.all.topRows(size);
    const Eigen::MatrixXd expectedY = matrix.transpose() * c.all.topRows(size);
    EXPECT_LE((x.topRows(size) - expectedX).lpNorm<Eigen::Infinity>(), kTolerance) << size;
    EXPECT_LE((y.topRows(size) - expectedY).lpNorm<Eigen::Infinity>(), kTolerance) << size;
    if (count < 3) return;
    Eigen::MatrixXd alone = Eigen::MatrixXd::Constant(stride, count, 7);
    multiplyTransposed(inverse.data(), size, stride, c.data(), alone.data());
    EXPECT_EQ(alone, y) << size;
  });
}

TEST_P(InverseUpdates, OuterProductsAreAddedAndThePaddingStaysZero) {
  forSizes([&](int size, int stride) {
    const int count = GetParam();
    Padded inverse(size, size, stride), x(size, count, stride), y(size, count, stride);
    Eigen::MatrixXd expected = inverse.all;
    expected.topRows(size) += x.all.topRows(size) * y.all.topRows(size).transpose();
    addOuterProduct(inverse.data(), size, stride, x.data(), y.data(), count);
    EXPECT_LE((inverse.all - expected).lpNorm<Eigen::Infinity>(), kTolerance) << size;
    EXPECT_EQ(inverse.all.bottomRows(stride - size), expected.bottomRows(stride - size));
  });
}

INSTANTIATE_TEST_SUITE_P(Columns, InverseUpdates, testing::Values(1, 2, 3));

}  // namespace
}  // namespace palpate::test
