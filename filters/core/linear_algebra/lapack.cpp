// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/lapack.h"

#include <cblas.h>

#include <vector>

extern "C" {
void dgetrf_(const int*, const int*, double*, const int*, int*, int*);
void sgetrf_(const int*, const int*, float*, const int*, int*, int*);
void dgetri_(const int*, double*, const int*, const int*, double*, const int*, int*);
void dpotrf_(const char*, const int*, double*, const int*, int*, std::size_t);
void dlaswp_(const int*, double*, const int*, const int*, const int*, const int*, const int*);
void slaswp_(const int*, float*, const int*, const int*, const int*, const int*, const int*);
void dgecon_(const char*, const int*, const double*, const int*, const double*, double*, double*,
             int*, int*, std::size_t);
void sgecon_(const char*, const int*, const float*, const int*, const float*, float*, float*, int*,
             int*, std::size_t);
}

namespace palpate::lapack {

int getrf(int m, int n, double* a, int lda, int* pivots) {
  int info = 0;
  dgetrf_(&m, &n, a, &lda, pivots, &info);
  return info;
}
int getrf(int m, int n, float* a, int lda, int* pivots) {
  int info = 0;
  sgetrf_(&m, &n, a, &lda, pivots, &info);
  return info;
}

int getri(int n, double* lu, int ldlu, const int* pivots, double* work, int workSize) {
  int info = 0;
  dgetri_(&n, lu, &ldlu, pivots, work, &workSize, &info);
  return info;
}

int potrf(int n, double* a, int lda) {
  int info = 0;
  dpotrf_("L", &n, a, &lda, &info, 1);
  return info;
}

void trsmLower(bool transposed, int m, int n, const double* l, int ldl, double* b, int ldb) {
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transposed ? CblasTrans : CblasNoTrans,
              CblasNonUnit, m, n, 1, l, ldl, b, ldb);
}

void trsmLowerRight(int m, int n, const double* l, int ldl, double* b, int ldb) {
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m, n, 1, l, ldl, b,
              ldb);
}

void subtractSquare(bool transposed, int n, int k, const double* a, int lda, double* c, int ldc) {
  cblas_dsyrk(CblasColMajor, CblasLower, transposed ? CblasTrans : CblasNoTrans, n, k, -1, a, lda,
              1, c, ldc);
}

void laswp(int n, double* a, int lda, int first, int last, const int* pivots) {
  const int step = 1;
  dlaswp_(&n, a, &lda, &first, &last, pivots, &step);
}
void laswp(int n, float* a, int lda, int first, int last, const int* pivots) {
  const int step = 1;
  slaswp_(&n, a, &lda, &first, &last, pivots, &step);
}

void trsmLeft(bool lower, int m, int n, const double* a, int lda, double* b, int ldb) {
  cblas_dtrsm(CblasColMajor, CblasLeft, lower ? CblasLower : CblasUpper, CblasNoTrans,
              lower ? CblasUnit : CblasNonUnit, m, n, 1, a, lda, b, ldb);
}
void trsmLeft(bool lower, int m, int n, const float* a, int lda, float* b, int ldb) {
  cblas_strsm(CblasColMajor, CblasLeft, lower ? CblasLower : CblasUpper, CblasNoTrans,
              lower ? CblasUnit : CblasNonUnit, m, n, 1, a, lda, b, ldb);
}

void gemm(bool transposeA, int m, int n, int k, double alpha, const double* a, int lda,
          const double* b, int ldb, double beta, double* c, int ldc) {
  cblas_dgemm(CblasColMajor, transposeA ? CblasTrans : CblasNoTrans, CblasNoTrans, m, n, k, alpha,
              a, lda, b, ldb, beta, c, ldc);
}
void gemm(bool transposeA, int m, int n, int k, float alpha, const float* a, int lda,
          const float* b, int ldb, float beta, float* c, int ldc) {
  cblas_sgemm(CblasColMajor, transposeA ? CblasTrans : CblasNoTrans, CblasNoTrans, m, n, k, alpha,
              a, lda, b, ldb, beta, c, ldc);
}

double gecon(int n, const double* lu, int ldlu, double norm) {
  std::vector<double> work(4 * std::size_t(n));
  std::vector<int> integers(n);
  double reciprocal = 0;
  int info = 0;
  dgecon_("1", &n, lu, &ldlu, &norm, &reciprocal, work.data(), integers.data(), &info, 1);
  return reciprocal;
}
double gecon(int n, const float* lu, int ldlu, float norm) {
  std::vector<float> work(4 * std::size_t(n));
  std::vector<int> integers(n);
  float reciprocal = 0;
  int info = 0;
  sgecon_("1", &n, lu, &ldlu, &norm, &reciprocal, work.data(), integers.data(), &info, 1);
  return reciprocal;
}

#if defined(OPENBLAS_VERSION)
int blasThreads() {
  return openblas_get_num_threads();
}
void setBlasThreads(int threads) {
  openblas_set_num_threads(threads);
}
#else
int blasThreads() {
  return 1;
}
void setBlasThreads(int) {}
#endif

}  // namespace palpate::lapack
