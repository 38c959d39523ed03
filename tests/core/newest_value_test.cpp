// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/newest_value.h"

#include <gtest/gtest.h>

#include <thread>

namespace palpate::test {
namespace {

TEST(NewestValues, TheNewestWinsAndIsTakenOnce) {
  NewestValue<int> slot;
  int value = -1;
  EXPECT_FALSE(slot.take(value));
  EXPECT_EQ(value, -1);
  for (int i = 1; i <= 7; ++i) slot.put(i);
  EXPECT_TRUE(slot.take(value));
  EXPECT_EQ(value, 7);
  EXPECT_FALSE(slot.take(value));
  slot.put(8);
  EXPECT_TRUE(slot.take(value));
  EXPECT_EQ(value, 8);
}

TEST(NewestValues, AreNeverTornNorOutOfOrder) {
  struct Many {
    std::array<long, 32> copies;
  };
  NewestValue<Many> slot;
  constexpr long last = 300000;
  std::thread writer([&] {
    for (long i = 1; i <= last; ++i) {
      Many value;
      value.copies.fill(i);
      slot.put(value);
    }
  });
  long before = 0, torn = 0, backwards = 0;
  while (before < last) {
    Many value;
    if (!slot.take(value)) {
      std::this_thread::yield();
      continue;
    }
    for (long copy : value.copies) torn += copy != value.copies[0];
    backwards += value.copies[0] <= before;
    before = value.copies[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
}

}  // namespace
}  // namespace palpate::test
