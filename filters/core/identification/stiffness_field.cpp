// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/stiffness_field.h"

#include <algorithm>
#include <cmath>

#include "identification/lack_of_fit.h"
#include "identification/profile_interval.h"
#include "identification/robust_fit.h"
#include "model/plausible_modulus.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kPoissonStep = 1e-4;
constexpr double kTolerance = 1e-4;  // of fits, each step of which costs a factorisation
constexpr int kUsualSolutions = 20;
constexpr double kLargestField = 4;  // of ln E anywhere, over its deviation
constexpr double kUsualDeviation = 1, kLeastDeviation = 0.01, kMostDeviation = 10;
constexpr double kSettledDeviation = 0.2;  // relative change
constexpr int kDeviations = 8;             // that are tried

/// Displacements at the markers as a function of ln E_0, Poisson's ratio where it is unknown, and
/// the a_k.
class FieldModel {
 public:
  FieldModel(const MovedSurfaceOf& moved, const Eigen::MatrixXd& modes, const MeasuredSetup& setup,
             const StiffnessFieldOptions& options, const Progress& progress)
      : moved_(moved),
        modes_(modes),
        setup_(setup),
        options_(options),
        progress_(progress),
        deviation_(options.deviation > 0 ? options.deviation : kUsualDeviation) {}

  /// That is expected of ln E.
  double deviation() const { return deviation_; }
  /// @return the unknowns of the same field.
  Eigen::VectorXd withDeviation(double deviation, Eigen::VectorXd unknowns) {
    unknowns.tail(modes_.cols()) *= deviation_ / deviation;
    deviation_ = deviation;
    place_.resize(0);
    return unknowns;
  }

  int firstMode() const { return options_.poisson ? 2 : 1; }
  int count() const { return firstMode() + static_cast<int>(modes_.cols()); }
  double poisson(const Eigen::VectorXd& unknowns) const {
    return options_.poisson ? unknowns[1] : options_.poissonRatio;
  }
  /// Of ln E by the unknowns, #T by count().
  Eigen::MatrixXd logModulusBy() const {
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(modes_.rows(), count());
    by.col(0).setOnes();
    by.rightCols(modes_.cols()) = deviation_ * modes_;
    return by;
  }
  Eigen::VectorXd modulus(const Eigen::VectorXd& unknowns) const {
    return std::exp(unknowns[0]) * relative(unknowns);
  }

  Eigen::VectorXd displacements(const Eigen::VectorXd& unknowns, Eigen::MatrixXd* jacobian) {
    const double softness = std::exp(-unknowns[0]);
    const MovedSurface& here = at(unknowns, jacobian != nullptr);
    const Eigen::VectorXd result = softness * readOut(here.displacements);
    if (!jacobian) return result;
    jacobian->resize(result.size(), count());
    jacobian->col(0) = -result;
    for (int i = 0; i < setup_.markerCount(); ++i)
      jacobian->block(3 * i, firstMode(), 3, modes_.cols()) =
          softness * deviation_ * markerRows(here.byModes[setup_.probeOf[i]], i);
    if (options_.poisson) {
      Eigen::VectorXd further = unknowns;
      further[1] += kPoissonStep;
      const MovedSurface there = moved_(relative(further), further[1], false, steady());
      jacobian->col(1) = (softness * readOut(there.displacements) - result) / kPoissonStep;
    }
    return result;
  }

 private:
  /// How many solutions a fit takes is not known before.
  Progress steady() {
    const double share = double(solutions_) / (solutions_ + kUsualSolutions);
    ++solutions_;
    return Progress([this, share](double, const char*) {
      progress_.report(share, "fit");
      return true;
    });
  }

  Eigen::VectorXd relative(const Eigen::VectorXd& unknowns) const {
    return (deviation_ * (modes_ * unknowns.tail(modes_.cols()))).array().exp();
  }

  /// Of a mean modulus of 1 Pa. The last place is kept: fits ask for it twice.
  const MovedSurface& at(const Eigen::VectorXd& unknowns, bool derivatives) {
    const Eigen::VectorXd place = unknowns.tail(unknowns.size() - 1);
    if (place_.size() == 0 || place != place_ || (derivatives && kept_.byModes.empty())) {
      kept_ = moved_(relative(unknowns), poisson(unknowns), derivatives, steady());
      place_ = place;
    }
    return kept_;
  }

