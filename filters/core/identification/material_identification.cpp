// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/material_identification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "identification/material_identifier_parts.h"
#include "identification/observability.h"
#include "identification/robust_statistics.h"
#include "model/plausible_modulus.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kRobustScale = 2.5;     // norm of a displacement's residuals, standard deviations
constexpr double kFalseOutliers = 0.01;  // expected in a table without any
constexpr double kLargestMisfit = 3;     // standard deviations of chi squared
constexpr int kScalings = 5, kTrimmings = 10;
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// One table against the model.
class MaterialIdentifier::Fit {
 public:
  Fit(const Parts& parts, const Measurements& measurements, const Progress& progress)
      : parts_(parts),
        model_(parts.model),
        measurements_(measurements),
        forces_(forcesOf(measurements)),
        progress_(progress) {
    const int markers = static_cast<int>(measurements.displacements.size());
    if (markers != int(model_.probeOf().size()))
      refuse("the measurements are not those that the responses were computed for");
    measured_.setZero(3 * markers);
    weights_.setZero(3 * markers);
    for (int i = 0; i < markers; ++i) {
      const MeasuredDisplacement& here = measurements.displacements[i];
      for (int c = 0; c < 3; ++c)
        if (!std::isnan(here.displacement[c])) {
          measured_[3 * i + c] = here.displacement[c];
          weights_[3 * i + c] = measurements.hasDeviations() ? 1 / here.deviation[c] : 1;
        }
    }
    isOutlier_.assign(markers, false);
  }

  MaterialIdentification result();

 private:
  int countOf(const Eigen::VectorXd& weights) const { return int((weights.array() > 0).count()); }
  Eigen::VectorXd start() const;
  Eigen::VectorXd residualsAt(const Eigen::VectorXd& unknowns) const {
    return measured_ - model_.displacements(unknowns, forces_, nullptr);
  }
  LeastSquaresSolution solve(const Eigen::VectorXd& from, const Eigen::VectorXd& weights,
                             RobustLoss loss) const;
  double scaleAt(const Eigen::VectorXd& unknowns) const;
  Eigen::VectorXd inlierWeights() const;
  bool markOutliers(const Eigen::VectorXd& unknowns, double scale);
  void fitRobustly();
  void requireEnough() const;
  double scaleOf(const Eigen::VectorXd& weights) const;
  void describe(MaterialIdentification& result) const;
  void describeProbes(MaterialIdentification& result) const;
  void warn(MaterialIdentification& result) const;
  Eigen::VectorXd withoutFold(const Eigen::VectorXd& kept) const;
  double holdOutError() const;

  const Parts& parts_;
  const MaterialModel& model_;
  const Measurements& measurements_;
  Eigen::Matrix3Xd forces_;
  Progress progress_;
  Eigen::VectorXd measured_, weights_;  ///< 3 #markers; weights 0 where not measured
  std::vector<bool> isOutlier_;
  Eigen::VectorXd unknowns_;
  double scale_ = 1;  ///< standard deviation of weighted residuals
  LeastSquaresSolution solution_;
};

/// Of 1 / E, in the middle of the rest, the linear least squares' solution.
Eigen::VectorXd MaterialIdentifier::Fit::start() const {
  Eigen::VectorXd unknowns = model_.middle();
  const Eigen::VectorXd unit = model_.displacements(unknowns, forces_, nullptr);
  const Eigen::ArrayXd squares = weights_.array().square();
  const double along = (squares * unit.array() * measured_.array()).sum(),
               size = (squares * unit.array().square()).sum();
  if (!(size > 0)) refuse("nothing moves at the markers, whatever the material");
  if (!(along > 0))
    refuse(
        "the displacements are against the forces, which no material explains: check the signs "
        "of the forces, which are those on the body");
  unknowns[0] = std::log(size / along);
  return unknowns;
}

