// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <vector>

#include "identification/measured_response.h"
#include "progress.h"

namespace palpate {

/// What a marker i sees of displacements u under its probe: a_i^T u, with the barycentric weights
/// of its triangle's free corners in a_i.
class MarkerRows {
 public:
  /// @param setup     outlives this.
  /// @param free      vertices, ascending.
  /// @param vertices  how many there are.
  MarkerRows(const MeasuredSetup& setup, const std::vector<int>& free, int vertices);

  /// @param displacements  3 #free by #probes.
  /// @return 3 #markers.
  Eigen::VectorXd seen(const Eigen::MatrixXd& displacements) const;

  /// The transpose of this: of a number a component, 3 #free by #probes.
  Eigen::MatrixXd spread(const Eigen::VectorXd& values) const;

 private:
  template <class Act>
  void forCorners(const Act& act) const;

  const MeasuredSetup& setup_;
  std::vector<int> number_;
  Eigen::Index freeCount_;
};

/// Equations whose smoothing is too small for conjugate gradients.
class TooLittleSmoothing : public std::runtime_error {
 public:
  TooLittleSmoothing()
      : std::runtime_error("the correction's equations did not converge: take more smoothing") {}
};

/// Corrections B X B^T of a compliance by its modes B, with
///     X = S + kOwnFactors diag(S),  S = (B^T A L^T B + B^T L A^T B) / 2,
/// the probes' loads L, and A, the pulls at the markers spread over the surface: those of all
/// symmetric ones that explain measurements with least effort, where each mode's own factor is
/// changed with less of it than how modes act on each other.
class ComplianceKernel {
 public:
  /// @param modes   3 #free by #modes, (m/N)^1/2.
  /// @param loads   3 #free by #probes, N.
  /// @param markers  outlives this.
  ComplianceKernel(Eigen::MatrixXd modes, const Eigen::MatrixXd& loads, const MarkerRows& markers,
                   const Progress& progress);

  /// What pulls explain at the markers.
  Eigen::VectorXd seen(const Eigen::VectorXd& pulls) const;

  /// The pulls that explain residuals but for noise, by conjugate gradients.
  /// @param weights    0 where left out.
  /// @param smoothing  noise over what is corrected, variances.
  /// @param tolerance  of the equations' right-hand side.
  /// @throws TooLittleSmoothing if they do not come that near within hundreds of steps.
  Eigen::VectorXd pulls(const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights,
                        double smoothing, double tolerance) const;

  /// The correction, 3 #free squared.
  Eigen::MatrixXd matrix(const Eigen::VectorXd& pulls) const;

 private:
  Eigen::MatrixXd modes_;
  const MarkerRows& markers_;
  Progress progress_;
  Eigen::MatrixXd loaded_, work_;  // B^T L and its square, L^T B B^T L
  double unit_;                    // what a pull explains of itself, in the mean
};

}  // namespace palpate