  Eigen::MatrixXd markerRows(const Eigen::MatrixXd& field, int marker) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, field.cols());
    for (int k = 0; k < 3; ++k)
      rows += setup_.weights[marker][k] * field.middleRows<3>(3 * setup_.nodes[marker][k]);
    return rows;
  }

  Eigen::VectorXd readOut(const Eigen::MatrixXd& displacements) const {
    Eigen::VectorXd result(3 * setup_.markerCount());
    for (int i = 0; i < setup_.markerCount(); ++i)
      result.segment<3>(3 * i) = markerRows(displacements.col(setup_.probeOf[i]), i);
    return result;
  }

  const MovedSurfaceOf& moved_;
  const Eigen::MatrixXd& modes_;
  const MeasuredSetup& setup_;
  const StiffnessFieldOptions& options_;
  Progress progress_;
  double deviation_;
  int solutions_ = 0;
  Eigen::VectorXd place_;
  MovedSurface kept_;
};

DisplacementModel displacementModel(FieldModel& field, const Eigen::Matrix3Xd& places,
                                    const StiffnessFieldOptions& options) {
  DisplacementModel model;
  model.places = places;
  model.lower.setConstant(field.count(), -INFINITY);
  model.upper.setConstant(field.count(), INFINITY);
  if (options.poisson) {
    model.lower[1] = options.poissonLower;
    model.upper[1] = options.poissonUpper;
  }
  model.precision.setOnes(field.count());
  model.precision.head(field.firstMode()).setZero();
  model.tolerance = kTolerance;
  model.isDear = true;
  model.displacements = [&field](const Eigen::VectorXd& unknowns, Eigen::MatrixXd* jacobian) {
    return field.displacements(unknowns, jacobian);
  };
  return model;
}

void requireSound(const StiffnessFieldOptions& options) {
  if (!(options.deviation >= 0 && options.deviation <= kMostDeviation))
    refuse("the standard deviation of ln E must be above 0 and at most ", kMostDeviation,
           ", or 0 to be chosen, not ", options.deviation);
  if (!options.poisson) {
    Material(1, options.poissonRatio);  // checks it
  } else if (!(options.poissonLower > -1 && options.poissonUpper + kPoissonStep < 0.5 &&
               options.poissonLower < options.poissonUpper)) {
    refuse("Poisson's ratio is looked for within -1 < lower < upper < 0.4999, not from ",
           options.poissonLower, " to ", options.poissonUpper);
  }
}

/// The mean of Young's modulus and Poisson's ratio, with what is doubtful in them.
void describe(const RobustFit& fit, const FieldModel& field, const StiffnessFieldOptions& options,
              const Eigen::VectorXd& volumes, StiffnessField& result) {
  const Eigen::MatrixXd& covariance = fit.solution().covariance;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(field.firstMode(), field.count());
  turn.row(0) = volumes.transpose() * field.logModulusBy() / volumes.sum();
  if (options.poisson) turn(1, 1) = 1;
  const Eigen::MatrixXd reported = turn * covariance * turn.transpose();
  const Eigen::VectorXd deviations = reported.diagonal().cwiseMax(0).cwiseSqrt();
  const double mean = std::exp(volumes.dot(result.modulus.array().log().matrix()) / volumes.sum());
  const double spread = std::exp(kNormal95 * deviations[0]);
  MaterialIdentification& told = result.fit;
  told.materials = {Material(mean, field.poisson(fit.unknowns()))};
  told.parameters.push_back({"mean Young's modulus", "Pa", mean, mean * deviations[0],
                             mean / spread, mean * spread, false});
  told.correlations = Eigen::MatrixXd::Identity(field.firstMode(), field.firstMode());
  const Eigen::MatrixXd byProbes = fit.covarianceByProbes();
  if (byProbes.size() > 0)
    told.parameters[0].probewiseDeviation =
        mean * std::sqrt((turn * byProbes * turn.transpose())(0, 0));
  if (!isPlausibleModulus(mean))
    told.warnings.push_back(sentence("a Young's modulus of ", shortly(mean),
                                     " Pa is no material's: check the units of length and force"));
  if (!options.poisson) return;
  const double poisson = fit.unknowns()[1], deviation = deviations[1],
               width = options.poissonUpper - options.poissonLower;
  const bool isBound = isAtBound(poisson, options.poissonLower, options.poissonUpper);
  if (!isBound && deviation > width / std::sqrt(12.0))
    refuse("the measurements do not tell Poisson's ratio: its standard deviation is ",
           shortly(deviation), "; give it, or measure where the body is pressed aside, too");
  told.parameters.push_back({"Poisson's ratio", "", poisson, deviation,
                             std::max(options.poissonLower, poisson - kNormal95 * deviation),
                             std::min(options.poissonUpper, poisson + kNormal95 * deviation),
                             isBound});
  if (isBound)
    told.warnings.push_back(sentence("Poisson's ratio is at the bound ", shortly(poisson),
                                     " of what was looked in; its interval ends there"));
  const double size = deviations[0] * deviation;
  if (byProbes.size() > 0)
    told.parameters[1].probewiseDeviation = std::sqrt((turn * byProbes * turn.transpose())(1, 1));
  told.correlations(0, 1) = told.correlations(1, 0) = size > 0 ? reported(0, 1) / size : 0;
}

