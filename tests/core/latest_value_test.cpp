// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

#include "support/allocation_count.h"

namespace palpate::test {
namespace {

TEST(LatestValue, TheReaderKeepsItsValueUntilItAsksForANewerOne) {
  LatestValue<int> value(7);
  EXPECT_FALSE(value.update());
  EXPECT_EQ(value.latest(), 7);
  for (int i : {1, 2, 3}) {
    value.writable() = i;
    value.publish();
    EXPECT_EQ(value.latest(), 7);
  }
  EXPECT_TRUE(value.update());
  EXPECT_EQ(value.latest(), 3) << "the newest one, not the oldest unread";
  EXPECT_FALSE(value.update());
  EXPECT_EQ(value.latest(), 3);
}

TEST(LatestValue, TheWriterNeverWritesWhatTheReaderReads) {
  LatestValue<int> value(0);
  for (int i = 1; i < 100; ++i) {
    for (int k = 0; k < i % 4; ++k) {
      EXPECT_NE(&value.writable(), &value.latest());
      value.writable() = i;
      value.publish();
    }
    value.update();
    EXPECT_NE(&value.writable(), &value.latest());
  }
}

TEST(LatestValue, NoValueIsSeenTornOrOutOfOrder) {
  constexpr int kWords = 64, kLast = 200000;
  LatestValue<std::array<int, kWords>> value(std::array<int, kWords>{});
  std::thread writer([&] {
    for (int i = 1; i <= kLast; ++i) {
      value.writable().fill(i);
      value.publish();
    }
  });
  int torn = 0, backwards = 0, last = 0;
  while (last < kLast) {
    if (!value.update()) {
      std::this_thread::yield();
      continue;
    }
    const auto& words = value.latest();
    for (int word : words) torn += word != words[0];
    backwards += words[0] <= last;
    last = words[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
}

TEST(LatestValue, HandingOverAllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  LatestValue<std::vector<int>> value(std::vector<int>(1000));
  const long before = allocationCount();
  for (int i = 0; i < 100; ++i) {
    value.writable().assign(1000, i);
    value.publish();
    value.update();
  }
  EXPECT_EQ(allocationCount(), before);
}

}  // namespace
}  // namespace palpate::test
