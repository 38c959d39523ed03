// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "progress.h"

namespace palpate {

/// LU factorisation with partial pivoting of a large dense matrix, in place, by blocks of columns
/// (LAPACK on each block, BLAS 3 on the rest), so that it can report progress and be aborted.
/// The matrix's memory must outlive the object.
template <class Scalar>
class DenseLu {
 public:
  /// @param matrix  size by size, column-major; overwritten with the factors.
  /// @param stride  from one column to the next, at least `size`.
  /// @throws std::runtime_error if a pivot is exactly zero; Aborted.
  DenseLu(Scalar* matrix, int size, int stride, const Progress& progress);

  /// Solves A x = b in place.
  /// @param right   size by #columns, column-major.
  /// @param stride  from one right-hand side to the next.
  void solve(Scalar* right, int columns, int stride) const;

  /// LAPACK's estimate of the 1-norm condition number (infinite where it overflows).
  double conditionEstimate() const;

 private:
  Scalar* matrix_;
  int size_, stride_;
  std::vector<int> pivots_;
  Scalar norm_ = 0;
};

extern template class DenseLu<double>;
extern template class DenseLu<float>;

/// Sets the number of threads that BLAS uses while it lives; the setting is the process's.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int before_;
};

}  // namespace palpate
