// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/robust_fit.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <stdexcept>
#include <utility>

#include "identification/lack_of_fit.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kRobustScale = 2.5;  // norm of a displacement's residuals, standard deviations
constexpr double kLargestMisfit = 3;  // standard deviations of chi squared
constexpr int kLeastProbes = 4;       // to leave one out of
constexpr int kScalings = 5, kTrimmings = 10;
constexpr double kSettled = 0.02;  // relative change of the scale

int countOf(const Eigen::VectorXd& weights) {
  return static_cast<int>((weights.array() > 0).count());
}

}  // namespace

RobustFit::RobustFit(DisplacementModel model, const Measurements& measurements, RobustLoss loss,
                     const Progress& progress)
    : model_(std::move(model)),
      table_(measurements),
      loss_(loss),
      progress_(progress),
      unknownCount_(static_cast<int>((model_.precision.array() == 0).count())) {
  requireEnough();
}

double RobustFit::modulusBy(const Eigen::VectorXd& unit) const {
  return 1 / table_.robustFactorOf(unit);
}

/// What is known beforehand are residuals behind those of the markers.
LeastSquaresProblem RobustFit::problemOf(const Eigen::VectorXd& from,
                                         const Eigen::VectorXd& weights, RobustLoss loss) const {
  const Eigen::VectorXd known = model_.precision.cwiseSqrt();
  const int priors = unknownCount_ < model_.count() ? (model_.count() + 2) / 3 : 0;
  LeastSquaresProblem problem;
  problem.start = from;
  problem.lower = model_.lower;
  problem.upper = model_.upper;
  problem.groups = table_.markerCount() + priors;
  problem.plainGroups = priors;
  problem.loss = loss;
  problem.scale = kRobustScale;
  problem.tolerance = model_.tolerance;
  problem.evaluate = [this, weights, known, priors, groups = problem.groups](
                         const Eigen::VectorXd& unknowns, Eigen::VectorXd& residuals,
                         Eigen::MatrixXd* jacobian) {
    Eigen::MatrixXd derivatives;
    const Eigen::VectorXd moved = model_.displacements(unknowns, jacobian ? &derivatives : nullptr);
    residuals.setZero(3 * groups);
    residuals.head(weights.size()) = weights.cwiseProduct(moved - table_.measured());
    if (priors > 0) residuals.segment(weights.size(), known.size()) = known.cwiseProduct(unknowns);
    if (!jacobian) return;
    jacobian->setZero(residuals.size(), unknowns.size());
    jacobian->topRows(weights.size()) = weights.asDiagonal() * derivatives;
    if (priors > 0) jacobian->middleRows(weights.size(), known.size()).diagonal() = known;
  };
  problem.goOn = [this] {
    progress_.report(0.5, "fit");
    return true;
  };
  return problem;
}

LeastSquaresSolution RobustFit::solve(const Eigen::VectorXd& from, const Eigen::VectorXd& weights,
                                      RobustLoss loss) const {
  return solveLeastSquares(problemOf(from, weights, loss));
}

Interval RobustFit::intervalOf(const Eigen::VectorXd& combination) const {
  return profileInterval(problemOf(unknowns_, weights(), RobustLoss::None), solution_, combination);
}

/// Exact data have no scale of their own.
double RobustFit::roundingOf(const Eigen::VectorXd& weights) const {
  return 1e-9 * weights.cwiseProduct(table_.measured()).cwiseAbs().maxCoeff();
}

double RobustFit::robustScale() const {
  const double deviation = table_.medianDeviationOf(table_.weights().cwiseProduct(residuals_));
  // Of many unknowns some go with the noise.
  const double taken = countOf(table_.weights()) / freedomOf(table_.weights());
  const double scale = std::max(std::sqrt(taken) * deviation, roundingOf(table_.weights()));
  return table_.table().hasDeviations() ? std::max(1.0, scale) : scale;
}

/// @return whether others are outliers now.
bool RobustFit::markOutliers() {
  const std::vector<int> before = outliers_;
  outliers_ = table_.outliersOf(table_.weights().cwiseProduct(residuals_) / scale_);
  return outliers_ != before;
}

/// A fit, and the scale that it leaves.
void RobustFit::settle(const Eigen::VectorXd& weights, RobustLoss loss) {
  solution_ = solve(unknowns_, weights / scale_, loss);
  unknowns_ = solution_.parameters;
  residuals_ = residualsAt(unknowns_);
  scale_ = loss == RobustLoss::None ? scaleOf(weights) : robustScale();
}

void RobustFit::run(const Eigen::VectorXd& start) {
  unknowns_ = start;
  residuals_ = residualsAt(unknowns_);
  scale_ = robustScale();
  const auto untilSettled = [&](const Eigen::VectorXd& weights, RobustLoss loss) {
    for (int i = 0; i < kScalings; ++i) {
      const double before = scale_;
      settle(weights, loss);
      if (std::abs(scale_ - before) <= kSettled * before) break;
    }
  };
  // What is known beforehand counts the more, the larger the scale.
  const bool isScaleFelt = unknownCount_ < model_.count();
  if (loss_ == RobustLoss::None && !isScaleFelt)
    settle(table_.weights(), loss_);
  else
    untilSettled(table_.weights(), loss_);
  if (loss_ != RobustLoss::None) {
    markOutliers();
    for (int i = 0; i < kTrimmings; ++i) {
      requireEnough();
      settle(inlierWeights(), RobustLoss::None);
      if (!markOutliers()) break;
    }
    requireEnough();
  }
  if (isScaleFelt && model_.isDear) return;
  solution_ = solve(unknowns_, inlierWeights() / scale_, RobustLoss::None);
  unknowns_ = solution_.parameters;
  residuals_ = residualsAt(unknowns_);
}

