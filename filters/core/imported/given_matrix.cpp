// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/given_matrix.h"

#include <algorithm>
#include <cmath>

#include "sentence.h"

namespace palpate {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kLargest = 1e100;  // of an entry in any unit; its square is finite

/// Both triangles, by columns, each place once.
void completeTriangles(std::vector<GivenMatrix::Entry>& entries) {
  const std::size_t count = entries.size();
  for (std::size_t i = 0; i < count; ++i)
    if (entries[i].row() != entries[i].col())
      entries.emplace_back(entries[i].col(), entries[i].row(), entries[i].value());
}

}  // namespace

GivenMatrix::GivenMatrix(Eigen::MatrixXd values, std::string format, const std::string& name)
    : format_(std::move(format)) {
  if (values.rows() != values.cols())
    refuse(name, ": the matrix is ", values.rows(), " by ", values.cols(),
           ", but compliances and stiffnesses are square");
  if (values.size() == 0) refuse(name, ": the matrix is empty");
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      if (!(std::abs(values(i, j)) <= kLargest))
        refuse(name, ": the entry in row ", i + 1, " and column ", j + 1, " is ", values(i, j),
               ", which is no number of any unit");
  values_ = std::move(values);
}

GivenMatrix::GivenMatrix(int size, std::vector<Entry> entries, bool symmetric, std::string format,
                         const std::string& name)
    : format_(std::move(format)) {
  for (const Entry& entry : entries)
    if (!(std::abs(entry.value()) <= kLargest))
      refuse(name, ": the entry in row ", entry.row() + 1, " and column ", entry.col() + 1, " is ",
             entry.value(), ", which is no number of any unit");
  if (symmetric) completeTriangles(entries);
  const auto place = [](const Entry& e) { return std::pair(e.col(), e.row()); };
  std::sort(entries.begin(), entries.end(),
            [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (place(entries[i - 1]) == place(entries[i]))
      refuse(name, ": the entry in row ", entries[i].row() + 1, " and column ",
             entries[i].col() + 1, " is given twice",
             symmetric ? ", which the symmetric one may stand for alone" : "");
  Sparse values(size, size);
  values.setFromTriplets(entries.begin(), entries.end());
  values_ = std::move(values);
}

int GivenMatrix::size() const {
  return static_cast<int>(
      std::visit([](const auto& values) { return Eigen::Index(values.rows()); }, values_));
}

std::size_t GivenMatrix::bytes() const {
  if (const auto* sparse = std::get_if<Sparse>(&values_))
    return sparse->nonZeros() * (sizeof(double) + sizeof(int));
  return std::get<Eigen::MatrixXd>(values_).size() * sizeof(double);
}

Eigen::MatrixXd GivenMatrix::block(const std::vector<int>& rows,
                                   const std::vector<int>& columns) const {
  if (const auto* dense = std::get_if<Eigen::MatrixXd>(&values_)) return (*dense)(rows, columns);
  const Sparse& sparse = std::get<Sparse>(values_);
  std::vector<int> place(size(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int>(i);
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(rows.size(), columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (Sparse::InnerIterator entry(sparse, columns[j]); entry; ++entry)
      if (place[entry.row()] >= 0) part(place[entry.row()], j) = entry.value();
  return part;
}

Eigen::MatrixXd GivenMatrix::times(const Eigen::MatrixXd& columns) const {
  return std::visit([&](const auto& values) -> Eigen::MatrixXd { return values * columns; },
                    values_);
}

double GivenMatrix::asymmetry() const {
  double all = 0, antisymmetric = 0;
  if (const auto* dense = std::get_if<Eigen::MatrixXd>(&values_)) {
    constexpr Eigen::Index tile = 64;  // both triangles of a tile stay in cache
    for (Eigen::Index j = 0; j < dense->cols(); j += tile)
      for (Eigen::Index i = 0; i < dense->rows(); i += tile) {
        const Eigen::Index rows = std::min(tile, dense->rows() - i),
                           columns = std::min(tile, dense->cols() - j);
        const auto here = dense->block(i, j, rows, columns);
        all += here.squaredNorm();
        antisymmetric += (here - dense->block(j, i, columns, rows).transpose()).squaredNorm();
      }
  } else {
    const Sparse& sparse = std::get<Sparse>(values_);
    const Sparse transposed = sparse.transpose();
    all = sparse.squaredNorm();
    antisymmetric = Sparse(sparse - transposed).squaredNorm();
  }
  return all > 0 ? std::sqrt(antisymmetric / all) : 0;
}

std::vector<RowContent> GivenMatrix::rowContents() const {
  std::vector<RowContent> contents(size(), RowContent::Nothing);
  const auto note = [&](Eigen::Index row, Eigen::Index column, double value) {
    if (value != 0)
      contents[row] =
          std::max(contents[row], row == column ? RowContent::DiagonalAlone : RowContent::Coupling);
  };
  if (const auto* dense = std::get_if<Eigen::MatrixXd>(&values_)) {
    for (Eigen::Index j = 0; j < dense->cols(); ++j)
      for (Eigen::Index i = 0; i < dense->rows(); ++i) note(i, j, (*dense)(i, j));
    return contents;
  }
  const Sparse& sparse = std::get<Sparse>(values_);
  for (int j = 0; j < size(); ++j)
    for (Sparse::InnerIterator entry(sparse, j); entry; ++entry)
      note(entry.row(), j, entry.value());
  return contents;
}

Eigen::SparseMatrix<double> GivenMatrix::symmetricLower() const {
  const Sparse sparse = isSparse() ? std::get<Sparse>(values_)
                                   : Sparse(std::get<Eigen::MatrixXd>(values_).sparseView());
  const Sparse transposed = sparse.transpose();
  return Sparse((sparse + transposed) / 2).triangularView<Eigen::Lower>();
}

}  // namespace palpate
