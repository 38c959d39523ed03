// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>

/// The few routines of BLAS and LAPACK that Palpate calls, overloaded for float and double.
/// Matrices are column-major.
namespace palpate::lapack {

/// Factors an m by n matrix; pivots are counted from 1. @return 0, or the first zero pivot from 1.
int getrf(int m, int n, double* a, int lda, int* pivots);
int getrf(int m, int n, float* a, int lda, int* pivots);

/// Inverts a matrix that getrf factored. @param work  workSize >= n numbers. @return 0 or the zero
/// pivot.
int getri(int n, double* lu, int ldlu, const int* pivots, double* work, int workSize);

/// Cholesky's L of a symmetric n by n matrix, of which the lower triangle is read and overwritten.
/// @return 0, or the order, from 1, of the first leading minor that is not positive.
int potrf(int n, double* a, int lda);

/// B := L^-1 B or L^-T B, for the lower triangle of an m by m matrix, its diagonal included, and m
/// by n B.
void trsmLower(bool transposed, int m, int n, const double* l, int ldl, double* b, int ldb);

/// B := B L^-T for such a triangle of an n by n matrix.
void trsmLowerRight(int m, int n, const double* l, int ldl, double* b, int ldb);

/// C := C - A^T A in the lower triangle of an n by n matrix, for k by n A, or C - A A^T for n by k
/// A.
void subtractSquare(bool transposed, int n, int k, const double* a, int lda, double* c, int ldc);

/// Applies the row interchanges first..last (from 1) of `pivots` to n columns.
void laswp(int n, double* a, int lda, int first, int last, const int* pivots);
void laswp(int n, float* a, int lda, int first, int last, const int* pivots);

/// B := L^-1 B (unit lower) or U^-1 B, for the triangle of an m by m matrix and m by n B.
void trsmLeft(bool lower, int m, int n, const double* a, int lda, double* b, int ldb);
void trsmLeft(bool lower, int m, int n, const float* a, int lda, float* b, int ldb);

/// C := alpha op(A) B + beta C; op(A) m by k, B k by n.
void gemm(bool transposeA, int m, int n, int k, double alpha, const double* a, int lda,
          const double* b, int ldb, double beta, double* c, int ldc);
void gemm(bool transposeA, int m, int n, int k, float alpha, const float* a, int lda,
          const float* b, int ldb, float beta, float* c, int ldc);

/// Reciprocal of the 1-norm condition number of a factored n by n matrix of 1-norm `norm`.
double gecon(int n, const double* lu, int ldlu, double norm);
double gecon(int n, const float* lu, int ldlu, float norm);

/// Threads of the BLAS library, where it can tell (else 1).
int blasThreads();
void setBlasThreads(int threads);

}  // namespace palpate::lapack
