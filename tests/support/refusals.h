// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace palpate::test {

/// The sentence with which a call is refused; a failure of the test if it is not.
template <class Exception = std::invalid_argument, class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

/// For EXPECT_TRUE with a message that shows both.
inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << text << "\" does not contain \"" << part << "\"";
}

/// True if a call is refused with a sentence that contains this.
template <class Exception = std::invalid_argument, class Call>
testing::AssertionResult isRefused(Call&& call, const std::string& sentence) {
  return contains(refusal<Exception>(call), sentence);
}

}  // namespace palpate::test
