// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/stiffness_modes.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <vector>

#include "sentence.h"

namespace palpate {
namespace {

constexpr int kLeastLandmarks = 400, kLandmarksAMode = 4;
constexpr double kRounding = 1e-10;

/// Points each of which is farthest from those before.
std::vector<int> spreadOut(const Eigen::Matrix3Xd& points, int count) {
  std::vector<int> chosen{0};
  Eigen::VectorXd distance = (points.colwise() - points.col(0)).colwise().squaredNorm();
  while (int(chosen.size()) < count) {
    Eigen::Index farthest;
    distance.maxCoeff(&farthest);
    chosen.push_back(static_cast<int>(farthest));
    distance = distance.cwiseMin(
        (points.colwise() - points.col(farthest)).colwise().squaredNorm().transpose());
  }
  return chosen;
}

}  // namespace

Eigen::MatrixXd stiffnessModes(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& volumes,
                               double length, int count) {
  if (!(length > 0) || !std::isfinite(length))
    refuse("the length over which stiffness varies must be positive, not ", length);
  const double cell = std::cbrt(volumes.mean());
  if (length < cell)
    refuse("the length over which stiffness varies, ", shortly(length),
           " m, is below the size of the tetrahedra, ", shortly(cell), " m: give more of them");
  if (count < 1) refuse("a field takes at least one mode, not ", count);
  const int cells = static_cast<int>(centres.cols());
  const std::vector<int> landmarks =
      spreadOut(centres, std::min(cells, std::max(kLeastLandmarks, kLandmarksAMode * count)));
  Eigen::MatrixXd correlation(cells, landmarks.size());
  for (std::size_t k = 0; k < landmarks.size(); ++k)
    correlation.col(k) = (-(centres.colwise() - centres.col(landmarks[k])).colwise().squaredNorm() /
                          (2 * length * length))
                             .array()
                             .exp()
                             .transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> among(
      correlation(landmarks, Eigen::all).eval());
  const Eigen::VectorXd& values = among.eigenvalues();
  const Eigen::Index kept = (values.array() > kRounding * values.tail<1>()[0]).count();
  const Eigen::MatrixXd features =
      correlation * (among.eigenvectors().rightCols(kept) *
                     values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> leading(
      (features.transpose() * volumes.asDiagonal() * features).eval());
  const Eigen::Index modes = std::min<Eigen::Index>(count, kept);
  return features * leading.eigenvectors().rightCols(modes).rowwise().reverse();
}

}  // namespace palpate
