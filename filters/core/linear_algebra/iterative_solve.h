// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "linear_algebra/multi_precision_solve.h"

namespace palpate {

struct IterativeSettings {
  double tolerance = 1e-9;  ///< of |A x - b| / |b|, of every right-hand side
  int restart = 60;         ///< directions that are kept
  int mostProducts = 600;   ///< of the matrix with each right-hand side
};

/// Solves A X = B for few right-hand sides, overwriting B: restarted GMRES (Y. Saad, M. H. Schultz,
/// SIAM J. Sci. Stat. Comput. 7, 1986), preconditioned from the right by the inverses of the 3 by 3
/// blocks of A that belong together. Each right-hand side has directions of its own, but the matrix
/// is multiplied with many at a time, at the rate of matrix products (solvers of one right-hand
/// side at a time, as Eigen's, read all of A for each). It costs 2 size^2 #columns #products,
/// against 2/3 size^3 of a factorisation.
/// @param matrix     size by size, column-major; kept.
/// @param stride     from column to column of both.
/// @param blockRows  size: the rows that go with the columns, three after three.
/// @return the report's residual is the largest |A x - b| / |b|, computed afresh at the end;
///         refinementSteps are the products; there is no estimate of the condition (-1).
/// @throws std::runtime_error if that many products do not reach the tolerance, or a block is
///         singular; Aborted.
SolveReport solveIterativeInPlace(const AlignedBuffer<double>& matrix, int size, int stride,
                                  const std::vector<int>& blockRows, AlignedBuffer<double>& right,
                                  int columns, const IterativeSettings& settings,
                                  const Progress& progress);

}  // namespace palpate
