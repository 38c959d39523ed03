// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/dense_lu.h"

#include <algorithm>
#include <Eigen/Core>
#include <limits>
#include <stdexcept>
#include <string>

#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

constexpr int kBlock = 256;

template <class Scalar>
Scalar oneNorm(const Scalar* matrix, int size, int stride) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Strided = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;
  return Strided(matrix, size, size, Eigen::OuterStride<>(stride))
      .cwiseAbs()
      .colwise()
      .sum()
      .maxCoeff();
}

}  // namespace

template <class Scalar>
DenseLu<Scalar>::DenseLu(Scalar* matrix, int size, int stride, const Progress& progress)
    : matrix_(matrix),
      size_(size),
      stride_(stride),
      pivots_(size),
      norm_(oneNorm(matrix, size, stride)) {
  const double allWork = double(size) * size * size;
  for (int k = 0; k < size; k += kBlock) {
    const int width = std::min(kBlock, size - k), rest = size - k - width;
    Scalar* diagonal = matrix + k + std::size_t(k) * stride;
    const int zeroPivot = lapack::getrf(size - k, width, diagonal, stride, &pivots_[k]);
    if (zeroPivot > 0)
      throw std::runtime_error("the system matrix is singular: pivot " +
                               std::to_string(k + zeroPivot - 1) + " is zero");
    for (int i = k; i < k + width; ++i) pivots_[i] += k;
    lapack::laswp(k, matrix, stride, k + 1, k + width, pivots_.data());
    if (rest > 0) {
      Scalar* right = matrix + std::size_t(k + width) * stride;
      lapack::laswp(rest, right, stride, k + 1, k + width, pivots_.data());
      lapack::trsmLeft(/*lower=*/true, width, rest, diagonal, stride, right + k, stride);
      lapack::gemm(false, rest, rest, width, Scalar(-1), diagonal + width, stride, right + k,
                   stride, Scalar(1), right + k + width, stride);
    }
    progress.report(1 - double(rest) * rest * rest / allWork, "factor");
  }
}

template <class Scalar>
void DenseLu<Scalar>::solve(Scalar* right, int columns, int stride) const {
  lapack::laswp(columns, right, stride, 1, size_, pivots_.data());
  lapack::trsmLeft(/*lower=*/true, size_, columns, matrix_, stride_, right, stride);
  lapack::trsmLeft(/*lower=*/false, size_, columns, matrix_, stride_, right, stride);
}

template <class Scalar>
double DenseLu<Scalar>::conditionEstimate() const {
  const double reciprocal = lapack::gecon(size_, matrix_, stride_, norm_);
  return reciprocal > 0 ? 1 / reciprocal : std::numeric_limits<double>::infinity();
}

template class DenseLu<double>;
template class DenseLu<float>;

BlasThreads::BlasThreads(int threads) : before_(lapack::blasThreads()) {
  lapack::setBlasThreads(threads);
}
BlasThreads::~BlasThreads() {
  lapack::setBlasThreads(before_);
}

}  // namespace palpate
