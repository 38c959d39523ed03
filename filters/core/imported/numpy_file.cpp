// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/numpy_file.h"

#include <charconv>
#include <cstdint>
#include <cstring>

#include "sentence.h"
#include "text_lines.h"

namespace palpate::imported {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

/// What a header says of an array.
struct Header {
  std::string_view type;
  bool isFortran = false;
  std::size_t rows = 0, columns = 0;
  int dimensions = -1;
};

/// The text of a Python dictionary as NumPy writes it: three keys, each once, in any order.
class HeaderText {
 public:
  HeaderText(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  Header read() {
    Header header;
    bool hasOrder = false;
    expect('{');
    while (!takes('}')) {
      const std::string_view key = quoted();
      expect(':');
      if (key == "descr" && header.type.empty())
        header.type = quoted();
      else if (key == "fortran_order" && !hasOrder)
        header.isFortran = flag(), hasOrder = true;
      else if (key == "shape" && header.dimensions < 0)
        shape(header);
      else
        damaged();
      if (takes('}')) break;
      expect(',');
    }
    skipBlanks();
    if (at_ != text_.size() || header.type.empty() || !hasOrder || header.dimensions < 0) damaged();
    return header;
  }

 private:
  [[noreturn]] void damaged() const {
    palpate::refuse(path_, ": the header of this .npy file is not as NumPy writes it");
  }
  void skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool takes(char c) {
    skipBlanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!takes(c)) damaged();
  }
  std::string_view quoted() {
    expect('\'');
    const std::size_t end = text_.find('\'', at_);
    if (end == text_.npos) damaged();
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (word.empty()) damaged();
    return word;
  }
  bool flag() {
    skipBlanks();
    for (const auto& [word, value] : {std::pair("True", true), std::pair("False", false)})
      if (text_.substr(at_, std::strlen(word)) == word) {
        at_ += std::strlen(word);
        return value;
      }
    damaged();
  }
  void shape(Header& header) {
    expect('(');
    header.dimensions = 0;
    while (!takes(')')) {
      std::size_t extent = 0;
      skipBlanks();
      const auto [end, failure] =
          std::from_chars(text_.data() + at_, text_.data() + text_.size(), extent);
      if (failure != std::errc()) damaged();
      at_ = end - text_.data();
      (header.dimensions == 0 ? header.rows : header.columns) = extent;
      ++header.dimensions;
      if (takes(')')) break;
      expect(',');
    }
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
};

template <class Scalar>
Eigen::MatrixXd values(std::string_view bytes, const Header& header) {
  // The bytes lie anywhere: they are copied, not mapped.
  Eigen::MatrixXd matrix(header.rows, header.columns);
  for (std::size_t i = 0; i < header.rows * header.columns; ++i) {
    Scalar value;
    std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
    if (header.isFortran)
      matrix(i % header.rows, i / header.rows) = value;
    else
      matrix(i / header.columns, i % header.columns) = value;
  }
  return matrix;
}

}  // namespace

bool isNumpy(std::string_view bytes) {
  return bytes.substr(0, kMagic.size()) == kMagic;
}

Eigen::MatrixXd readNumpy(std::string_view bytes, const std::string& path) {
  const auto cutOff = [&] { refuse(path, ": this .npy file is cut off"); };
  const std::size_t versionAt = kMagic.size();
  if (bytes.size() < versionAt + 2) cutOff();
  const int version = static_cast<unsigned char>(bytes[versionAt]);
  if (version < 1 || version > 3)
    refuse(path, ": this .npy file is of version ", version, ", only 1 to 3 are known");
  const std::size_t lengthSize = version == 1 ? 2 : 4, lengthAt = versionAt + 2;
  if (bytes.size() < lengthAt + lengthSize) cutOff();
  std::size_t length = 0;
  for (std::size_t i = 0; i < lengthSize; ++i)
    length |= std::size_t(static_cast<unsigned char>(bytes[lengthAt + i])) << (8 * i);
  bytes.remove_prefix(lengthAt + lengthSize);
  if (length > bytes.size()) cutOff();
  const Header header = HeaderText(bytes.substr(0, length), path).read();
  bytes.remove_prefix(length);

  if (header.type != "<f8" && header.type != "<f4")
    refuse(path, ": this .npy file holds numbers of the type ", shown(header.type),
           ": save them as float64 (little-endian)");
  if (header.dimensions != 2)
    refuse(path, ": this .npy file holds an array of ", header.dimensions,
           " dimensions, not a matrix");
  if (header.rows == 0 || header.columns == 0) refuse(path, ": this .npy file holds no numbers");
  const std::size_t scalar = header.type == "<f8" ? 8 : 4, count = bytes.size() / scalar;
  const bool isExact = bytes.size() % scalar == 0 && count % header.rows == 0 &&
                       count / header.rows == header.columns;
  if (!isExact)
    refuse(path, ": this .npy file says that it holds ", header.rows, " by ", header.columns,
           " numbers, but has ", bytes.size(), " bytes of them");
  return scalar == 8 ? values<double>(bytes, header) : values<float>(bytes, header);
}

}  // namespace palpate::imported
