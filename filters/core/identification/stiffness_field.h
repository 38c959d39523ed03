// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <vector>

#include "identification/material_identification.h"
#include "identification/measured_response.h"
#include "identification/measurements.h"
#include "progress.h"

namespace palpate {

/// What is known beforehand of a body whose stiffness varies from place to place.
struct StiffnessFieldOptions {
  bool poisson = false;                           ///< whether Poisson's ratio, the same all over,
  double poissonRatio = 0.3;                      ///< is unknown; else it is this one
  double poissonLower = 0, poissonUpper = 0.449;  ///< where it is looked for
  /// Standard, of ln E about its mean: 1 for factors up to 3, often; 0 to choose the one that makes
  /// the measurements most probable.
  double deviation = 0;
  RobustLoss loss = RobustLoss::Cauchy;
  int folds = 5;  ///< of the cross-validation, by probes; below 2 for none
};

/// A body whose Young's modulus is
///     E = E_0 exp(s sum a_k b_k)
/// with modes b_k (stiffnessModes) and the deviation s: whatever the a_k are, its Green's functions
/// are those of a body, reciprocal and positive definite.
struct StiffnessField {
  Eigen::VectorXd modulus;    ///< #T, Pa
  Eigen::VectorXd deviation;  ///< #T: standard, of ln E, given the measurements
  double determined = 0;      ///< how many unknowns the measurements determine
  double expected = 1;        ///< standard deviation of ln E: the one given or chosen
  double uniformError = 0;    ///< fit.fitError of the best body of one modulus
  /// Geometric mean of Young's modulus over the volume, and Poisson's ratio; residuals, outliers
  /// and warnings.
  MaterialIdentification fit;
};

/// What the probes' forces do to the surface.
struct MovedSurface {
  Eigen::MatrixXd displacements;         ///< 3 #V by #probes, m
  std::vector<Eigen::MatrixXd> byModes;  ///< #probes, 3 #V by #modes, m
};

/// For a modulus in each cell, Pa, and Poisson's ratio; with byModes if derivatives are wanted,
/// those by ln E along the modes.
using MovedSurfaceOf = std::function<MovedSurface(
    const Eigen::VectorXd& modulus, double poissonRatio, bool derivatives, const Progress&)>;

/// Identifies the field as the most probable one, given that the a_k are standard normal beforehand
/// and the noise of the measurements is the same all over or as the table tells; where it does not,
/// the noise is what residuals leave.
/// @param modes    #T by any.
/// @param volumes  #T.
/// @throws std::invalid_argument for what does not go together, for measurements that leave the
///         mean or Poisson's ratio open, and as RobustFit; std::runtime_error if it does not
///         converge; what `moved` throws; Aborted.
StiffnessField identifyStiffnessField(const MovedSurfaceOf& moved, const Eigen::MatrixXd& modes,
                                      const Eigen::VectorXd& volumes, const MeasuredSetup& setup,
                                      const Measurements& measurements,
                                      const StiffnessFieldOptions& options,
                                      const Progress& progress = {});

}  // namespace palpate
