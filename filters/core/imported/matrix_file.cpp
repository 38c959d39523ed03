// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/matrix_file.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "imported/bulk_data.h"
#include "imported/harwell_boeing.h"
#include "imported/matrix_market.h"
#include "imported/numpy_file.h"
#include "text_lines.h"

namespace palpate {
namespace {

using namespace imported;

/// A table of numbers, a row a line.
Eigen::MatrixXd readTable(std::string_view bytes, const std::string& path) {
  TextLines lines(bytes, path);
  std::vector<double> values;
  std::size_t columns = 0, rows = 0;
  bool hadHeading = false;
  char separator = ' ';
  while (lines.nextWith('#')) {
    if (columns == 0) separator = separatorOf(lines.line());
    const std::vector<std::string_view> words = wordsOf(lines.line(), separator);
    if (columns == 0 && !hadHeading) {
      hadHeading = std::none_of(words.begin(), words.end(),
                                [](std::string_view word) { return numberOf(word).has_value(); });
      if (hadHeading) continue;
    }
    if (columns == 0) columns = words.size();
    if (words.size() != columns)
      lines.refuse("there are ", words.size(), " numbers, not ", columns, " as in the first row");
    for (std::string_view word : words) values.push_back(lines.number(word));
    ++rows;
  }
  if (values.empty()) refuse(path, ": there are no numbers in this file");
  return Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), rows, columns);
}

/// Binary files that are no NumPy arrays, such as Ansys' .sub and .full or NASTRAN's .op2 and .op4.
void refuseBinary(std::string_view bytes, const std::string& path) {
  if (bytes.find('\0') != bytes.npos)
    refuse(
        path,
        ": this is a binary file of a kind that is not read: have Ansys write the superelement's "
        "matrix as text (of .sub and .full files, HBMAT with its mapping file), NASTRAN punch "
        "DMIG cards (.pch), or save the matrix as a NumPy .npy or Matrix Market file");
}

GivenMatrix readByContent(std::string_view bytes, const std::string& path,
                          const std::string& name) {
  if (isNumpy(bytes)) return GivenMatrix(readNumpy(bytes, path), "NumPy", path);
  if (isMatrixMarket(bytes)) return readMatrixMarket(bytes, path);
  if (hasCard(bytes, "DMIG")) return readDmig(bytes, path, name);
  if (isHarwellBoeing(bytes)) return readHarwellBoeing(bytes, path);
  refuseBinary(bytes, path);
  return GivenMatrix(readTable(bytes, path), "text", path);
}

}  // namespace

GivenMatrix readMatrixFile(const std::string& path, const MatrixFileOptions& options) {
  GivenMatrix matrix = readByContent(readBytes(path), path, options.name);
  if (!options.name.empty() && matrix.dofs.empty())
    refuse(path, ": only matrices of DMIG cards have names, such as ", shown(options.name));
  if (options.mapping.empty()) return matrix;
  if (!matrix.dofs.empty())
    refuse(path, ": DMIG cards say themselves what their rows are: leave the mapping file out");
  matrix.dofs = readMapping(readBytes(options.mapping), matrix.size(), options.mapping);
  return matrix;
}

NodeTable readNodeFile(const std::string& path) {
  const std::string bytes = readBytes(path);
  if (isNumpy(bytes)) return nodesOf(readNumpy(bytes, path), path);
  if (hasCard(bytes, "GRID")) return readGridPoints(bytes, path);
  refuseBinary(bytes, path);
  return nodesOf(readTable(bytes, path), path);
}

NodeTable nodesOf(const Eigen::MatrixXd& table, const std::string& name) {
  constexpr double mostNode = 9007199254740992;  // doubles count up to it
  if (table.cols() != 3 && table.cols() != 4)
    refuse(name, ": nodes are given by x, y and z, or by number, x, y and z, not by ", table.cols(),
           " columns");
  if (!table.allFinite()) refuse(name, ": a node's place is not finite");
  NodeTable nodes;
  nodes.points = table.rightCols<3>().transpose();
  if (table.cols() == 3) return nodes;
  std::set<std::int64_t> seen;
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const double number = table(i, 0);
    if (!(number >= 1 && number <= mostNode && number == std::floor(number)))
      refuse(name, ": a node's number must be a positive whole one, not ", number);
    nodes.numbers.push_back(static_cast<std::int64_t>(number));
    if (!seen.insert(nodes.numbers.back()).second)
      refuse(name, ": node ", nodes.numbers.back(), " is given twice");
  }
  return nodes;
}

}  // namespace palpate
