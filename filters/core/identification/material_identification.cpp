// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/material_identification.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

MaterialIdentification MaterialIdentifier::identify(const Measurements& measurements,
                                                    const Progress& progress) const {
  const MaterialModel& model = parts_->model;
  if (measurements.displacements.size() != model.probeOf().size())
    refuse("the measurements are not those that the responses were computed for");
  const Eigen::Matrix3Xd forces = forcesOf(measurements);
  const auto displacements = [&](const Eigen::VectorXd& unknowns, Eigen::MatrixXd* jacobian) {
    return model.displacements(unknowns, forces, jacobian);
  };
  DisplacementModel moved;
  moved.lower = model.lower();
  moved.upper = model.upper();
  moved.precision.setZero(model.count());
  moved.displacements = displacements;
  moved.places = parts_->places;
  RobustFit fit(std::move(moved), measurements, parts_->options.loss, progress);
  Eigen::VectorXd start = model.middle();
  start[0] = std::log(fit.modulusBy(displacements(start, nullptr)));
  fit.run(start);

  const Eigen::VectorXd weights = fit.weights();
  const LeastSquaresSolution& solution = fit.solution();
  const FittedMaterial fitted{model, measurements, parts_->normals, fit.unknowns(), weights};
  const Observability seen = observability(fitted, solution.covariance, solution.weakest);
  if (!seen.unseen.empty()) refuse(seen.unseen.front());
  if (solution.covariance.size() == 0)
    refuse("the data do not determine the unknowns: hold some at what is known");
  MaterialIdentification result;
  result.materials = model.materials(fit.unknowns());
  result.foundationLength = model.foundationLength(fit.unknowns());
  result.parameters = model.parameters(fit.unknowns(), solution.covariance);
  for (int i = 0; i < model.count(); ++i)
    model.setInterval(i, fit.intervalOf(model.combinationOf(i)), result.parameters[i]);
  result.correlations = correlationsOf(model, solution.covariance);
  result.interpolationError = model.response().error();
  result.samples = model.response().sampleCount();
  result.warnings = seen.weak;
  warnOfParameters(result);
  fit.describe(result);
  warnOfInterpolation(measurements, result);
  if (const Eigen::MatrixXd byProbes = fit.covarianceByProbes(); byProbes.size() > 0) {
    const auto parameters = model.parameters(fit.unknowns(), byProbes);
    for (int i = 0; i < model.count(); ++i)
      result.parameters[i].probewiseDeviation = parameters[i].deviation;
  }
  warnOfLackOfFit(result);
  fit.crossValidate(parts_->options.folds, result);
  progress.report(1, "done");
  return result;
}

}  // namespace palpate
