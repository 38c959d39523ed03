// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "progress.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

TEST(ParallelFor, RunsEveryItemOnceForAnyNumberOfThreads) {
  for (int threads : {1, 2, 3, 16})
    for (int count : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> runs(count);
      for (auto& run : runs) run = 0;
      std::atomic<bool> threadInRange{true};
      parallelFor(count, threads, [&](int item, int thread) {
        ++runs[item];
        if (thread < 0 || thread >= threads) threadInRange = false;
      });
      for (auto& run : runs) EXPECT_EQ(run, 1);
      EXPECT_TRUE(threadInRange);
    }
}

TEST(ParallelFor, ThreadNumbersAreNeverSharedAtOneTime) {
  constexpr int threads = 4;
  std::vector<std::atomic<int>> inside(threads);
  for (auto& count : inside) count = 0;
  std::atomic<bool> shared{false};
  parallelFor(2000, threads, [&](int, int thread) {
    if (++inside[thread] != 1) shared = true;
    std::this_thread::yield();
    --inside[thread];
  });
  EXPECT_FALSE(shared);
}

TEST(ParallelFor, OneThreadIsTheCallerItself) {
  const auto caller = std::this_thread::get_id();
  int others = 0, last = -1;
  parallelFor(10, 1, [&](int item, int) {
    others += std::this_thread::get_id() != caller;
    EXPECT_EQ(item, last + 1);
    last = item;
  });
  EXPECT_EQ(others, 0);
}

TEST(ParallelFor, PassesOnTheExceptionOfAnyItem) {
  for (int threads : {1, 4})
    for (int bad : {0, 50, 99})
      EXPECT_EQ(refusal<std::runtime_error>([&] {
                  parallelFor(100, threads, [&](int item, int) {
                    if (item == bad) throw std::runtime_error("item " + std::to_string(item));
                  });
                }),
                "item " + std::to_string(bad));
}

TEST(ParallelFor, BeginsNoItemOnceOneHasFailed) {
  // One thread: items come in order, so that what follows the bad one must not run.
  int begun = 0;
  EXPECT_THROW(parallelFor(1000, 1,
                           [&](int item, int) {
                             ++begun;
                             if (item == 10) throw std::runtime_error("bad");
                           }),
               std::runtime_error);
  EXPECT_EQ(begun, 11);
}

TEST(ParallelFor, ReportsFromTheCallersThreadAndNeverBackwards) {
  const auto caller = std::this_thread::get_id();
  for (int threads : {1, 4}) {
    int last = 0, calls = 0;
    parallelFor(
        500, threads, [](int, int) {},
        [&](int begun) {
          EXPECT_EQ(std::this_thread::get_id(), caller);
          EXPECT_GE(begun, last);
          EXPECT_LE(begun, 500);
          last = begun;
          ++calls;
        });
    if (threads == 1) {
      EXPECT_EQ(calls, 500);
      EXPECT_EQ(last, 500);
    }
  }
}

TEST(ParallelFor, AnAbortInTheReportStopsAllThreads) {
  std::atomic<int> begun{0};
  EXPECT_THROW(parallelFor(
                   1 << 30, 4, [&](int, int) { ++begun; },
                   [](int count) {
                     if (count > 100) throw Aborted();
                   }),
               Aborted);
  EXPECT_LT(begun, 1 << 30);
}

TEST(ThreadCount, IsAtLeastOneAndWhatWasAskedFor) {
  EXPECT_EQ(threadCount(3), 3);
  EXPECT_GE(threadCount(0), 1);
  EXPECT_EQ(threadCount(-1), threadCount(0));
}

}  // namespace
}  // namespace palpate::test
