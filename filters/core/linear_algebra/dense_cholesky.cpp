// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/dense_cholesky.h"

#include <algorithm>
#include <Eigen/Core>

#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

constexpr int kBlock = 256;

}  // namespace

int factorCholesky(double* matrix, int size, const Progress& progress) {
  const double allWork = double(size) * size * size;
  for (int k = 0; k < size; k += kBlock) {
    const int width = std::min(kBlock, size - k), rest = size - k - width;
    double* diagonal = matrix + k + std::size_t(k) * size;
    if (const int order = lapack::potrf(width, diagonal, size)) return k + order;
    if (rest > 0) {
      double* below = diagonal + width;
      lapack::trsmLowerRight(rest, width, diagonal, size, below, size);
      lapack::subtractSquare(false, rest, width, below, size, below + std::size_t(width) * size,
                             size);
    }
    progress.report(1 - double(rest) * rest * rest / allWork, "factor");
  }
  return 0;
}

void invertCholesky(double* factor, int size, const Progress& progress) {
  // Columns of the inverse from their first row on depend on L from that row on alone.
  const double allWork = double(size) * size * size;
  Eigen::MatrixXd columns;
  for (int k = 0; k < size; k += kBlock) {
    const int width = std::min(kBlock, size - k), rows = size - k;
    double* diagonal = factor + k + std::size_t(k) * size;
    columns = Eigen::MatrixXd::Identity(rows, width);
    lapack::trsmLower(false, rows, width, diagonal, size, columns.data(), rows);
    lapack::trsmLower(true, rows, width, diagonal, size, columns.data(), rows);
    Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>(diagonal, rows, width,
                                                         Eigen::OuterStride<>(size)) = columns;
    const double rest = rows - width;
    progress.report(1 - rest * rest * rest / allWork, "invert");
  }
}

}  // namespace palpate
