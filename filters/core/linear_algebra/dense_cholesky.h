// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "progress.h"

namespace palpate {

/// Cholesky's factorisation A = L L^T of a large dense symmetric matrix in place, by blocks of
/// columns (LAPACK on each block, BLAS 3 on the rest), so that it can report progress and be
/// aborted.
/// @param matrix  size by size, column-major without gaps; its lower triangle is read and
///                overwritten with L, the rest is left alone.
/// @return 0, or the order, from 1, of the first leading minor that is not positive; what has been
///         overwritten is lost.
/// @throws Aborted.
int factorCholesky(double* matrix, int size, const Progress& progress);

/// Replaces L by the inverse of L L^T, of which the lower triangle is given, in as many operations
/// as LAPACK's potri takes. Above the diagonal, values are undefined.
/// @throws Aborted.
void invertCholesky(double* factor, int size, const Progress& progress);

}  // namespace palpate