/// Fits the field, and chooses its deviation unless it is given.
void run(const StiffnessFieldOptions& options, const Eigen::VectorXd& start, FieldModel& field,
         RobustFit& fit) {
  fit.run(start);
  if (options.deviation > 0) return;
  for (int i = 1; i < kDeviations; ++i) {
    const double modes = std::max(1e-3, fit.determinedCount() - field.firstMode());
    const Eigen::Index count = fit.unknowns().size() - field.firstMode();
    const double size = fit.unknowns().tail(count).norm() / std::sqrt(modes);
    const double next = std::clamp(size * field.deviation(), kLeastDeviation, kMostDeviation);
    if (std::abs(next / field.deviation() - 1) < kSettledDeviation) return;
    fit.run(field.withDeviation(next, fit.unknowns()));
  }
}

}  // namespace

StiffnessField identifyStiffnessField(const MovedSurfaceOf& moved, const Eigen::MatrixXd& modes,
                                      const Eigen::VectorXd& volumes, const MeasuredSetup& setup,
                                      const Measurements& measurements,
                                      const StiffnessFieldOptions& options,
                                      const Progress& progress) {
  requireSound(options);
  if (int(measurements.displacements.size()) != setup.markerCount())
    refuse("the measurements are not those of the setup");
  FieldModel field(moved, modes, setup, options, progress.part(0, 0.6));
  RobustFit fit(displacementModel(field, setup.places, options), measurements, options.loss,
                progress);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(field.count());
  if (options.poisson) start[1] = (options.poissonLower + options.poissonUpper) / 2;
  start[0] = std::log(fit.modulusBy(field.displacements(start, nullptr)));
  run(options, start, field, fit);

  const LeastSquaresSolution& solution = fit.solution();
  if (solution.covariance.size() == 0)
    refuse("the measurements do not determine the body's mean stiffness: measure more");
  StiffnessField result;
  result.modulus = field.modulus(fit.unknowns());
  const Eigen::MatrixXd by = field.logModulusBy();
  // Of modes left out nothing is measured.
  const Eigen::ArrayXd others =
      field.deviation() * field.deviation() * (1 - modes.rowwise().squaredNorm().array()).max(0);
  result.deviation =
      ((by * solution.covariance).cwiseProduct(by).rowwise().sum().array().max(0) + others).sqrt();
  result.determined = fit.determinedCount();
  result.expected = field.deviation();
  describe(fit, field, options, volumes, result);
  fit.describe(result.fit);
  warnOfLackOfFit(result.fit);
  Eigen::VectorXd uniform = fit.unknowns();
  uniform.tail(modes.cols()).setZero();
  result.uniformError = fit.leftByMultipleOf(field.displacements(uniform, nullptr));
  const double largest = (modes * fit.unknowns().tail(modes.cols())).cwiseAbs().maxCoeff();
  if (largest > kLargestField)
    result.fit.warnings.push_back(
        sentence("somewhere ln E differs from its mean by ", shortly(largest),
                 " times the standard deviation that was expected beforehand: raise it"));
  fit.crossValidate(options.folds, result.fit);
  progress.report(1, "done");
  return result;
}

}  // namespace palpate
