// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sentence.h"

namespace palpate {

/// All of an ordinary file.
/// @throws std::runtime_error that begins with `path` if it is none, is empty or cannot be read.
std::string readBytes(const std::string& path);

/// The number that a word is from its beginning to its end, in any locale; Fortran's D is an E. A
/// number too small for a double is 0.
std::optional<double> numberOf(std::string_view word);

/// A word as a sentence shows it: not too long, without control characters.
std::string shown(std::string_view word);

/// The words of a line. Between blanks there are as many as are not empty.
/// @param separator  ' ' for any blanks; else blanks round a word are taken away.
std::vector<std::string_view> wordsOf(std::string_view line, char separator = ' ');

/// The separator of a line of numbers: ';' or ',' if there is one, else blanks.
char separatorOf(std::string_view line);

/// The lines of a text, one after the other.
class TextLines {
 public:
  /// @param text  outlives this; a byte order mark is passed over.
  /// @param path  for sentences.
  TextLines(std::string_view text, std::string path);

  /// Goes to the next line; false, and an empty line, behind the last.
  bool next();
  /// Goes to the next line that is not blank and does not begin with `comment`.
  bool nextWith(char comment);

  std::string_view line() const { return line_; }
  /// From 1.
  std::size_t lineNumber() const { return number_; }
  /// Bytes from the current line on, itself included.
  std::size_t bytesLeft() const { return text_.size() - start_; }

  /// Finite.
  double number(std::string_view word) const;
  /// As double precision holds it, as programs write 3.0 for 3.
  std::int64_t wholeNumber(std::string_view word, std::int64_t least, std::int64_t most) const;

  /// @throws std::invalid_argument that begins with the file and the line.
  template <class... Parts>
  [[noreturn]] void refuse(const Parts&... parts) const {
    palpate::refuse(path_, ", line ", number_, ": ", parts...);
  }
  const std::string& path() const { return path_; }

 private:
  std::string_view text_, line_;
  std::string path_;
  std::size_t start_ = 0, next_ = 0;
  std::size_t number_ = 0;
};

}  // namespace palpate
