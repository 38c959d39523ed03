// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <variant>
#include <vector>

namespace palpate {

/// What a row and a column of a matrix belong to.
struct MatrixDof {
  std::int64_t node = 0;  ///< as the file numbers it
  int component = -1;     ///< 0..2 displacements, 3..5 rotations, -1 what is no motion of a node

  bool operator==(const MatrixDof& other) const {
    return node == other.node && component == other.component;
  }
};

/// Places of nodes, in the unit and frame of whoever wrote them.
struct NodeTable {
  std::vector<std::int64_t> numbers;  ///< empty where they have none but their order
  Eigen::Matrix3Xd points{3, 0};

  int count() const { return static_cast<int>(points.cols()); }
};

/// What a row of a matrix holds besides zeros.
enum class RowContent { Nothing, DiagonalAlone, Coupling };

/// A square matrix as somebody else made it, and what its rows are, where that is known.
class GivenMatrix {
 public:
  using Entry = Eigen::Triplet<double, int>;

  /// @param format  for people, e.g. "CSV".
  /// @throws std::invalid_argument for what is not square, empty or not finite; the sentence begins
  ///         with `name`.
  GivenMatrix(Eigen::MatrixXd values, std::string format, const std::string& name);

  /// @param entries    row and column from 0 to size - 1, finite; each place once.
  /// @param symmetric  those below the diagonal stand for those above, or the other way round.
  /// @throws std::invalid_argument naming a place that has two entries.
  GivenMatrix(int size, std::vector<Entry> entries, bool symmetric, std::string format,
              const std::string& name);

  int size() const;
  std::size_t bytes() const;
  bool isSparse() const { return values_.index() == 1; }
  const std::string& format() const { return format_; }

  /// The entries of some rows and columns.
  Eigen::MatrixXd block(const std::vector<int>& rows, const std::vector<int>& columns) const;
  /// This times some columns.
  Eigen::MatrixXd times(const Eigen::MatrixXd& columns) const;
  /// |M - M^T|_F / |M|_F, 0 for a matrix of zeros.
  double asymmetry() const;
  /// What there is in each row.
  std::vector<RowContent> rowContents() const;
  /// The lower triangle of (M + M^T) / 2 as a sparse matrix.
  Eigen::SparseMatrix<double> symmetricLower() const;

  std::vector<MatrixDof> dofs;  ///< #rows; empty where the file does not say
  NodeTable nodes;              ///< those the file gives

 private:
  std::variant<Eigen::MatrixXd, Eigen::SparseMatrix<double>> values_;
  std::string format_;
};

}  // namespace palpate
