// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/multi_precision_solve.h"

#include <algorithm>
#include <Eigen/Core>
#include <stdexcept>

#include "linear_algebra/dense_lu.h"
#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

constexpr int kRightBlock = 384;    ///< right-hand sides at a time
constexpr int kRefinedBlock = 128;  ///< the same with refinement, which copies them
constexpr double kFactorShare = 0.3;

template <class Scalar>
using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

template <class Scalar>
using Strided = Eigen::Map<Matrix<Scalar>, 0, Eigen::OuterStride<>>;

/// A few rows of A and entries of b, kept to measure the residual after both are overwritten.
template <class Scalar>
class ResidualSample {
 public:
  ResidualSample(Scalar* matrix, int size, int stride, const Scalar* right, int columns)
      : column_(columns / 2), stride_(stride) {
    const Strided<Scalar> a(matrix, size, size, Eigen::OuterStride<>(stride));
    const int count = std::min(size, 16);
    rows_.resize(count, size);
    right_.resize(count);
    for (int i = 0; i < count; ++i) {
      const int row = static_cast<int>((std::size_t(size) * (2 * i + 1)) / (2 * count));
      rows_.row(i) = a.row(row).template cast<double>();
      right_[i] = columns ? right[std::size_t(column_) * stride + row] : 0;
    }
  }

  double residual(const Scalar* solution, int columns) const {
    if (columns == 0) return 0;
    const Eigen::VectorXd x =
        Eigen::Map<const Vector<Scalar>>(solution + std::size_t(column_) * stride_, rows_.cols())
            .template cast<double>();
    return (rows_ * x - right_).norm() / (rows_.norm() * x.norm() + right_.norm());
  }

 private:
  int column_, stride_;
  Eigen::MatrixXd rows_;
  Eigen::VectorXd right_;
};

}  // namespace

template <class Scalar>
SolveReport solveInPlace(AlignedBuffer<Scalar>& matrix, int size, int stride,
                         AlignedBuffer<Scalar>& right, int columns, const Progress& progress) {
  const ResidualSample<Scalar> sample(matrix.data(), size, stride, right.data(), columns);
  const DenseLu<Scalar> lu(matrix.data(), size, stride, progress.part(0, kFactorShare));
  SolveReport report{lu.conditionEstimate(), 0};
  for (int first = 0; first < columns; first += kRightBlock) {
    progress.report(kFactorShare + (1 - kFactorShare) * first / columns, "solve");
    lu.solve(right.data() + std::size_t(first) * stride, std::min(kRightBlock, columns - first),
             stride);
  }
  report.residual = sample.residual(right.data(), columns);
  report.peakBytes = matrix.bytes() + right.bytes();
  return report;
}

SolveReport solveMixedInPlace(const AlignedBuffer<double>& matrix, int size, int stride,
                              AlignedBuffer<double>& right, int columns, const Progress& progress) {
  constexpr int mostSteps = 10;
  constexpr double smallestCorrection = 1e-11;
  const ResidualSample<double> sample(matrix.data(), size, stride, right.data(), columns);
  AlignedBuffer<float> factors(matrix.size());
  std::copy_n(matrix.data(), matrix.size(), factors.data());
  const DenseLu<float> lu(factors.data(), size, stride, progress.part(0, kFactorShare));
  SolveReport report{lu.conditionEstimate(), 0};

  Matrix<double> solution, residual;
  Matrix<float> correction;
  for (int first = 0; first < columns; first += kRefinedBlock) {
    progress.report(kFactorShare + (1 - kFactorShare) * first / columns, "solve");
    const int width = std::min(kRefinedBlock, columns - first);
    Strided<double> block(right.data() + std::size_t(first) * stride, size, width,
                          Eigen::OuterStride<>(stride));
    solution = Matrix<double>::Zero(size, width);
    residual = block;
    double before = 2;  // norm of the last correction over that of the solution
    for (int step = 0;; ++step) {
      correction = residual.cast<float>();
      lu.solve(correction.data(), width, size);
      solution += correction.cast<double>();
      const double norm = solution.norm();
      const double change = norm > 0 ? correction.cast<double>().norm() / norm : 0;
      report.refinementSteps = std::max(report.refinementSteps, step);
      // Corrections shrink by about the same factor each time: this bounds the next one.
      if (change * change / before < smallestCorrection) break;
      if (step == mostSteps || !(change < before))
        throw std::runtime_error(
            "refinement in double does not converge: the system is too ill-conditioned for mixed "
            "precision, use double");
      before = change;
      residual = block;
      lapack::gemm(false, size, width, size, -1.0, matrix.data(), stride, solution.data(), size,
                   1.0, residual.data(), size);
    }
    block = solution;
  }
  report.residual = sample.residual(right.data(), columns);
  report.peakBytes = matrix.bytes() + right.bytes() + factors.bytes() +
                     sizeof(double) * (solution.size() + residual.size()) +
                     sizeof(float) * correction.size();
  return report;
}

template SolveReport solveInPlace(AlignedBuffer<double>&, int, int, AlignedBuffer<double>&, int,
                                  const Progress&);
template SolveReport solveInPlace(AlignedBuffer<float>&, int, int, AlignedBuffer<float>&, int,
                                  const Progress&);

}  // namespace palpate
