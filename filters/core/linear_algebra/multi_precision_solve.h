// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "linear_algebra/aligned_buffer.h"
#include "progress.h"

namespace palpate {

/// How a dense solve went.
struct SolveReport {
  double conditionEstimate;  ///< 1-norm
  double residual;  ///< |A x - b| / (|A| |x| + |b|) of a sampled right-hand side, Frobenius
  int refinementSteps = 0;
  std::size_t peakBytes = 0;
};

/// Solves A X = B for many right-hand sides in the precision of the buffers, overwriting both: LU
/// with partial pivoting, right-hand sides in blocks.
/// @param matrix, right  size by size, size by columns, column-major.
/// @param stride         from column to column of both.
template <class Scalar>
SolveReport solveInPlace(AlignedBuffer<Scalar>& matrix, int size, int stride,
                         AlignedBuffer<Scalar>& right, int columns, const Progress& progress);

/// The same with a float factorisation and iterative refinement in double, block by block, until
/// the next correction would be below 1e-11 of the solution. `matrix` is kept.
/// @throws std::runtime_error if refinement does not converge (condition beyond about 1e6).
SolveReport solveMixedInPlace(const AlignedBuffer<double>& matrix, int size, int stride,
                              AlignedBuffer<double>& right, int columns, const Progress& progress);

extern template SolveReport solveInPlace(AlignedBuffer<double>&, int, int, AlignedBuffer<double>&,
                                         int, const Progress&);
extern template SolveReport solveInPlace(AlignedBuffer<float>&, int, int, AlignedBuffer<float>&,
                                         int, const Progress&);

}  // namespace palpate
