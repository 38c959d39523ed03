// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Eigen/Cholesky>

#include "identification/material_identifier_parts.h"
#include "identification/measured_values.h"
#include "identification/observability.h"
#include "sentence.h"

namespace palpate {

MaterialIdentifier::MaterialIdentifier(const ResponseOf& responseOf, const MeasuredSetup& setup,
                                       double size, std::vector<Eigen::Vector3d> normals,
                                       const IdentificationOptions& options,
                                       const Progress& progress) {
  Eigen::VectorXd lower, upper;
  boxOf(options.unknowns, lower, upper);
  ResponseInterpolation::Options how;
  how.tolerance = options.interpolationTolerance;
  how.foundationLength = options.unknowns.support ? 0.1 * size : 0;
  const auto sample = [&](const Eigen::VectorXd& place, const Progress& part) {
    return responseOf(materialsAt(options.unknowns, place), part);
  };
  ResponseInterpolation response(sample, lower, upper, setup, how, progress);
  parts_.reset(
      new Parts{options, std::move(normals), setup.places,
                MaterialModel(options.unknowns, size, std::move(response), setup.probeOf)});
}

MaterialIdentifier::MaterialIdentifier(MaterialIdentifier&&) noexcept = default;
MaterialIdentifier::~MaterialIdentifier() = default;

Eigen::Matrix3Xd MaterialIdentifier::predict(const Eigen::VectorXd& parameters,
                                             const Measurements& measurements) const {
  const MaterialModel& model = parts_->model;
  return model.displacements(model.unknownsOf(parameters), forcesOf(measurements), nullptr)
      .reshaped(3, model.probeOf().size());
}

Eigen::MatrixXd MaterialIdentifier::sensitivities(const Eigen::VectorXd& parameters,
                                                  const Measurements& measurements) const {
  const MaterialModel& model = parts_->model;
  Eigen::MatrixXd jacobian;
  model.displacements(model.unknownsOf(parameters), forcesOf(measurements), &jacobian);
  return jacobian;
}

Eigen::VectorXd MaterialIdentifier::deviations(const Eigen::VectorXd& parameters,
                                               const Eigen::MatrixXd& information) const {
  const Eigen::LLT<Eigen::MatrixXd> factors(information);
  if (factors.info() != Eigen::Success) refuse("the probes do not determine all unknowns");
  const auto all = parts_->model.parameters(
      parts_->model.unknownsOf(parameters),
      factors.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols())));
  Eigen::VectorXd deviations(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) deviations[i] = all[i].deviation;
  return deviations;
}

Eigen::VectorXd MaterialIdentifier::parametersOff(const MaterialIdentification& found,
                                                  const Measurements& measurements,
                                                  const Eigen::VectorXd& off) const {
  const MaterialModel& model = parts_->model;
  Eigen::VectorXd parameters(model.count());
  for (int i = 0; i < model.count(); ++i) parameters[i] = found.parameters[i].value;
  const Eigen::MatrixXd jacobian = sensitivities(parameters, measurements);
  const Eigen::VectorXd squares =
      MeasuredValues(measurements).weightsWithout(found.outliers).array().square();
  const Eigen::LDLT<Eigen::MatrixXd> normal(jacobian.transpose() * squares.asDiagonal() * jacobian);
  if (normal.info() != Eigen::Success || !normal.isPositive()) return {};
  const Eigen::VectorXd change = normal.solve(jacobian.transpose() * squares.cwiseProduct(off));
  Eigen::VectorXd result(model.count());
  for (int i = 0; i < model.count(); ++i)
    result[i] = model.combinationOf(i).dot(change) * (model.regionOf(i) >= 0 ? parameters[i]
                                                      : i == model.support() ? model.size()
                                                                             : 1);
  return result;
}

const ResponseInterpolation& MaterialIdentifier::response() const {
  return parts_->model.response();
}

}  // namespace palpate