double RobustFit::determinedCount() const {
  if (solution_.covariance.size() == 0) return model_.count();
  return model_.count() - solution_.covariance.diagonal().dot(model_.precision);
}

double RobustFit::freedomOf(const Eigen::VectorXd& weights) const {
  return std::max(1.0, countOf(weights) -
                           (solution_.parameters.size() > 0 ? determinedCount() : unknownCount_));
}

/// The root mean square of weighted residuals; where deviations are given, 1 unless the residuals
/// are larger by more than chance.
double RobustFit::scaleOf(const Eigen::VectorXd& weights) const {
  const double freedom = freedomOf(weights);
  const double square = weights.cwiseProduct(residuals_).squaredNorm() / freedom;
  if (table_.table().hasDeviations() && square <= 1 + kLargestMisfit * std::sqrt(2.0 / freedom))
    return 1;
  return std::max(std::sqrt(square), roundingOf(weights));
}

void RobustFit::requireEnough() const {
  const int values = countOf(inlierWeights());
  if (values <= unknownCount_)
    refuse("there are ", values, " measured components without outliers for ", unknownCount_,
           " unknowns: measure more, or hold what is known");
}

void RobustFit::describe(MaterialIdentification& result) const {
  table_.describe(residuals_, outliers_, result);
  const Eigen::VectorXd weights = inlierWeights();
  const double freedom = freedomOf(weights);
  result.neighbours =
      neighbourCorrelation({table_.table(), model_.places}, weights.cwiseProduct(residuals_));
  result.noise =
      std::sqrt((weights.array() > 0).select(residuals_.array().square(), 0).sum() / freedom);
  if (table_.table().hasDeviations())
    result.misfit = std::sqrt(weights.cwiseProduct(residuals_).squaredNorm() / freedom);
  if (result.misfit > 0 && scale_ > 1)
    result.warnings.push_back(
        sentence("residuals are ", shortly(result.misfit),
                 " times the standard deviations given, by which all deviations here are "
                 "enlarged: the model differs from the body, or the noise was underrated"));
}

/// Of the unknowns by what is kept; none where that does not lead to any.
Eigen::VectorXd RobustFit::residualsWithout(const Eigen::VectorXd& kept) const {
  try {
    return residualsAt(solve(unknowns_, kept / scale_, RobustLoss::None).parameters);
  } catch (const Aborted&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};
  }
}

/// The same by one step of Gauss and Newton.
Eigen::VectorXd RobustFit::linearResidualsWithout(const Eigen::VectorXd& kept,
                                                  const Eigen::MatrixXd& jacobian) const {
  const Eigen::VectorXd squares = (kept / scale_).array().square();
  Eigen::MatrixXd normal = jacobian.transpose() * squares.asDiagonal() * jacobian;
  normal.diagonal() += model_.precision;
  const Eigen::LDLT<Eigen::MatrixXd> factors(normal);
  if (factors.info() != Eigen::Success || !factors.isPositive()) return {};
  const Eigen::VectorXd step =
      factors.solve(jacobian.transpose() * squares.cwiseProduct(residuals_) -
                    model_.precision.cwiseProduct(unknowns_));
  return residuals_ - jacobian * step;
}

Eigen::MatrixXd RobustFit::covarianceByProbes() const {
  const int probes = static_cast<int>(table_.table().probes.size());
  if (probes < kLeastProbes) return {};
  Eigen::MatrixXd jacobian;
  model_.displacements(unknowns_, &jacobian);
  const Eigen::VectorXd squares = weights().array().square();
  const auto normalOf = [&](const Eigen::VectorXd& kept) -> Eigen::MatrixXd {
    return jacobian.transpose() * kept.asDiagonal() * jacobian;
  };
  Eigen::MatrixXd all = normalOf(squares);
  all.diagonal() += model_.precision;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(model_.count(), model_.count());
  for (int probe = 0; probe < probes; ++probe) {
    const Eigen::VectorXd own = squares - table_.withoutFold(squares, probe, probes);
    const Eigen::LDLT<Eigen::MatrixXd> others(all - normalOf(own));
    if (others.info() != Eigen::Success || !others.isPositive()) return {};
    const Eigen::VectorXd change =
        others.solve(jacobian.transpose() * own.cwiseProduct(residuals_));
    covariance += change * change.transpose() * (probes - 1.0) / probes;
  }
  return covariance;
}

double RobustFit::leftByMultipleOf(const Eigen::VectorXd& displacements) const {
  const Eigen::VectorXd weights = inlierWeights();
  const double factor = table_.factorOf(displacements, weights);
  return table_.leftBy(table_.measured() - factor * displacements, weights);
}

void RobustFit::crossValidate(int wanted, MaterialIdentification& result) const {
  const int folds = table_.foldCount(wanted);
  if (folds < 2) return;
  const Eigen::VectorXd weights = inlierWeights();
  Eigen::MatrixXd jacobian;
  if (model_.isDear) model_.displacements(unknowns_, &jacobian);
  Eigen::VectorXd held = Eigen::VectorXd::Zero(weights.size());
  for (int fold = 0; fold < folds; ++fold) {
    progress_.report(0.6 + 0.4 * fold / folds, "cross-validate");
    const Eigen::VectorXd kept = table_.withoutFold(weights, fold, folds);
    if (countOf(kept) <= unknownCount_) return;
    const Eigen::VectorXd residuals =
        model_.isDear ? linearResidualsWithout(kept, jacobian) : residualsWithout(kept);
    if (residuals.size() == 0) return;
    table_.setFold(residuals, fold, folds, held);
  }
  result.holdOutError = table_.leftBy(held, weights);
  result.heldOutResiduals = table_.byMarkers(held);
}

}  // namespace palpate
