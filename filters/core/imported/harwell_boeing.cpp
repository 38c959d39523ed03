// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/harwell_boeing.h"

#include <algorithm>
#include <cctype>

#include "text_lines.h"

namespace palpate::imported {
namespace {

constexpr std::int64_t kMostRows = 1 << 28, kMostEntries = std::int64_t(1) << 40,
                       kMostNode = std::int64_t(1) << 48;

/// Three letters in the third line say what it is.
std::string typeOf(std::string_view line) {
  std::string type(line.substr(0, 3));
  for (char& c : type) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return type;
}

/// Width of the numbers of a Fortran format such as (10I8), (1P,5E16.8) or (3D26.18).
std::size_t widthOf(const TextLines& lines, std::string_view format) {
  const std::size_t letter = format.find_first_of("IiEeDdFfGg");
  if (letter == format.npos) lines.refuse(shown(format), " is no Fortran format of numbers");
  std::size_t end = letter + 1;
  while (end < format.size() && std::isdigit(static_cast<unsigned char>(format[end]))) ++end;
  return static_cast<std::size_t>(
      lines.wholeNumber(format.substr(letter + 1, end - letter - 1), 1, 100));
}

/// Numbers line by line, from the next line on: between blanks, or where they are not all apart in
/// columns of one width. (SciPy's writer states another width than it writes.)
class FortranNumbers {
 public:
  FortranNumbers(TextLines& lines, std::size_t width) : lines_(lines), width_(width) {}

  std::string_view next(const char* what) {
    while (at_ == fields_.size()) {
      if (!lines_.next()) lines_.refuse("the file ends before its ", what);
      split();
      at_ = 0;
    }
    return fields_[at_++];
  }

 private:
  void split() {
    fields_ = wordsOf(lines_.line());
    const bool isApart = std::all_of(fields_.begin(), fields_.end(), [&](std::string_view word) {
      return word.size() <= width_ && numberOf(word);
    });
    if (isApart) return;
    fields_.clear();
    for (std::size_t at = 0; at < lines_.line().size(); at += width_) {
      const std::vector<std::string_view> words = wordsOf(lines_.line().substr(at, width_));
      fields_.insert(fields_.end(), words.begin(), words.end());
    }
  }

  TextLines& lines_;
  std::size_t width_, at_ = 0;
  std::vector<std::string_view> fields_;
};

}  // namespace

bool isHarwellBoeing(std::string_view bytes) {
  TextLines lines(bytes.substr(0, 4096), "");
  for (int line = 0; line < 3; ++line)
    if (!lines.next()) return false;
  const std::string type = typeOf(lines.line());
  return type.size() == 3 && std::string_view("RCP").find(type[0]) != std::string_view::npos &&
         std::string_view("SUHZR").find(type[1]) != std::string_view::npos &&
         std::string_view("AE").find(type[2]) != std::string_view::npos &&
         wordsOf(lines.line()).size() >= 4;
}

GivenMatrix readHarwellBoeing(std::string_view bytes, const std::string& path) {
  TextLines lines(bytes, path);
  for (int line = 0; line < 3; ++line)
    if (!lines.next()) lines.refuse("the header of this Harwell-Boeing file is cut off");
  const std::string type = typeOf(lines.line());
  if (type != "RSA" && type != "RUA")
    lines.refuse("a Harwell-Boeing matrix of the type ", shown(type),
                 " is not real, assembled, and symmetric or general (RSA, RUA)");
  const auto sizes = wordsOf(lines.line().substr(3));
  if (sizes.size() < 3) lines.refuse("rows, columns and entries are not all given");
  const auto size = static_cast<int>(lines.wholeNumber(sizes[0], 1, kMostRows));
  if (lines.wholeNumber(sizes[1], 1, kMostRows) != size)
    lines.refuse("the matrix is not square, as stiffnesses are");
  const std::int64_t count = lines.wholeNumber(sizes[2], 1, kMostEntries);
  if (count < size || static_cast<std::size_t>(count) > lines.bytesLeft() / 2)
    lines.refuse("there cannot be ", count, " entries of ", size, " rows in this file");
  lines.next();
  const std::vector<std::string_view> formats = wordsOf(lines.line());
  if (formats.size() < 3) lines.refuse("the formats of the numbers are not all given");
  const std::size_t widths[] = {widthOf(lines, formats[0]), widthOf(lines, formats[1]),
                                widthOf(lines, formats[2])};
  if (formats.size() > 3) lines.next();  // about right-hand sides

  std::vector<std::int64_t> starts(std::size_t(size) + 1);
  FortranNumbers pointers(lines, widths[0]);
  for (std::size_t j = 0; j < starts.size(); ++j) {
    starts[j] = lines.wholeNumber(pointers.next("columns"), 1, count + 1);
    if (j == 0 ? starts[j] != 1 : starts[j] < starts[j - 1])
      lines.refuse("the columns' beginnings do not ascend from 1");
  }
  if (starts.back() != count + 1) lines.refuse("the last column does not end with the entries");
  std::vector<GivenMatrix::Entry> entries(count);
  FortranNumbers rows(lines, widths[1]);
  for (int j = 0; j < size; ++j)
    for (std::int64_t k = starts[j] - 1; k < starts[j + 1] - 1; ++k)
      entries[k] = {static_cast<int>(lines.wholeNumber(rows.next("rows"), 1, size)) - 1, j, 0};
  FortranNumbers values(lines, widths[2]);
  for (GivenMatrix::Entry& entry : entries)
    entry = {entry.row(), entry.col(), lines.number(values.next("values"))};
  return GivenMatrix(size, std::move(entries), type == "RSA", "Harwell-Boeing", path);
}

std::vector<MatrixDof> readMapping(std::string_view bytes, int size, const std::string& path) {
  static constexpr std::string_view kNames[] = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};
  TextLines lines(bytes, path);
  std::vector<MatrixDof> dofs(size);
  std::vector<bool> isGiven(size, false);
  bool hasBegun = false;
  while (lines.nextWith('!')) {
    const std::vector<std::string_view> words = wordsOf(lines.line());
    if (!hasBegun && !numberOf(words[0])) continue;  // a heading
    hasBegun = true;
    if (words.size() != 3) lines.refuse("a line must give equation, node and degree of freedom");
    const auto row = lines.wholeNumber(words[0], 1, size) - 1;
    if (isGiven[row]) lines.refuse("equation ", row + 1, " is given twice");
    isGiven[row] = true;
    const auto* name = std::find(std::begin(kNames), std::end(kNames), words[2]);
    if (name == std::end(kNames))
      lines.refuse("the degree of freedom ", shown(words[2]),
                   " is no displacement or rotation (UX, UY, UZ, ROTX, ROTY, ROTZ)");
    dofs[row] = {lines.wholeNumber(words[1], 1, kMostNode),
                 static_cast<int>(name - std::begin(kNames))};
  }
  const auto missing = std::find(isGiven.begin(), isGiven.end(), false);
  if (missing != isGiven.end())
    palpate::refuse(path, " says nothing of row ", missing - isGiven.begin() + 1,
                    " of the matrix, which has ", size, " rows");
  return dofs;
}

}  // namespace palpate::imported
