// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/material_identification.h"
#include "identification/measurements.h"
#include "identification/robust_statistics.h"

namespace palpate {

/// A table of measurements, component by component: what every fit to it shares.
class MeasuredValues {
 public:
  /// @param measurements  outlives this.
  explicit MeasuredValues(const Measurements& measurements);

  const Measurements& table() const { return table_; }
  int markerCount() const { return static_cast<int>(table_.displacements.size()); }
  /// 3 #markers, m; 0 where not measured.
  const Eigen::VectorXd& measured() const { return measured_; }
  /// 3 #markers: 1 / standard deviation, or 1 if none is given; 0 where not measured.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// The same, 0 at outliers, too.
  /// @param outliers  markers.
  Eigen::VectorXd weightsWithout(const std::vector<int>& outliers) const;

  /// The factor that brings displacements nearest to those measured, by least squares.
  /// @param displacements  3 #markers.
  double factorOf(const Eigen::VectorXd& displacements, const Eigen::VectorXd& weights) const;
  /// The same by least absolute deviations along the displacements: nearly half of what was
  /// measured may be anything.
  /// @return above 0.
  /// @throws std::invalid_argument if nothing moves, or against the forces under a fifth of the
  /// probes.
  double robustFactorOf(const Eigen::VectorXd& displacements) const;

  /// The standard deviation of weighted residuals by their median.
  double medianDeviationOf(const Eigen::VectorXd& residuals) const;

  /// Markers whose residuals chance does not explain: without outliers one in a hundred tables has
  /// such a marker.
  /// @param residuals  over their standard deviations, 3 #markers; 0 where not measured.
  std::vector<int> outliersOf(const Eigen::VectorXd& residuals) const;

  /// In how many folds of those wanted the table is split: by probes, of one probe by markers.
  int foldCount(int wanted) const;
  /// Weights, but 0 in a fold.
  Eigen::VectorXd withoutFold(const Eigen::VectorXd& weights, int fold, int folds) const;
  /// What residuals have in a fold, beside what `held` has elsewhere.
  void setFold(const Eigen::VectorXd& residuals, int fold, int folds, Eigen::VectorXd& held) const;
  /// Values by component, NaN where not measured, 3 by #markers.
  Eigen::Matrix3Xd byMarkers(const Eigen::VectorXd& values) const;

  /// Residuals over displacements where weights are not 0, root mean squares.
  double leftBy(const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights) const;

  /// Sets residuals, outliers, the number of values that count, and probes; warns of what is
  /// doubtful in these.
  /// @param residuals  measured less predicted, 3 #markers, m.
  /// @throws std::invalid_argument if displacements are explained no better than by no motion.
  void describe(const Eigen::VectorXd& residuals, const std::vector<int>& outliers,
                MaterialIdentification& result) const;

 private:
  void requireAlongForces(const std::vector<std::vector<Share>>& ofProbes) const;

  const Measurements& table_;
  Eigen::VectorXd measured_, weights_;
};

}  // namespace palpate