LeastSquaresSolution MaterialIdentifier::Fit::solve(const Eigen::VectorXd& from,
                                                    const Eigen::VectorXd& weights,
                                                    RobustLoss loss) const {
  LeastSquaresProblem problem;
  problem.start = from;
  problem.lower = model_.lower();
  problem.upper = model_.upper();
  problem.groups = static_cast<int>(isOutlier_.size());
  problem.loss = loss;
  problem.scale = kRobustScale;
  problem.evaluate = [&](const Eigen::VectorXd& unknowns, Eigen::VectorXd& residuals,
                         Eigen::MatrixXd* jacobian) {
    residuals = weights.cwiseProduct(model_.displacements(unknowns, forces_, jacobian) - measured_);
    if (jacobian) *jacobian = (weights.asDiagonal() * *jacobian).eval();
  };
  problem.goOn = [this] {
    progress_.report(0.5, "fit");
    return true;
  };
  return solveLeastSquares(problem);
}

double MaterialIdentifier::Fit::scaleAt(const Eigen::VectorXd& unknowns) const {
  const Eigen::VectorXd residuals = weights_.cwiseProduct(residualsAt(unknowns));
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < residuals.size(); ++i)
    if (weights_[i] > 0) sizes.push_back(std::abs(residuals[i]));
  // Exact data have no scale of their own.
  const double rounding = 1e-9 * weights_.cwiseProduct(measured_).cwiseAbs().maxCoeff();
  const double scale = std::max(medianDeviation(std::move(sizes)), rounding);
  return measurements_.hasDeviations() ? std::max(1.0, scale) : scale;
}

Eigen::VectorXd MaterialIdentifier::Fit::inlierWeights() const {
  Eigen::VectorXd weights = weights_;
  for (std::size_t i = 0; i < isOutlier_.size(); ++i)
    if (isOutlier_[i]) weights.segment<3>(3 * i).setZero();
  return weights;
}

/// @return whether others are outliers now.
bool MaterialIdentifier::Fit::markOutliers(const Eigen::VectorXd& unknowns, double scale) {
  const Eigen::VectorXd residuals = weights_.cwiseProduct(residualsAt(unknowns)) / scale;
  const double most = chiSquaredOf(kFalseOutliers / double(isOutlier_.size()));
  bool changed = false;
  for (std::size_t i = 0; i < isOutlier_.size(); ++i) {
    const bool isOutlier = residuals.segment<3>(3 * i).squaredNorm() > most;
    changed = changed || isOutlier != isOutlier_[i];
    isOutlier_[i] = isOutlier;
  }
  return changed;
}

void MaterialIdentifier::Fit::fitRobustly() {
  unknowns_ = start();
  const RobustLoss loss = parts_.options.loss;
  scale_ = scaleAt(unknowns_);
  if (loss == RobustLoss::None) {
    solution_ = solve(unknowns_, weights_ / scale_, loss);
    unknowns_ = solution_.parameters;
    scale_ = scaleOf(weights_);
    return;
  }
  for (int i = 0; i < kScalings; ++i) {
    unknowns_ = solve(unknowns_, weights_ / scale_, loss).parameters;
    scale_ = scaleAt(unknowns_);
  }
  markOutliers(unknowns_, scale_);
  for (int i = 0; i < kTrimmings; ++i) {
    requireEnough();
    solution_ = solve(unknowns_, inlierWeights() / scale_, RobustLoss::None);
    unknowns_ = solution_.parameters;
    scale_ = scaleOf(inlierWeights());
    if (!markOutliers(unknowns_, scale_)) break;
  }
  requireEnough();
  solution_ = solve(unknowns_, inlierWeights() / scale_, RobustLoss::None);
  unknowns_ = solution_.parameters;
}

/// The root mean square of weighted residuals; where deviations are given, 1 unless the residuals
/// are larger by more than chance.
double MaterialIdentifier::Fit::scaleOf(const Eigen::VectorXd& weights) const {
  const int freedom = std::max(1, countOf(weights) - model_.count());
  const double square = weights.cwiseProduct(residualsAt(unknowns_)).squaredNorm() / freedom;
  if (measurements_.hasDeviations() && square <= 1 + kLargestMisfit * std::sqrt(2.0 / freedom))
    return 1;
  const double rounding = 1e-9 * weights.cwiseProduct(measured_).cwiseAbs().maxCoeff();
  return std::max(std::sqrt(square), rounding);
}

