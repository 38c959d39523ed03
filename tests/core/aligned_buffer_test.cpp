// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/aligned_buffer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

namespace palpate::test {
namespace {

TEST(AlignedBuffer, StartsOnACacheLineAndLargeOnesOnAHugePage) {
  for (std::size_t count : {std::size_t(1), std::size_t(7), std::size_t(100001)})
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(AlignedBuffer<double>(count).data()) % 64, 0u);
  const AlignedBuffer<double> large((std::size_t(1) << 18) + 3);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large.data()) % (std::size_t(1) << 21), 0u);
}

TEST(AlignedBuffer, HoldsAsManyNumbersAsItWasMadeFor) {
  for (std::size_t count : {0, 1, 5, 1000}) {
    const AlignedBuffer<float> buffer(count);
    EXPECT_NE(buffer.data(), nullptr);
    EXPECT_EQ(buffer.size(), count);
    EXPECT_EQ(buffer.bytes(), 4 * count);
    for (std::size_t i = 0; i < count; ++i) buffer.data()[i] = float(i);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(buffer.data()[i], float(i));
  }
  EXPECT_EQ(AlignedBuffer<double>().size(), 0u);
  EXPECT_EQ(AlignedBuffer<double>().data(), nullptr);
}

TEST(AlignedBuffer, TruncationOnlyEverCountsFewer) {
  AlignedBuffer<double> buffer(10);
  const double* memory = buffer.data();
  buffer.truncate(12);
  EXPECT_EQ(buffer.size(), 10u);
  buffer.truncate(4);
  EXPECT_EQ(buffer.size(), 4u);
  EXPECT_EQ(buffer.data(), memory);
}

TEST(AlignedBuffer, ReleasedMemoryBelongsToItsNewOwner) {
  AlignedBuffer<double> buffer(10);
  double* memory = buffer.data();
  EXPECT_EQ(buffer.release(), memory);
  EXPECT_EQ(buffer.data(), nullptr);
  EXPECT_EQ(buffer.size(), 0u);
  memory[9] = 1;
  std::free(memory);
}

TEST(AlignedBuffer, AnImpossibleSizeThrows) {
  for (int power : {58, 61, 63})  // from 61 on the number of bytes does not fit its type
    EXPECT_THROW(AlignedBuffer<double>(std::size_t(1) << power), std::bad_alloc) << power;
}

}  // namespace
}  // namespace palpate::test
