// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
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

/// Corrections of a compliance,
///     (K A L^T K + K L A^T K) / 2,
/// with the kernel K, the probes' loads L, and A, the pulls at the markers spread over the surface:
/// those of all symmetric ones that explain measurements with least effort.
class ComplianceKernel {
 public:
  /// @param kernel  3 #free squared, symmetric and positive semidefinite, m/N.
  /// @param loads   3 #free by #probes, N.
  /// @param markers  outlives this.
  ComplianceKernel(Eigen::MatrixXd kernel, const Eigen::MatrixXd& loads, const MarkerRows& markers,
                   const Progress& progress);

  /// What pulls explain at the markers.
  Eigen::VectorXd seen(const Eigen::VectorXd& pulls) const;

  /// The pulls that explain residuals but for noise, by conjugate gradients.
  /// @param weights    0 where left out.
  /// @param smoothing  noise over what is corrected, variances.
  /// @param tolerance  of the equations' right-hand side.
  Eigen::VectorXd pulls(const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights,
                        double smoothing, double tolerance) const;

  /// The correction, 3 #free squared.
  Eigen::MatrixXd matrix(const Eigen::VectorXd& pulls) const;

 private:
  Eigen::MatrixXd kernel_;
  const MarkerRows& markers_;
  Progress progress_;
  Eigen::MatrixXd loaded_, work_;  // K L and L^T K L
  double unit_;                    // what a pull explains of itself, in the mean
};

}  // namespace palpate
