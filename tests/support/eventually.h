// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace palpate::test {

/// True as soon as a condition holds, false if it does not within a time that is long even for a
/// machine with much else to do.
template <class Condition>
testing::AssertionResult eventually(Condition&& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline)
      return testing::AssertionFailure() << "it never came true";
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return testing::AssertionSuccess();
}

}  // namespace palpate::test
