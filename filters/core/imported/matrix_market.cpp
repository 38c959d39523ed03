// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/matrix_market.h"

#include <algorithm>
#include <cctype>

#include "text_lines.h"

namespace palpate::imported {
namespace {

constexpr std::string_view kBanner = "%%MatrixMarket";

std::string lowered(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

struct Banner {
  bool isArray, isSymmetric;
};

Banner readBanner(TextLines& lines) {
  lines.next();
  const std::vector<std::string_view> words = wordsOf(lines.line());
  const auto oneOf = [&](std::size_t index, const char* what, const char* first,
                         const char* second) {
    const std::string word = index < words.size() ? lowered(words[index]) : "";
    if (word != first && word != second)
      lines.refuse("the ", what, " of this Matrix Market file is ", shown(word), ", not ", first,
                   *second ? " or " : "", second);
    return word == first;
  };
  oneOf(1, "object", "matrix", "");
  const bool isArray = oneOf(2, "format", "array", "coordinate");
  oneOf(3, "field", "real", "integer");
  const bool isSymmetric = oneOf(4, "symmetry", "symmetric", "general");
  return {isArray, isSymmetric};
}

/// The next line's words.
std::vector<std::string_view> nextWords(TextLines& lines, std::size_t count, const char* what) {
  if (!lines.nextWith('%')) lines.refuse("the file ends before its ", what);
  const std::vector<std::string_view> words = wordsOf(lines.line());
  if (words.size() != count)
    lines.refuse("there are ", words.size(), " numbers, not the ", count, " of ", what);
  return words;
}

/// @throws unless a file has room for so many entries, each of which takes two bytes or more.
void requireRoom(const TextLines& lines, std::int64_t entries) {
  if (entries < 1) lines.refuse("the matrix has no entries");
  if (static_cast<std::size_t>(entries) > lines.bytesLeft() / 2)
    lines.refuse("the file is too short for ", entries, " entries");
}

GivenMatrix readArray(TextLines& lines, bool isSymmetric, int size, const std::string& path) {
  const std::int64_t n = size;
  requireRoom(lines, isSymmetric ? n * (n + 1) / 2 : n * n);
  Eigen::MatrixXd values(n, n);
  for (int j = 0; j < size; ++j)
    for (int i = isSymmetric ? j : 0; i < size; ++i) {
      values(i, j) = lines.number(nextWords(lines, 1, "an entry")[0]);
      if (isSymmetric) values(j, i) = values(i, j);
    }
  return GivenMatrix(std::move(values), "Matrix Market", path);
}

GivenMatrix readCoordinates(TextLines& lines, bool isSymmetric, int size, std::int64_t count,
                            const std::string& path) {
  requireRoom(lines, count);
  if (count < size)
    lines.refuse("a matrix of ", size, " rows with ", count,
                 " entries has rows without any, which nothing holds");
  std::vector<GivenMatrix::Entry> entries;
  entries.reserve((isSymmetric ? 2 : 1) * count);
  for (std::int64_t i = 0; i < count; ++i) {
    const auto words = nextWords(lines, 3, "an entry: row, column and value");
    const auto row = static_cast<int>(lines.wholeNumber(words[0], 1, size)),
               column = static_cast<int>(lines.wholeNumber(words[1], 1, size));
    entries.emplace_back(row - 1, column - 1, lines.number(words[2]));
  }
  return GivenMatrix(size, std::move(entries), isSymmetric, "Matrix Market", path);
}

}  // namespace

bool isMatrixMarket(std::string_view bytes) {
  return bytes.substr(0, kBanner.size()) == kBanner;
}

GivenMatrix readMatrixMarket(std::string_view bytes, const std::string& path) {
  constexpr std::int64_t mostRows = 1 << 28, mostEntries = std::int64_t(1) << 40;
  TextLines lines(bytes, path);
  const Banner banner = readBanner(lines);
  const auto sizes = nextWords(lines, banner.isArray ? 2 : 3, "the matrix' size");
  const auto rows = static_cast<int>(lines.wholeNumber(sizes[0], 1, mostRows)),
             columns = static_cast<int>(lines.wholeNumber(sizes[1], 1, mostRows));
  if (rows != columns)
    lines.refuse("the matrix is ", rows, " by ", columns,
                 ", but compliances and stiffnesses are square");
  GivenMatrix matrix = banner.isArray
                           ? readArray(lines, banner.isSymmetric, rows, path)
                           : readCoordinates(lines, banner.isSymmetric, rows,
                                             lines.wholeNumber(sizes[2], 1, mostEntries), path);
  if (lines.nextWith('%')) lines.refuse("there is more than the entries that the file said");
  return matrix;
}

}  // namespace palpate::imported
