// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identification/least_squares.h"
#include "identification/material_identification.h"
#include "identification/measured_values.h"
#include "identification/measurements.h"
#include "identification/profile_interval.h"
#include "progress.h"

namespace palpate {

/// Displacements at markers as a function of unknowns.
struct DisplacementModel {
  Eigen::VectorXd lower, upper;  ///< #unknowns; may be infinite
  /// #unknowns: 1 / variance about 0 of what is known of each before anything is measured; 0 for
  /// nothing.
  Eigen::VectorXd precision;
  /// 3 #markers, m. The derivatives, 3 #markers by #unknowns, are set if not null.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& unknowns, Eigen::MatrixXd* jacobian)>
      displacements;
  double tolerance = 1e-12;  ///< LeastSquaresProblem
  /// Whether evaluations are so dear that what is left out is judged by the derivatives at the end.
  bool isDear = false;
  Eigen::Matrix3Xd places;  ///< #markers: at rest, m

  int count() const { return static_cast<int>(lower.size()); }
};

/// The unknowns of a model by a table of measurements, some of which may be wrong.
class RobustFit {
 public:
  /// @param loss  how residuals count while outliers are looked for; those found are then left
  ///              out. None takes all as they are.
  /// @throws std::invalid_argument if there are fewer measurements than unknowns of which nothing
  ///         is known.
  RobustFit(DisplacementModel model, const Measurements& measurements, RobustLoss loss,
            const Progress& progress);

  /// By 1 / E a robust linear fit.
  /// @param unit  displacements of Young's modulus 1 Pa, 3 #markers.
  /// @return E, Pa.
  /// @throws std::invalid_argument if nothing moves, or most against the forces.
  double modulusBy(const Eigen::VectorXd& unit) const;

  /// @throws as solveLeastSquares, and as the constructor.
  void run(const Eigen::VectorXd& start);

  const Eigen::VectorXd& unknowns() const { return unknowns_; }
  const LeastSquaresSolution& solution() const { return solution_; }
  /// 3 #markers: 1 / standard deviation, 0 where not measured or an outlier.
  Eigen::VectorXd weights() const { return inlierWeights() / scale_; }
  /// Values of a combination of the unknowns that the measurements allow at 95 %.
  Interval intervalOf(const Eigen::VectorXd& combination) const;
  /// Of unknowns that the measurements determine, and not what was known before.
  double determinedCount() const;

  /// Sets residuals, outliers, probes, noise and misfit, with what is doubtful in these.
  /// @throws std::invalid_argument if displacements are explained no better than by no motion.
  void describe(MaterialIdentification& result) const;

  /// Of the unknowns, by what leaving out each probe in turn changes (the jackknife; of one step
  /// from the solution). Empty of less than four probes, or where one of them is needed.
  Eigen::MatrixXd covarianceByProbes() const;

  /// What the best multiple of displacements leaves, without outliers: over those measured, root
  /// mean squares.
  double leftByMultipleOf(const Eigen::VectorXd& displacements) const;

  /// Sets what is wrong under probes that the unknowns were not identified from; of one probe, at
  /// markers. Nothing where that cannot be told.
  void crossValidate(int folds, MaterialIdentification& result) const;

 private:
  Eigen::VectorXd residualsAt(const Eigen::VectorXd& unknowns) const {
    return table_.measured() - model_.displacements(unknowns, nullptr);
  }
  LeastSquaresProblem problemOf(const Eigen::VectorXd& from, const Eigen::VectorXd& weights,
                                RobustLoss loss) const;
  LeastSquaresSolution solve(const Eigen::VectorXd& from, const Eigen::VectorXd& weights,
                             RobustLoss loss) const;
  double roundingOf(const Eigen::VectorXd& weights) const;
  double robustScale() const;
  double scaleOf(const Eigen::VectorXd& weights) const;
  double freedomOf(const Eigen::VectorXd& weights) const;
  Eigen::VectorXd inlierWeights() const { return table_.weightsWithout(outliers_); }
  bool markOutliers();
  void settle(const Eigen::VectorXd& weights, RobustLoss loss);
  void requireEnough() const;
  Eigen::VectorXd residualsWithout(const Eigen::VectorXd& kept) const;
  Eigen::VectorXd linearResidualsWithout(const Eigen::VectorXd& kept,
                                         const Eigen::MatrixXd& jacobian) const;

  DisplacementModel model_;
  MeasuredValues table_;
  RobustLoss loss_;
  Progress progress_;
  int unknownCount_;  // of which nothing is known before
  std::vector<int> outliers_;
  Eigen::VectorXd unknowns_, residuals_;
  double scale_ = 1;  // standard deviation of weighted residuals
  LeastSquaresSolution solution_;
};

}  // namespace palpate
