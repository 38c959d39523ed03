// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/weighted_columns.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>

namespace palpate::test {
namespace {

template <class Scalar>
class WeightedColumns : public testing::Test {
 protected:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(WeightedColumns, Scalars);

TYPED_TEST(WeightedColumns, AreAddedToWhatIsThereInDouble) {
  constexpr int guard = 3;
  for (int rows = 0; rows <= 175; ++rows)  // below and above what prefetches need
    for (int count = 0; count <= kColumnGroup; ++count) {
      const auto columns = TestFixture::Matrix::Random(rows, count).eval();
      const Eigen::VectorXd weights = Eigen::VectorXd::Random(count);
      // Memory that starts off any boundary, with numbers after it that must stay.
      Eigen::VectorXd memory = Eigen::VectorXd::Random(1 + rows + guard);
      Eigen::VectorXd expected = memory;
      expected.segment(1, rows) += columns.template cast<double>() * weights;
      std::vector<const TypeParam*> pointers;
      for (int c = 0; c < count; ++c) pointers.push_back(columns.data() + c * rows);
      addWeightedColumns(pointers.data(), weights.data(), count, rows, memory.data() + 1);
      // The rounding of seven numbers below one, in double also where floats are stored.
      EXPECT_LE((memory - expected).lpNorm<Eigen::Infinity>(),
                kColumnGroup * std::numeric_limits<double>::epsilon())
          << rows << " rows of " << count;
      EXPECT_EQ(memory.tail(guard), expected.tail(guard));
      EXPECT_EQ(memory[0], expected[0]);
    }
}

TYPED_TEST(WeightedColumns, OnceMoreWithTheOppositeWeightsCancels) {
  const auto columns = TestFixture::Matrix::Random(1001, kColumnGroup).eval();
  const TypeParam* pointers[kColumnGroup];
  for (int c = 0; c < kColumnGroup; ++c) pointers[c] = columns.col(c).data();
  Eigen::VectorXd weights = Eigen::VectorXd::Random(kColumnGroup);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(1001);
  addWeightedColumns(pointers, weights.data(), kColumnGroup, 1001, out.data());
  EXPECT_GT(out.norm(), 1);
  weights *= -1;
  addWeightedColumns(pointers, weights.data(), kColumnGroup, 1001, out.data());
  // Rounding of six products, each way.
  EXPECT_LE(out.lpNorm<Eigen::Infinity>(),
            2 * kColumnGroup * std::numeric_limits<double>::epsilon());
}

}  // namespace
}  // namespace palpate::test
