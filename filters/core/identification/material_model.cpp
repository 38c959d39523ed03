// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/material_model.h"

#include <algorithm>
#include <cmath>

#include "identification/profile_interval.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kSoftestSupport = 10;  // E / k over the size of the body
constexpr double kSomeSupport = 1e-3;
constexpr int kMostRegions = 6;

}  // namespace

void boxOf(const MaterialUnknowns& unknowns, Eigen::VectorXd& lower, Eigen::VectorXd& upper) {
  if (unknowns.regions < 1 || unknowns.regions > kMostRegions)
    refuse("Young's moduli of 1 to ", kMostRegions, " regions are identified, not of ",
           unknowns.regions);
  if (!(unknowns.largestRatio > 1 && unknowns.largestRatio <= 1e4))
    refuse("the largest ratio of Young's moduli must be above 1 and at most 1e4, not ",
           unknowns.largestRatio);
  if (!unknowns.poisson) Material(1, unknowns.poissonRatio);  // checks it
  if (unknowns.poisson && !(unknowns.poissonLower > -1 && unknowns.poissonUpper < 0.5 &&
                            unknowns.poissonLower < unknowns.poissonUpper))
    refuse("Poisson's ratio is looked for within -1 < lower < upper < 0.5, not from ",
           unknowns.poissonLower, " to ", unknowns.poissonUpper);
  const int poisson = unknowns.poisson, ratios = unknowns.regions - 1;
  lower.setConstant(poisson + ratios, -std::log(unknowns.largestRatio));
  upper = -lower;
  if (!poisson) return;
  lower[0] = unknowns.poissonLower;
  upper[0] = unknowns.poissonUpper;
}

std::vector<Material> materialsAt(const MaterialUnknowns& unknowns, const Eigen::VectorXd& place) {
  const double poisson = unknowns.poisson ? place[0] : unknowns.poissonRatio;
  std::vector<Material> materials{Material(1, poisson)};
  for (int r = 1; r < unknowns.regions; ++r)
    materials.emplace_back(std::exp(place[unknowns.poisson + r - 1]), poisson);
  return materials;
}

MaterialModel::MaterialModel(const MaterialUnknowns& unknowns, double size,
                             ResponseInterpolation response, std::vector<int> probeOf)
    : unknowns_(unknowns),
      size_(size),
      response_(std::move(response)),
      probeOf_(std::move(probeOf)) {
  const int coordinates = response_.coordinateCount();
  lower_.setConstant(1 + coordinates + unknowns.support, -INFINITY);
  upper_ = -lower_;
  middle_.setZero(lower_.size());
  lower_.segment(1, coordinates) = response_.lower();
  upper_.segment(1, coordinates) = response_.upper();
  middle_.segment(1, coordinates) = (response_.lower() + response_.upper()) / 2;
  if (!unknowns.support) return;
  lower_[support()] = 0;
  upper_[support()] = kSoftestSupport;
  middle_[support()] = kSomeSupport;
}

int MaterialModel::regionOf(int unknown) const {
  if (unknown == 0) return 0;
  const int region = unknown - unknowns_.poisson;
  return region >= 1 && region < unknowns_.regions ? region : -1;
}

Eigen::VectorXd MaterialModel::displacements(const Eigen::VectorXd& unknowns,
                                             const Eigen::Matrix3Xd& forces,
                                             Eigen::MatrixXd* jacobian) const {
  const int coordinates = response_.coordinateCount(), markers = static_cast<int>(probeOf_.size());
  const double softness = std::exp(-unknowns[0]);
  const ResponseInterpolation::Value value = response_.at(
      unknowns.segment(1, coordinates), foundationLength(unknowns), jacobian != nullptr);
  const auto times = [&](const Eigen::MatrixXd& rows, auto&& out) {
    for (int i = 0; i < markers; ++i)
      out.template segment<3>(3 * i) =
          softness * rows.middleRows<3>(3 * i) * forces.col(probeOf_[i]);
  };
  Eigen::VectorXd result(3 * markers);
  times(value.rows, result);
  if (!jacobian) return result;
  jacobian->resize(3 * markers, count());
  jacobian->col(0) = -result;
  for (int c = 0; c < coordinates; ++c) times(value.byCoordinate[c], jacobian->col(1 + c));
  if (support() < 0) return result;
  times(value.byFoundation, jacobian->col(support()));
  jacobian->col(support()) *= size_;
  return result;
}

