// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "identification/least_squares.h"
#include "identification/measured_response.h"
#include "identification/measurements.h"
#include "identification/response_interpolation.h"
#include "model/material.h"
#include "progress.h"

namespace palpate {

/// What of a material is unknown, and how it is looked for. Young's modulus always is.
struct MaterialUnknowns {
  bool poisson = true;
  double poissonRatio = 0.3;                      ///< where it is known
  double poissonLower = 0, poissonUpper = 0.499;  ///< where it is not
  int regions = 1;                                ///< of one Young's modulus each
  double largestRatio = 10;                       ///< of Young's moduli of two regions
  bool support = false;                           ///< fixed nodes are on an elastic foundation
};

struct IdentificationOptions {
  MaterialUnknowns unknowns;
  /// How residuals count while outliers are looked for; those that are found are then left out.
  /// None takes all as they are.
  RobustLoss loss = RobustLoss::Cauchy;
  double interpolationTolerance = 1e-4;  ///< ResponseInterpolation::Options
  int folds = 5;                         ///< of the cross-validation, by probes; below 2 for none
};

/// A number that was identified.
struct IdentifiedParameter {
  std::string name;  ///< "Young's modulus" ...
  std::string unit;  ///< "Pa", "m" or none
  double value = 0;
  double deviation = 0;         ///< standard; at a bound as if that were not there
  double lower = 0, upper = 0;  ///< of the interval of 95 %, which ends at a bound at the latest
  bool isAtBound = false;
  /// Standard, by what leaving out each probe in turn changes (the jackknife), and so of all that
  /// differs between probes; -1 where there are too few.
  double probewiseDeviation = -1;
  double registrationDeviation = 0;  ///< the part of its deviation that the registration has
};

/// How one probe fits: residuals are over the markers that are no outliers.
struct ProbeFit {
  std::string name;
  int markers = 0, outliers = 0;  ///< markers are all of them
  double residual = 0;            ///< root mean square of a component, m
  double relative = 0;            ///< root of the sum of squares over that of the displacements
};

/// How residuals of neighbouring markers under one probe go together (neighbourCorrelation).
struct NeighbourCorrelation {
  double correlation = 0;  ///< about 0 for noise
  double byChance = 1;     ///< how probable noise has them go together as much
};

struct MaterialIdentification {
  std::vector<Material> materials;  ///< #regions
  double foundationLength = 0;      ///< E / k of the first region (MeasuredResponse), m
  std::vector<IdentifiedParameter> parameters;
  Eigen::MatrixXd correlations;  ///< #parameters
  Eigen::Matrix3Xd residuals;    ///< measured less predicted, m; NaN where not measured
  std::vector<int> outliers;     ///< indices into the displacements, ascending
  std::vector<ProbeFit> probes;
  int valueCount = 0;   ///< components that count
  double noise = 0;     ///< standard deviation of a residual's component, m
  double misfit = -1;   ///< residuals over the deviations given, root mean square; -1: not given
  double fitError = 0;  ///< residuals over displacements that count, root mean squares
  double holdOutError = -1;  ///< of displacements under probes left out, relative; -1: no folds
  NeighbourCorrelation neighbours;
  Eigen::Matrix3Xd heldOutResiduals;  ///< of probes left out, outliers' too; empty: no folds
  double interpolationError = 0;
  int samples = 0;  ///< Green's functions that were computed
  std::vector<std::string> warnings;
};

/// Identifies a material from displacements under known forces: the response is exactly
/// proportional to 1 / E, and interpolated in what else is unknown.
class MaterialIdentifier {
 public:
  /// What markers see of unit forces on a body of these materials, one a region; all of one
  /// Poisson's ratio.
  using ResponseOf =
      std::function<MeasuredResponse(const std::vector<Material>& regions, const Progress&)>;

  /// Computes the responses that are interpolated.
  /// @param size     of the body, m.
  /// @param normals  #probes, out of the body where each presses, to tell what probes would help.
  /// @throws std::invalid_argument for ranges that hold nothing; as ResponseInterpolation.
  MaterialIdentifier(const ResponseOf& responseOf, const MeasuredSetup& setup, double size,
                     std::vector<Eigen::Vector3d> normals, const IdentificationOptions& options,
                     const Progress& progress = {});
  MaterialIdentifier(MaterialIdentifier&&) noexcept;
  ~MaterialIdentifier();

  /// The displacements that a material predicts, 3 by #markers.
  /// @param parameters  in the order of MaterialIdentification::parameters.
  Eigen::Matrix3Xd predict(const Eigen::VectorXd& parameters,
                           const Measurements& measurements) const;

  /// Derivatives of these displacements by the unknowns: ln E of the first region, Poisson's ratio,
  /// ln of the other regions' E over its, E / k over the body's size. 3 #markers by #unknowns.
  Eigen::MatrixXd sensitivities(const Eigen::VectorXd& parameters,
                                const Measurements& measurements) const;

  /// Standard deviations of the parameters by an information matrix of the unknowns.
  /// @throws std::invalid_argument if it is singular.
  Eigen::VectorXd deviations(const Eigen::VectorXd& parameters,
                             const Eigen::MatrixXd& information) const;

  /// @param measurements  of the setup's probes and markers.
  /// @param changes       of residuals by what else is uncertain, one standard deviation a column,
  ///                      as changesByRegistration; they are fitted, too, within these deviations,
  ///                      and the material's have their part. 3 #markers by any; may be empty.
  /// @throws std::invalid_argument with what the data cannot see and what would help, if they do
  ///         not determine the unknowns, are fewer than these or contradict every material;
  ///         std::runtime_error if it does not converge; Aborted.
  MaterialIdentification identify(const Measurements& measurements, const Progress& progress = {},
                                  const Eigen::MatrixXd& changes = {}) const;

  /// What predicted displacements that are off make of the parameters that were found, in their
  /// units.
  /// @param off  what the body itself would add to them, 3 #markers, m.
  /// @return #parameters: by how much they are too large; empty where the data do not tell.
  Eigen::VectorXd parametersOff(const MaterialIdentification& found,
                                const Measurements& measurements, const Eigen::VectorXd& off) const;

  const ResponseInterpolation& response() const;

 private:
  class Fit;
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace palpate
