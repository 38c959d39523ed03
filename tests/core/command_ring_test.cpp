// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/command_ring.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <thread>

#include "support/allocation_count.h"

namespace palpate::test {
namespace {

struct Target {
  long sum = 0, calls = 0, last = 0;
  bool inOrder = true;
  Eigen::Quaterniond rotation;
};

TEST(CommandRing, CallsCommandsOnceInTheirOrder) {
  CommandRing<Target> ring;
  Target target;
  for (int round = 0; round < 50; ++round) {
    for (int i = 1; i <= 7; ++i)
      ASSERT_TRUE(ring.post([i](Target& t) noexcept { t.sum = 10 * t.sum + i; }));
    ring.takeAll(target);
    EXPECT_EQ(target.sum, 1234567);
    target.sum = 0;
    ring.takeAll(target);
    EXPECT_EQ(target.sum, 0);
  }
}

TEST(CommandRing, AFullRingTakesNothingAndLosesNothing) {
  CommandRing<Target> ring;
  Target target;
  const auto count = [](Target& t) noexcept { ++t.calls; };
  for (std::size_t i = 0; i < CommandRing<Target>::kCapacity; ++i) ASSERT_TRUE(ring.post(count));
  EXPECT_FALSE(ring.post(count));
  ring.takeAll(target);
  EXPECT_EQ(target.calls, static_cast<long>(CommandRing<Target>::kCapacity));
  EXPECT_TRUE(ring.post(count));
}

TEST(CommandRing, CarriesValuesThatEigenAligns) {
  CommandRing<Target> ring;
  Target target;
  const Eigen::Quaterniond rotation(0.5, 0.5, -0.5, 0.5);
  ring.post([rotation](Target& t) noexcept { t.rotation = rotation; });
  ring.takeAll(target);
  EXPECT_EQ(target.rotation.coeffs(), rotation.coeffs());
}

TEST(CommandRing, CrossesThreadsWithoutLossOrDisorder) {
  CommandRing<Target> ring;
  constexpr long kCommands = 100000;
  std::thread poster([&] {
    for (long i = 1; i <= kCommands; ++i)
      while (!ring.post([i](Target& t) noexcept {
        t.inOrder = t.inOrder && t.last + 1 == i;
        t.last = i;
      }))
        std::this_thread::yield();
  });
  Target target;
  while (target.last < kCommands) {
    ring.takeAll(target);
    std::this_thread::yield();
  }
  poster.join();
  EXPECT_TRUE(target.inOrder);
}

TEST(CommandRing, PostingAndTakingAllocateNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  CommandRing<Target> ring;
  Target target;
  const long before = allocationCount();
  for (int i = 0; i < 1000; ++i) {
    ring.post([i](Target& t) noexcept { t.sum += i; });
    ring.takeAll(target);
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_EQ(target.sum, 499500);
}

}  // namespace
}  // namespace palpate::test
