// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/computed_greens_functions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <type_traits>

#include "support/problems.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

template <class Scalar>
AlignedBuffer<Scalar> bufferOf(const Eigen::MatrixXd& matrix) {
  AlignedBuffer<Scalar> buffer(matrix.size());
  std::copy_n(matrix.data(), matrix.size(), buffer.data());
  return buffer;
}

/// Those of a made-up body, as a producer leaves them.
template <class Scalar>
ComputedGreensFunctions computed(const SyntheticBody& body) {
  ComputedGreensFunctions result;
  result.info = body.info();
  if constexpr (std::is_same_v<Scalar, float>)
    result.floatMatrix = bufferOf<float>(body.matrix());
  else
    result.matrix = bufferOf<double>(body.matrix());
  return result;
}

template <class Scalar>
class Computed : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(Computed, Scalars);

TYPED_TEST(Computed, AreServedAsStored) {
  const SyntheticBody body;
  const Eigen::MatrixXd stored = body.matrix().template cast<TypeParam>().template cast<double>();
  ComputedGreensFunctions result = computed<TypeParam>(body);
  EXPECT_EQ(denseMatrix(*result.view()), stored);
  EXPECT_EQ(result.view()->epsilon(), std::numeric_limits<TypeParam>::epsilon());
  const auto taken = result.take();
  EXPECT_EQ(denseMatrix(*taken), stored);
  EXPECT_EQ(taken->epsilon(), std::numeric_limits<TypeParam>::epsilon());
}

TYPED_TEST(Computed, AreTakenWithoutACopy) {
  ComputedGreensFunctions result = computed<TypeParam>({});
  const auto view = result.view();
  const auto matrixOf = [](const GreensFunctions& greens) {
    return dynamic_cast<const DenseGreensFunctions<TypeParam>&>(greens).matrix().data();
  };
  const TypeParam* const memory = matrixOf(*view);
  const auto taken = result.take();
  EXPECT_EQ(matrixOf(*taken), memory);
  EXPECT_FALSE(result.matrix.data());
  EXPECT_FALSE(result.floatMatrix.data());
}

TEST(Columns, AreTheFreeNodesByDefaultAndSortedWithoutRepetition) {
  const ElasticModel model = makeModel(icosphere(1), cap, 1, 0.3);
  EXPECT_EQ(checkedColumns(model, {}), model.conditions().freeNodes());
  EXPECT_EQ(checkedColumns(model, {9, 3, 9}), (std::vector<int>{3, 9}));
}

TEST(Columns, OutOfRangeAreRefusedByName) {
  const ElasticModel model = makeModel(icosphere(1), cap, 1, 0.3);
  EXPECT_TRUE(isRefused([&] { checkedColumns(model, {3, 42}); }, "node 42"));
  EXPECT_TRUE(isRefused([&] { checkedColumns(model, {-1, 3}); }, "node -1"));
}

}  // namespace
}  // namespace palpate::test
