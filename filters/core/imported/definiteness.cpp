// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/definiteness.h"

#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <limits>

#include "linear_algebra/dense_cholesky.h"

namespace palpate::imported {
namespace {

/// By power iteration, from below, to a few percent.
double largestEigenvalue(const Eigen::MatrixXd& symmetric) {
  constexpr int steps = 30;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(symmetric.rows());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 0.5 * std::sin(double(i));
  double largest = symmetric.diagonal().cwiseAbs().maxCoeff();
  for (int step = 0; step < steps; ++step) {
    const Eigen::VectorXd next = symmetric * x.normalized();
    if (!(next.norm() > 0)) break;
    largest = std::max(largest, next.norm());
    x = next;
  }
  return largest;
}

/// @return 0, or the row, from 1, where M + shift I is not positive definite.
int rowNotPositive(const Eigen::MatrixXd& symmetric, double shift, const Progress& progress) {
  Eigen::MatrixXd factor = symmetric;
  factor.diagonal().array() += shift;
  const int size = static_cast<int>(factor.rows());
  return factorCholesky(factor.data(), size, progress);
}

}  // namespace

int invertDefinite(Eigen::MatrixXd& matrix, const Progress& progress) {
  const int size = static_cast<int>(matrix.rows());
  for (int i = 0; i < size; ++i)
    if (!(matrix(i, i) > 0)) return i + 1;
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
  if (const int row = factorCholesky(matrix.data(), size, progress.part(0, 0.33))) return row;
  const double smallest = size * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < size; ++i)
    if (!(matrix(i, i) * matrix(i, i) > smallest)) return i + 1;
  invertCholesky(matrix.data(), size, progress.part(0.33, 1));
  matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
  matrix.triangularView<Eigen::StrictlyUpper>() = matrix.transpose();
  return 0;
}

Negativity negativity(const Eigen::MatrixXd& symmetric, double tolerance,
                      const Progress& progress) {
  const double largest = largestEigenvalue(symmetric);
  Negativity found;
  const auto isNegative = [&](double share) {
    const int row = rowNotPositive(symmetric, share * largest, progress);
    if (row > 0) found.row = row - 1;
    return row > 0;
  };
  if (!isNegative(tolerance)) return {};
  double below = tolerance, above = 10 * tolerance;
  for (; above < 10 && isNegative(above); above *= 10) below = above;
  while (above > 1.01 * below) {
    const double middle = std::sqrt(above * below);
    (isNegative(middle) ? below : above) = middle;
  }
  found.share = below;
  found.value = -below * largest;
  return found;
}

RigidMotions rigidMotions(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& points,
                          bool rotations) {
  const Eigen::Vector3d middle = points.rowwise().mean();
  const double size = std::max((points.colwise() - middle).colwise().norm().maxCoeff(),
                               std::numeric_limits<double>::min());
  const Eigen::MatrixXd motions =
      palpate::rigidMotions(points, middle, size).leftCols(rotations ? 6 : 3);
  // Motions are made orthogonal under the points' own stiffness; few points have fewer than six.
  const Eigen::VectorXd own = stiffness.diagonal().cwiseSqrt();
  const Eigen::BDCSVD<Eigen::MatrixXd> weighted(own.asDiagonal() * motions,
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
  constexpr double leastOfLargest = 1e-9;
  Eigen::Index rank = 0;
  const Eigen::VectorXd& values = weighted.singularValues();
  while (rank < values.size() && values[rank] > leastOfLargest * values[0]) ++rank;
  const Eigen::MatrixXd basis = own.cwiseInverse().asDiagonal() * weighted.matrixU().leftCols(rank);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> work(basis.transpose() *
                                                            (stiffness * basis));
  Eigen::Matrix<double, 6, 1> mixture = Eigen::Matrix<double, 6, 1>::Zero();
  mixture.head(motions.cols()) =
      weighted.matrixV().leftCols(rank) *
      values.head(rank).cwiseInverse().cwiseProduct(work.eigenvectors().col(0));
  mixture.normalize();
  mixture = (mixture.array().abs() < leastOfLargest).select(0, mixture);
  return {work.eigenvalues(), {work.eigenvalues()[0], mixture.head<3>(), mixture.tail<3>()}};
}

}  // namespace palpate::imported
