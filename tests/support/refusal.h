// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace palpate::test {

/// True if `act` throws an Exception whose message contains `sentence`.
template <class Exception = std::invalid_argument, class Act>
testing::AssertionResult isRefused(const Act& act, const std::string& sentence) {
  try {
    act();
  } catch (const Exception& refusal) {
    if (std::string(refusal.what()).find(sentence) != std::string::npos)
      return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "refused with \"" << refusal.what() << "\", not \"" << sentence << "\"";
  } catch (const std::exception& other) {
    return testing::AssertionFailure() << "another kind of exception: " << other.what();
  }
  return testing::AssertionFailure() << "not refused";
}

}  // namespace palpate::test