std::vector<Material> MaterialModel::materials(const Eigen::VectorXd& unknowns) const {
  std::vector<Material> materials;
  for (const Material& of :
       materialsAt(unknowns_, unknowns.segment(1, response_.coordinateCount())))
    materials.emplace_back(of.youngsModulus() * std::exp(unknowns[0]), of.poissonRatio());
  return materials;
}

double MaterialModel::foundationLength(const Eigen::VectorXd& unknowns) const {
  return support() < 0 ? 0 : std::max(0.0, unknowns[support()]) * size_;
}

Eigen::VectorXd MaterialModel::combinationOf(int parameter) const {
  Eigen::VectorXd combination = Eigen::VectorXd::Unit(count(), parameter);
  if (regionOf(parameter) > 0) combination[0] = 1;  // ln E_r = ln E + ln E_r / E
  return combination;
}

std::vector<IdentifiedParameter> MaterialModel::parameters(
    const Eigen::VectorXd& unknowns, const Eigen::MatrixXd& covariance) const {
  std::vector<IdentifiedParameter> parameters;
  for (int i = 0; i < count(); ++i) {
    IdentifiedParameter p;
    const int region = regionOf(i);
    p.name = region >= 0      ? unknowns_.regions == 1 ? std::string("Young's modulus")
                                                       : sentence("Young's modulus of region ", region)
                  : i == support() ? "support's yielding length E/k"
                              : "Poisson's ratio";
    p.unit = region >= 0 ? "Pa" : i == support() ? "m" : "";
    p.isAtBound = isAtBound(unknowns[i], lower_[i], upper_[i]);
    const Eigen::VectorXd combination = combinationOf(i);
    const double value = combination.dot(unknowns),
                 deviation = std::sqrt(std::max(0.0, combination.dot(covariance * combination)));
    p.value = shown(i, value);
    p.deviation = region >= 0 ? p.value * deviation : shown(i, deviation);
    setInterval(i, {value - kNormal95 * deviation, value + kNormal95 * deviation}, p);
    parameters.push_back(p);
  }
  return parameters;
}

void MaterialModel::setInterval(int parameter, const Interval& interval,
                                IdentifiedParameter& of) const {
  const bool isModulus = regionOf(parameter) >= 0;
  of.lower =
      shown(parameter, isModulus ? interval.lower : std::max(interval.lower, lower_[parameter]));
  of.upper =
      shown(parameter, isModulus ? interval.upper : std::min(interval.upper, upper_[parameter]));
}

double MaterialModel::shown(int parameter, double combination) const {
  return regionOf(parameter) >= 0 ? std::exp(combination)
         : parameter == support() ? size_ * combination
                                  : combination;
}

Eigen::VectorXd MaterialModel::unknownsOf(const Eigen::VectorXd& parameters) const {
  if (parameters.size() != count())
    refuse("there are ", count(), " unknowns, not ", parameters.size());
  Eigen::VectorXd unknowns = parameters;
  for (int i = count() - 1; i >= 0; --i)
    if (regionOf(i) > 0)
      unknowns[i] = std::log(parameters[i] / parameters[0]);
    else if (regionOf(i) == 0)
      unknowns[i] = std::log(parameters[i]);
    else if (i == support())
      unknowns[i] = parameters[i] / size_;
  return unknowns;
}

}  // namespace palpate
