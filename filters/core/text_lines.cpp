// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "text_lines.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace palpate {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view word) {
  while (!word.empty() && isBlank(word.front())) word.remove_prefix(1);
  while (!word.empty() && isBlank(word.back())) word.remove_suffix(1);
  return word;
}

}  // namespace

std::string readBytes(const std::string& path) {
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (!std::filesystem::exists(status)) throw std::runtime_error(path + ": there is no such file");
  if (!std::filesystem::is_regular_file(status))
    throw std::runtime_error(path + " is not an ordinary file");
  const auto size = std::filesystem::file_size(path, unknown);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (unknown || !file) throw std::runtime_error(path + " cannot be read: " + std::strerror(errno));
  if (size == 0) throw std::runtime_error(path + " is empty");
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(file.gcount()) != size)
    throw std::runtime_error(path + " cannot be read: it ended early");
  return bytes;
}

std::optional<double> numberOf(std::string_view word) {
  constexpr std::size_t longest = 128;
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty() || word.front() == '+' || word.size() > longest) return {};
  char text[longest];
  bool isSmall = false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    text[i] = word[i] == 'D' || word[i] == 'd' ? 'e' : word[i];
    isSmall = isSmall || (i > 0 && word[i] == '-');
  }
  double value = 0;
  const auto [end, failure] = std::from_chars(text, text + word.size(), value);
  if (end != text + word.size()) return {};
  if (failure == std::errc::result_out_of_range && isSmall) return 0;
  if (failure != std::errc()) return {};
  return value;
}

std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

std::vector<std::string_view> wordsOf(std::string_view line, char separator) {
  std::vector<std::string_view> words;
  if (separator != ' ') {
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      words.push_back(trimmed(line.substr(at, end - at)));
      at = end + 1;
    }
    return words;
  }
  for (std::size_t at = 0; at < line.size();) {
    if (isBlank(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !isBlank(line[end])) ++end;
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

char separatorOf(std::string_view line) {
  if (line.find(';') != line.npos) return ';';
  return line.find(',') != line.npos ? ',' : ' ';
}

TextLines::TextLines(std::string_view text, std::string path)
    : text_(text), path_(std::move(path)) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (text_.substr(0, mark.size()) == mark) text_.remove_prefix(mark.size());
}

bool TextLines::next() {
  start_ = next_;
  line_ = {};
  if (next_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', next_), text_.size());
  line_ = text_.substr(next_, end - next_);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  next_ = end + 1;
  ++number_;
  return true;
}

bool TextLines::nextWith(char comment) {
  while (next()) {
    const std::string_view content = trimmed(line_);
    if (!content.empty() && content.front() != comment) return true;
  }
  return false;
}

double TextLines::number(std::string_view word) const {
  const std::optional<double> value = numberOf(word);
  if (!value) refuse(shown(word), " is not a number");
  if (!std::isfinite(*value)) refuse(shown(word), " is not a finite number");
  return *value;
}

std::int64_t TextLines::wholeNumber(std::string_view word, std::int64_t least,
                                    std::int64_t most) const {
  const double value = number(word);
  if (value != std::floor(value) || !(value >= double(least) && value <= double(most)))
    refuse(shown(word), " is not a whole number from ", least, " to ", most);
  return static_cast<std::int64_t>(value);
}

}  // namespace palpate