void MaterialIdentifier::Fit::requireEnough() const {
  const int values = countOf(inlierWeights());
  if (values <= model_.count())
    refuse("there are ", values, " measured components without outliers for ", model_.count(),
           " unknowns: measure more, or hold what is known");
}

MaterialIdentification MaterialIdentifier::Fit::result() {
  requireEnough();
  fitRobustly();
  const Eigen::VectorXd weights = inlierWeights() / scale_;
  const FittedMaterial fitted{model_, measurements_, parts_.normals, unknowns_, weights};
  const Observability seen = observability(fitted, solution_.covariance, solution_.weakest);
  if (!seen.unseen.empty()) refuse(seen.unseen.front());
  if (solution_.covariance.size() == 0)
    refuse("the data do not determine the unknowns: hold some at what is known");
  MaterialIdentification result;
  describe(result);
  describeProbes(result);
  result.warnings = seen.weak;
  warn(result);
  result.holdOutError = holdOutError();
  progress_.report(1, "done");
  return result;
}

void MaterialIdentifier::Fit::describe(MaterialIdentification& result) const {
  const Eigen::MatrixXd& covariance = solution_.covariance;
  result.materials = model_.materials(unknowns_);
  result.foundationLength = model_.foundationLength(unknowns_);
  result.parameters = model_.parameters(unknowns_, covariance);
  // Correlations of what is reported: ln E_r is the sum of two unknowns.
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(model_.count(), model_.count());
  for (int i = 1; i < model_.count(); ++i)
    if (model_.regionOf(i) > 0) turn(i, 0) = 1;
  const Eigen::MatrixXd reported = turn * covariance * turn.transpose();
  result.correlations.setZero(model_.count(), model_.count());
  for (int i = 0; i < model_.count(); ++i)
    for (int j = 0; j < model_.count(); ++j)
      if (reported(i, i) > 0 && reported(j, j) > 0)
        result.correlations(i, j) = reported(i, j) / std::sqrt(reported(i, i) * reported(j, j));
  result.residuals = residualsAt(unknowns_).reshaped(3, isOutlier_.size());
  for (Eigen::Index i = 0; i < weights_.size(); ++i)
    if (weights_[i] == 0) result.residuals.reshaped()[i] = kNotMeasured;
  for (std::size_t i = 0; i < isOutlier_.size(); ++i)
    if (isOutlier_[i]) result.outliers.push_back(static_cast<int>(i));
  const Eigen::VectorXd weights = inlierWeights();
  result.valueCount = countOf(weights);
  const int freedom = std::max(1, result.valueCount - model_.count());
  const Eigen::VectorXd residuals = residualsAt(unknowns_);
  result.noise =
      std::sqrt((weights.array() > 0).select(residuals.array().square(), 0).sum() / freedom);
  if (measurements_.hasDeviations())
    result.misfit = std::sqrt(weights.cwiseProduct(residuals).squaredNorm() / freedom);
  result.interpolationError = model_.response().error();
  result.samples = model_.response().sampleCount();
}

void MaterialIdentifier::Fit::describeProbes(MaterialIdentification& result) const {
  const int probes = static_cast<int>(measurements_.probes.size());
  std::vector<double> values(probes), residuals(probes), sizes(probes);
  for (const Probe& probe : measurements_.probes) result.probes.push_back({probe.name});
  for (std::size_t i = 0; i < isOutlier_.size(); ++i) {
    const int p = measurements_.displacements[i].probe;
    ++result.probes[p].markers;
    result.probes[p].outliers += isOutlier_[i];
    for (int c = 0; c < 3 && !isOutlier_[i]; ++c)
      if (weights_[3 * i + c] > 0) {
        ++values[p];
        residuals[p] += std::pow(result.residuals(c, i), 2);
        sizes[p] += std::pow(measured_[3 * i + c], 2);
      }
  }
  for (int p = 0; p < probes; ++p) {
    if (values[p] == 0) continue;
    result.probes[p].residual = std::sqrt(residuals[p] / values[p]);
    result.probes[p].relative = sizes[p] > 0 ? std::sqrt(residuals[p] / sizes[p]) : 0;
  }
}

