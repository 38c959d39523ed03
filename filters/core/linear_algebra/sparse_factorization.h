// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <memory>
#include <stdexcept>
#include <vector>

namespace palpate {

/// A sparse symmetric matrix as a list of entries on or below its diagonal; those of one place add
/// up.
struct SymmetricEntries {
  int size = 0;
  std::vector<int> row, column;  ///< from 0, row >= column
  std::vector<double> value;

  void add(int i, int j, double entry) {
    row.push_back(i > j ? i : j);
    column.push_back(i > j ? j : i);
    value.push_back(entry);
  }
};

/// A matrix is singular, or not definite where it should be, as far as rounding lets one see.
struct SingularSystem : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Multifrontal factorisation of a sparse symmetric matrix
///     [ A  B^T ]
///     [ B  D   ]
/// in which the last rows are kept: of these it gives the Schur complement D - B A^-1 B^T (MUMPS;
/// Amestoy, Duff, L'Excellent and Koster, SIAM J. Matrix Anal. Appl. 23(1), 2001). Without any it
/// solves A x = b. The library is loaded when it is first used.
class SparseFactorization {
 public:
  /// @param matrix    taken over.
  /// @param kept      how many of the last rows are kept, 0 for none.
  /// @param definite  A is positive definite; else it may be indefinite and is pivoted.
  /// @throws SingularSystem (of definite ones beside kept rows the library does not tell);
  ///         std::runtime_error if the library is missing; std::bad_alloc.
  SparseFactorization(SymmetricEntries matrix, int kept, bool definite);
  ~SparseFactorization();

  /// kept by kept, m: full and symmetric.
  const Eigen::MatrixXd& schurComplement() const { return schur_; }

  /// Replaces right-hand sides by solutions. Only where no row is kept. Not for several threads.
  /// @param columns  size by any.
  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const;

  /// Columns of the inverse, in about half the time, as a column of the identity has one entry.
  /// Only where no row is kept. Not for several threads.
  /// @param rows  of the ones; -1 for a column of zeros.
  /// @param out   size by #rows.
  void solveUnits(const std::vector<int>& rows, Eigen::Ref<Eigen::MatrixXd> out) const;

  /// Of A, as the library counts them.
  int negativePivots() const;
  /// Held by the library at its peak, besides the Schur complement.
  std::size_t peakBytes() const;

  /// True where the program was built with the library.
  static bool isAvailable();

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
  Eigen::MatrixXd schur_;
};

}  // namespace palpate
