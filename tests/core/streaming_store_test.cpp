// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/streaming_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Core>

#include "linear_algebra/aligned_buffer.h"

namespace palpate::test {
namespace {

template <class Scalar>
class StreamingStore : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(StreamingStore, Scalars);

TYPED_TEST(StreamingStore, CopiesEveryNumberRoundedToItsTargetAndNoMore) {
  constexpr int size = 64;
  for (int count = 0; count < size; count += 4) {
    const Eigen::VectorXd source = Eigen::VectorXd::Random(size);
    AlignedBuffer<TypeParam> target(size);
    std::fill_n(target.data(), size, TypeParam(7));
    streamStore(source.data(), count, target.data());
    finishStreaming();
    for (int i = 0; i < size; ++i)
      EXPECT_EQ(target.data()[i], i < count ? TypeParam(source[i]) : TypeParam(7)) << i;
  }
}

TYPED_TEST(StreamingStore, ACacheLineIs64Bytes) {
  EXPECT_EQ(kLine<TypeParam> * sizeof(TypeParam), 64u);
}

}  // namespace
}  // namespace palpate::test
