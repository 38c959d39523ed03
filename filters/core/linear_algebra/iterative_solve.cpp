// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/iterative_solve.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <Eigen/Jacobi>
#include <Eigen/LU>
#include <sstream>
#include <stdexcept>

#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

using Matrix = Eigen::MatrixXd;
using Strided = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>;

constexpr int kTogether = 64;  ///< right-hand sides whose products are formed at a time

/// The inverses of the diagonal blocks.
class BlockJacobi {
 public:
  BlockJacobi(const double* matrix, int stride, const std::vector<int>& rows) : rows_(rows) {
    for (std::size_t b = 0; 3 * b < rows.size(); ++b) {
      Eigen::Matrix3d block;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          block(i, j) = matrix[(3 * b + j) * std::size_t(stride) + rows[3 * b + i]];
      bool isRegular = false;
      Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
      block.computeInverseWithCheck(inverse, isRegular, 0);
      if (!isRegular || !inverse.allFinite())
        throw std::runtime_error("the diagonal block of unknown " + std::to_string(b) +
                                 " is singular: use the direct solver");
      inverses_.push_back(inverse);
    }
  }

  /// From residuals, by rows, to unknowns, by columns.
  void apply(const Matrix& residual, Matrix& out) const {
    out.resize(residual.rows(), residual.cols());
    for (Eigen::Index c = 0; c < residual.cols(); ++c)
      for (std::size_t b = 0; b < inverses_.size(); ++b)
        out.col(c).segment<3>(3 * b) =
            inverses_[b] * Eigen::Vector3d(residual(rows_[3 * b], c), residual(rows_[3 * b + 1], c),
                                           residual(rows_[3 * b + 2], c));
  }

 private:
  const std::vector<int>& rows_;
  std::vector<Eigen::Matrix3d> inverses_;
};

/// The small least-squares problem of one right-hand side, kept triangular by rotations.
class Hessenberg {
 public:
  Hessenberg(int most, double residual)
      : matrix_(Matrix::Zero(most + 1, most)), right_(Eigen::VectorXd::Zero(most + 1)) {
    right_[0] = residual;
  }
  /// @param column  inner products with all directions so far, and the new one's length.
  /// @return the residual that is left.
  double append(Eigen::VectorXd column) {
    const int k = count_++;
    for (int i = 0; i < k; ++i) column.applyOnTheLeft(i, i + 1, rotations_[i].adjoint());
    rotations_.emplace_back();
    rotations_.back().makeGivens(column[k], column[k + 1], &column[k]);
    column[k + 1] = 0;
    matrix_.col(k).head(k + 2) = column;
    right_.applyOnTheLeft(k, k + 1, rotations_.back().adjoint());
    return std::abs(right_[count_]);
  }
  Eigen::VectorXd solution() const {
    Eigen::VectorXd y = right_.head(count_);
    for (int i = count_ - 1; i >= 0; --i) {
      for (int j = i + 1; j < count_; ++j) y[i] -= matrix_(i, j) * y[j];
      y[i] = matrix_(i, i) != 0 ? y[i] / matrix_(i, i) : 0;  // a right-hand side that was solved
    }
    return y;
  }

 private:
  Matrix matrix_;
  Eigen::VectorXd right_;
  std::vector<Eigen::JacobiRotation<double>> rotations_;
  int count_ = 0;
};

/// Several right-hand sides in step.
class Gmres {
 public:
  Gmres(const AlignedBuffer<double>& matrix, int size, int stride, const BlockJacobi& blocks,
        const IterativeSettings& settings)
      : matrix_(matrix), size_(size), stride_(stride), blocks_(blocks), settings_(settings) {}

  /// @return the largest relative residual.
  /// @param report  called after each product.
  template <class Report>
  double solve(Eigen::Ref<Matrix, 0, Eigen::OuterStride<>> right, const Report& report) {
    const Eigen::ArrayXd norms =
        right.colwise().norm().transpose().array().max(std::numeric_limits<double>::min());
    solution_ = Matrix::Zero(size_, right.cols());
    residual_ = right;
    products_ = 0;
    while (true) {
      const double left = (residual_.colwise().norm().transpose().array() / norms).maxCoeff();
      if (left <= settings_.tolerance || products_ >= settings_.mostProducts ||
          !std::isfinite(left)) {
        right = solution_;
        return left;
      }
      cycle(norms, report);
      residual_ = right;
      multiply(-1, solution_, 1, residual_);
    }
  }

