// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/material_identification.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>

#include "identification/lack_of_fit.h"
#include "identification/material_identifier_parts.h"
#include "identification/observability.h"
#include "identification/robust_fit.h"
#include "model/plausible_modulus.h"
#include "sentence.h"

namespace palpate {
namespace {

/// Of what is reported: ln E_r is the sum of two unknowns.
Eigen::MatrixXd correlationsOf(const MaterialModel& model, const Eigen::MatrixXd& covariance) {
  const int count = model.count();
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(count, count);
  for (int i = 1; i < count; ++i)
    if (model.regionOf(i) > 0) turn(i, 0) = 1;
  const Eigen::MatrixXd reported = turn * covariance * turn.transpose();
  Eigen::MatrixXd correlations = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      if (reported(i, i) > 0 && reported(j, j) > 0)
        correlations(i, j) = reported(i, j) / std::sqrt(reported(i, i) * reported(j, j));
  return correlations;
}

void warnOfParameters(MaterialIdentification& result) {
  for (const IdentifiedParameter& p : result.parameters)
    if (p.isAtBound && p.unit == "m" && p.value == 0)
      result.warnings.push_back(
          sentence("the support's yielding cannot be told from none: E/k is below ",
                   shortly(p.upper), " m (95 %)"));
    else if (p.isAtBound)
      result.warnings.push_back(sentence(p.name, " is at the bound ", shortly(p.value),
                                         " of what was looked in: the data ask for more, or the "
                                         "model differs from the body; its interval ends there"));
  for (const Material& material : result.materials)
    if (!isPlausibleModulus(material.youngsModulus()))
      result.warnings.push_back(
          sentence("a Young's modulus of ", shortly(material.youngsModulus()),
                   " Pa is no material's: check the units of length and force"));
}

void warnOfInterpolation(const Measurements& measurements, MaterialIdentification& result) {
  double largest = 0;
  for (std::size_t i = 0; i < measurements.displacements.size(); ++i)
    if (!std::binary_search(result.outliers.begin(), result.outliers.end(), int(i)))
      for (double component : measurements.displacements[i].displacement)
        if (!std::isnan(component)) largest = std::max(largest, std::abs(component));
  if (result.interpolationError * largest > 0.1 * result.noise && result.noise > 1e-6 * largest)
    result.warnings.push_back(sentence("the response is interpolated to ",
                                       shortly(result.interpolationError),
                                       " only, which is not small beside the noise"));
}

/// The unknowns, and behind them how far what else is uncertain is from where it was taken to be,
/// in standard deviations.
DisplacementModel displacementModel(const MaterialModel& model, const Eigen::Matrix3Xd& forces,
                                    const Eigen::Matrix3Xd& places,
                                    const Eigen::MatrixXd& changes) {
  const Eigen::Index count = model.count(), others = changes.cols();
  DisplacementModel moved;
  moved.lower.setConstant(count + others, -INFINITY);
  moved.upper.setConstant(count + others, INFINITY);
  moved.lower.head(count) = model.lower();
  moved.upper.head(count) = model.upper();
  moved.precision.setOnes(count + others);
  moved.precision.head(count).setZero();
  moved.places = places;
  moved.displacements = [&model, forces, changes, count, others](const Eigen::VectorXd& unknowns,
                                                                 Eigen::MatrixXd* jacobian) {
    Eigen::VectorXd result = model.displacements(unknowns.head(count), forces, jacobian);
    if (others == 0) return result;
    result -= changes * unknowns.tail(others);
    if (!jacobian) return result;
    jacobian->conservativeResize(Eigen::NoChange, count + others);
    jacobian->rightCols(others) = -changes;
    return result;
  };
  return moved;
}

/// With what the registration has of deviations: what is left of a covariance without the others.
void setParameters(const MaterialModel& model, const RobustFit& fit,
                   MaterialIdentification& result) {
  const Eigen::Index count = model.count(), all = fit.unknowns().size();
  const Eigen::VectorXd unknowns = fit.unknowns().head(count);
  const Eigen::MatrixXd& covariance = fit.solution().covariance;
  result.materials = model.materials(unknowns);
  result.foundationLength = model.foundationLength(unknowns);
  result.parameters = model.parameters(unknowns, covariance.topLeftCorner(count, count));
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd combination = Eigen::VectorXd::Zero(all);
    combination.head(count) = model.combinationOf(i);
    model.setInterval(i, fit.intervalOf(combination), result.parameters[i]);
  }
  result.correlations = correlationsOf(model, covariance.topLeftCorner(count, count));
  if (const Eigen::MatrixXd byProbes = fit.covarianceByProbes(); byProbes.size() > 0) {
    const auto parameters = model.parameters(unknowns, byProbes.topLeftCorner(count, count));
    for (int i = 0; i < count; ++i)
      result.parameters[i].probewiseDeviation = parameters[i].deviation;
  }
  if (all == count) return;
  const auto held = covariance.rightCols(all - count);
  const Eigen::MatrixXd share = held * held.bottomRows(all - count).ldlt().solve(held.transpose());
  const auto parameters = model.parameters(unknowns, share.topLeftCorner(count, count));
  for (int i = 0; i < count; ++i)
    result.parameters[i].registrationDeviation = parameters[i].deviation;
}

}  // namespace

MaterialIdentification MaterialIdentifier::identify(const Measurements& measurements,
                                                    const Progress& progress,
                                                    const Eigen::MatrixXd& changes) const {
  const MaterialModel& model = parts_->model;
  if (measurements.displacements.size() != model.probeOf().size())
    refuse("the measurements are not those that the responses were computed for");
  const Eigen::Matrix3Xd forces = forcesOf(measurements);
  RobustFit fit(displacementModel(model, forces, parts_->places, changes), measurements,
                parts_->options.loss, progress);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(model.count() + changes.cols());
  start.head(model.count()) = model.middle();
  start[0] = std::log(fit.modulusBy(model.displacements(model.middle(), forces, nullptr)));
  fit.run(start);

  const Eigen::VectorXd weights = fit.weights(), unknowns = fit.unknowns().head(model.count());
  const LeastSquaresSolution& solution = fit.solution();
  const FittedMaterial fitted{model, measurements, parts_->normals, unknowns, weights};
  const bool isKnown = solution.covariance.size() > 0;
  const Observability seen = observability(
      fitted,
      isKnown ? solution.covariance.topLeftCorner(model.count(), model.count()).eval()
              : Eigen::MatrixXd(),
      solution.weakest.head(std::min<Eigen::Index>(model.count(), solution.weakest.size())));
  if (!seen.unseen.empty()) refuse(seen.unseen.front());
  if (!isKnown) refuse("the data do not determine the unknowns: hold some at what is known");
  MaterialIdentification result;
  setParameters(model, fit, result);
  result.interpolationError = model.response().error();
  result.samples = model.response().sampleCount();
  result.warnings = seen.weak;
  warnOfParameters(result);
  fit.describe(result);
  warnOfInterpolation(measurements, result);
  warnOfLackOfFit(result);
  fit.crossValidate(parts_->options.folds, result);
  progress.report(1, "done");
  return result;
}

}  // namespace palpate
