// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace palpate::test {

/// A case of the catalogue of hard cases (README.md beside this file). What is expected of it is
/// asserted and recorded in one call, so that no row can say another thing than its test.
///
/// A row is a file of one line with tabs between its fields, in the folder that the environment
/// names with PALPATE_HARD_CASES; without it nothing is recorded. Names of files sort in the order
/// of the tests in their source.
class HardCase {
 public:
  /// @param area    material, scale, mesh, edges, thin, supports, capacitance, masks, stiffness,
  ///                half-space, shells or identification.
  /// @param name    what is hard.
  /// @param danger  what could go wrong.
  HardCase(std::string area, std::string name, std::string danger)
      : area_(std::move(area)), name_(std::move(name)), danger_(std::move(danger)) {}

  /// Expects measured <= bound, which no NaN is.
  void expectAtMost(const std::string& quantity, double measured, double bound) const {
    EXPECT_TRUE(measured <= bound)
        << name_ << ": " << quantity << " is " << measured << ", more than " << bound;
    record(quantity, number(measured, 2), "≤ " + number(bound, 4));
  }

  /// Expects measured >= bound.
  void expectAtLeast(const std::string& quantity, double measured, double bound) const {
    EXPECT_TRUE(measured >= bound)
        << name_ << ": " << quantity << " is " << measured << ", less than " << bound;
    record(quantity, number(measured, 2), "≥ " + number(bound, 4));
  }

  /// Expects a count to be this.
  void expectCount(const std::string& quantity, long measured, long expected) const {
    EXPECT_EQ(measured, expected) << name_ << ": " << quantity;
    record(quantity, std::to_string(measured), std::to_string(expected));
  }

  /// Expects a sentence that holds these words.
  void expectSaid(const std::string& sentence, const std::string& words) const {
    EXPECT_NE(sentence.find(words), std::string::npos)
        << name_ << ": \"" << sentence << "\" does not say \"" << words << "\"";
    record("sentence", sentence.empty() ? "(none)" : sentence, "“" + words + "”");
  }

  /// Expects a call to be refused by this exception with a sentence that holds these words.
  template <class Exception = std::invalid_argument, class Call>
  void expectRefused(Call&& call, const std::string& words) const {
    expectAllRefused<Exception>({call}, words);
  }

  /// The same of several calls; the row shows the first one's sentence.
  template <class Exception = std::invalid_argument>
  void expectAllRefused(const std::vector<std::function<void()>>& calls,
                        const std::string& words) const {
    std::string first;
    for (const auto& call : calls) {
      std::string sentence;
      try {
        call();
      } catch (const Exception& error) {
        sentence = error.what();
      }
      EXPECT_NE(sentence.find(words), std::string::npos)
          << name_ << ": \"" << sentence << "\" does not say \"" << words << "\"";
      if (first.empty()) first = sentence;
    }
    expectSaid(first, words);
  }

 private:
  static std::string number(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
  }

  /// Of the running test among all of its program.
  static int testIndex() {
    const auto& all = *testing::UnitTest::GetInstance();
    int index = 0;
    for (int s = 0; s < all.total_test_suite_count(); ++s)
      for (int t = 0; t < all.GetTestSuite(s)->total_test_count(); ++t, ++index)
        if (all.GetTestSuite(s)->GetTestInfo(t) == all.current_test_info()) return index;
    return index;
  }

  void record(const std::string& quantity, const std::string& measured,
              const std::string& bound) const {
    const char* folder = std::getenv("PALPATE_HARD_CASES");
    if (!folder) return;
    static int count = 0;
    char order[32];
    std::snprintf(order, sizeof order, "-%03d-%03d.tsv", testIndex(), count++);
    const std::string path = std::string(folder) + "/" + program_invocation_short_name + order;
    std::ofstream file(path);
    file << area_ << '\t' << name_ << '\t' << danger_ << '\t' << quantity << '\t' << measured
         << '\t' << bound << '\n';
    file.close();
    EXPECT_TRUE(file) << path << " cannot be written";
  }

  std::string area_, name_, danger_;
};

}  // namespace palpate::test