  int products() const { return products_; }
  std::size_t bytes() const {
    return sizeof(double) * size_ * solution_.cols() * (settings_.restart + 4);
  }

 private:
  void multiply(double factor, const Matrix& x, double keep, Matrix& out) const {
    lapack::gemm(false, size_, static_cast<int>(x.cols()), size_, factor, matrix_.data(), stride_,
                 x.data(), size_, keep, out.data(), size_);
  }

  /// New directions until all have converged or there are too many, then their best combination.
  template <class Report>
  void cycle(const Eigen::ArrayXd& norms, const Report& report) {
    const Eigen::Index width = residual_.cols();
    std::vector<Hessenberg> problems;
    directions_.assign(1, residual_);
    for (Eigen::Index c = 0; c < width; ++c) {
      problems.emplace_back(settings_.restart, residual_.col(c).norm());
      normalise(directions_[0], c);
    }
    int count = 0;
    for (double left = 1; count < settings_.restart && products_ < settings_.mostProducts &&
                          left > 0.5 * settings_.tolerance;) {
      blocks_.apply(directions_[count], unknowns_);
      directions_.emplace_back(size_, width);
      Matrix& next = directions_.back();
      multiply(1, unknowns_, 0, next);
      ++products_;
      ++count;
      left = 0;
      for (Eigen::Index c = 0; c < width; ++c)
        left = std::max(left, problems[c].append(orthogonalise(next, c, count)) / norms[c]);
      report(left);
    }
    Matrix combination = Matrix::Zero(size_, width);
    for (Eigen::Index c = 0; c < width; ++c) {
      const Eigen::VectorXd y = problems[c].solution();
      for (int i = 0; i < count; ++i) combination.col(c) += y[i] * directions_[i].col(c);
    }
    blocks_.apply(combination, unknowns_);
    solution_ += unknowns_;
  }

  static double normalise(Matrix& directions, Eigen::Index c) {
    const double length = directions.col(c).norm();
    if (length > 0) directions.col(c) /= length;
    return length;
  }

  /// By Gram and Schmidt, one direction after the other. @return the inner products and the length.
  Eigen::VectorXd orthogonalise(Matrix& next, Eigen::Index c, int count) const {
    Eigen::VectorXd column(count + 1);
    for (int i = 0; i < count; ++i) {
      column[i] = directions_[i].col(c).dot(next.col(c));
      next.col(c) -= column[i] * directions_[i].col(c);
    }
    column[count] = normalise(next, c);
    return column;
  }

  const AlignedBuffer<double>& matrix_;
  int size_, stride_;
  const BlockJacobi& blocks_;
  const IterativeSettings& settings_;
  Matrix solution_, residual_, unknowns_;
  std::vector<Matrix> directions_;
  int products_ = 0;
};

}  // namespace

SolveReport solveIterativeInPlace(const AlignedBuffer<double>& matrix, int size, int stride,
                                  const std::vector<int>& blockRows, AlignedBuffer<double>& right,
                                  int columns, const IterativeSettings& settings,
                                  const Progress& progress) {
  const BlockJacobi blocks(matrix.data(), stride, blockRows);
  SolveReport report{-1, 0};
  for (int first = 0; first < columns; first += kTogether) {
    const int width = std::min(kTogether, columns - first);
    const Progress part = progress.part(double(first) / columns, double(first + width) / columns);
    part.report(0, "solve");
    Strided block(right.data() + std::size_t(first) * stride, size, width,
                  Eigen::OuterStride<>(stride));
    Gmres gmres(matrix, size, stride, blocks, settings);
    const double left = gmres.solve(block, [&](double residual) {
      part.report(std::clamp(std::log(residual) / std::log(settings.tolerance), 0.0, 1.0), "solve");
    });
    if (!(left <= settings.tolerance)) {
      std::ostringstream text;
      text << "the iterative solver is left with a residual of " << left << ", above "
           << settings.tolerance << ", after " << gmres.products()
           << " products: the system is too ill-conditioned for it, use the direct solver";
      throw std::runtime_error(text.str());
    }
    report.residual = std::max(report.residual, left);
    report.refinementSteps = std::max(report.refinementSteps, gmres.products());
    report.peakBytes = std::max(report.peakBytes, gmres.bytes());
  }
  report.peakBytes += matrix.bytes() + right.bytes();
  return report;
}

}  // namespace palpate