void MaterialIdentifier::Fit::warn(MaterialIdentification& result) const {
  for (const IdentifiedParameter& p : result.parameters)
    if (p.isAtBound && p.unit == "m" && p.value == 0)
      result.warnings.push_back("the support's yielding cannot be told from none");
    else if (p.isAtBound)
      result.warnings.push_back(
          sentence(p.name, " is at the bound ", shortly(p.value),
                   " of what was looked in: the data ask for more, or the "
                   "model differs from the body; its deviation is not known"));
  for (const Material& material : result.materials)
    if (!isPlausibleModulus(material.youngsModulus()))
      result.warnings.push_back(
          sentence("a Young's modulus of ", shortly(material.youngsModulus()),
                   " Pa is no material's: check the units of length and force"));
  if (result.misfit > 0 && scale_ > 1)
    result.warnings.push_back(
        sentence("residuals are ", shortly(result.misfit),
                 " times the standard deviations given, by which all deviations here are "
                 "enlarged: the model differs from the body, or the noise was underrated"));
  const double share = double(result.outliers.size()) / double(isOutlier_.size());
  if (share > 0.2)
    result.warnings.push_back(
        sentence(shortly(100 * share),
                 " % of the displacements contradict the rest: the table or the model is wrong"));
  double largest = 0;
  for (std::size_t i = 0; i < isOutlier_.size(); ++i)
    if (!isOutlier_[i])
      largest = std::max(largest, measured_.segment<3>(3 * i).cwiseAbs().maxCoeff());
  if (result.interpolationError * largest > 0.1 * result.noise && result.noise > 1e-6 * largest)
    result.warnings.push_back(sentence("the response is interpolated to ",
                                       shortly(result.interpolationError),
                                       " only, which is not small beside the noise"));
}

/// The unknowns by what is kept; none where that does not lead to any.
Eigen::VectorXd MaterialIdentifier::Fit::withoutFold(const Eigen::VectorXd& kept) const {
  try {
    return solve(unknowns_, kept / scale_, RobustLoss::None).parameters;
  } catch (const Aborted&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};
  }
}

/// The relative error of displacements under probes that the material was not identified from; of
/// one probe, of markers.
double MaterialIdentifier::Fit::holdOutError() const {
  const int probes = static_cast<int>(measurements_.probes.size()),
            markers = static_cast<int>(isOutlier_.size());
  const int units = probes > 1 ? probes : markers, folds = std::min(parts_.options.folds, units);
  if (folds < 2) return -1;
  const Eigen::VectorXd weights = inlierWeights();
  double error = 0, size = 0;
  for (int fold = 0; fold < folds; ++fold) {
    progress_.report(0.6 + 0.4 * fold / folds, "cross-validate");
    Eigen::VectorXd kept = weights;
    for (int i = 0; i < markers; ++i)
      if ((probes > 1 ? measurements_.displacements[i].probe : i) % folds == fold)
        kept.segment<3>(3 * i).setZero();
    if (countOf(kept) <= model_.count()) return -1;
    const Eigen::VectorXd without = withoutFold(kept);
    if (without.size() == 0) return -1;
    const Eigen::ArrayXd held = (weights.array() > 0 && kept.array() == 0).cast<double>();
    error += (held * residualsAt(without).array()).square().sum();
    size += (held * measured_.array()).square().sum();
  }
  return size > 0 ? std::sqrt(error / size) : -1;
}

MaterialIdentification MaterialIdentifier::identify(const Measurements& measurements,
                                                    const Progress& progress) const {
  return Fit(*parts_, measurements, progress).result();
}

}  // namespace palpate
