// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <exception>
#include <memory>
#include <vector>

#include "identification/least_squares.h"
#include "progress.h"

namespace palpate {
namespace {

/// All residuals and derivatives of one place, computed once for all groups.
class Evaluation final : public ceres::EvaluationCallback {
 public:
  explicit Evaluation(const LeastSquaresProblem& problem)
      : problem_(problem), place(problem.start) {}

  void PrepareForEvaluation(bool derivatives, bool isNew) override {
    if (!isNew && (hasJacobian_ || !derivatives)) return;
    try {
      problem_.evaluate(place, residuals, derivatives ? &jacobian : nullptr);
      hasJacobian_ = derivatives;
    } catch (...) {  // carried over Ceres' frames
      if (!raised) raised = std::current_exception();
      residuals.setConstant(3 * problem_.groups, NAN);
      jacobian.setConstant(3 * problem_.groups, place.size(), NAN);
      hasJacobian_ = true;
    }
  }

 private:
  const LeastSquaresProblem& problem_;
  bool hasJacobian_ = false;

 public:
  Eigen::VectorXd place;  ///< Ceres' own copy of the parameters
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  std::exception_ptr raised;
};

class Group final : public ceres::CostFunction {
 public:
  Group(const Evaluation& all, int group) : all_(all), group_(group) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(all.place.size()));
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::Vector3d> here(residuals);
    here = all_.residuals.segment<3>(3 * group_);
    if (jacobians && jacobians[0])
      for (int r = 0; r < 3; ++r)
        for (Eigen::Index c = 0; c < all_.place.size(); ++c)
          jacobians[0][r * all_.place.size() + c] = all_.jacobian(3 * group_ + r, c);
    return here.allFinite();
  }

 private:
  const Evaluation& all_;
  int group_;
};

class Watch final : public ceres::IterationCallback {
 public:
  explicit Watch(const LeastSquaresProblem& problem) : problem_(problem) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    isAborted = problem_.goOn && !problem_.goOn();
    return isAborted ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }
  bool isAborted = false;

 private:
  const LeastSquaresProblem& problem_;
};

ceres::LossFunction* lossOf(const LeastSquaresProblem& problem) {
  switch (problem.loss) {
    case RobustLoss::Huber:
      return new ceres::HuberLoss(problem.scale);
    case RobustLoss::Cauchy:
      return new ceres::CauchyLoss(problem.scale);
    case RobustLoss::Tukey:
      return new ceres::TukeyLoss(problem.scale);
    case RobustLoss::None:
      break;
  }
  return nullptr;
}

std::vector<int> atBounds(const double* place, const LeastSquaresProblem& given) {
  std::vector<int> found;
  for (int i = 0; i < given.start.size(); ++i) {
    if (isAtBound(place[i], given.lower[i], given.upper[i])) found.push_back(i);
  }
  return found;
}

/// Of parameters that are free to vary; empty where they are not determined.
Eigen::MatrixXd covarianceOf(ceres::Problem& problem, const double* place, int count) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.min_reciprocal_condition_number = 1e-30;  // of what the caller has looked at
  ceres::Covariance covariance(options);
  std::vector<std::pair<const double*, const double*>> blocks{{place, place}};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(count, count);
  if (covariance.Compute(blocks, &problem) &&
      covariance.GetCovarianceBlock(place, place, values.data()) && values.allFinite())
    return values;
  return {};
}

void hold(ceres::Problem& problem, double* place, int count, const std::vector<int>& held) {
  problem.SetManifold(place, held.empty() ? nullptr : new ceres::SubsetManifold(count, held));
}

/// Without bounds, and with what is at a bound held.
void setCovariances(ceres::Problem& problem, double* place, const std::vector<int>& held,
                    LeastSquaresSolution& solution) {
  const int count = static_cast<int>(solution.parameters.size());
  solution.heldCovariance.setZero(count, count);
  if (int(held.size()) < count) solution.heldCovariance = covarianceOf(problem, place, count);
  if (!held.empty()) hold(problem, place, count, {});
  solution.covariance =
      held.empty() ? solution.heldCovariance : covarianceOf(problem, place, count);
}

/// Nothing where it converged: Ceres calls some ends so whose cost is not finite.
std::string failureOf(const ceres::Solver::Summary& summary) {
  if (!summary.IsSolutionUsable() || !std::isfinite(summary.final_cost)) return summary.message;
  return summary.termination_type == ceres::NO_CONVERGENCE ? "it took more than 200 steps" : "";
}

/// Keeps Ceres from writing to the terminal: what goes wrong is in its summary.
class Silence {
 public:
  Silence() : before_(FLAGS_minloglevel) { FLAGS_minloglevel = google::GLOG_FATAL; }
  ~Silence() { FLAGS_minloglevel = before_; }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int before_;
};

void solve(const LeastSquaresProblem& given, LeastSquaresSolution& solution, std::string& failure) {
  const Silence silence;
  Evaluation evaluation(given);
  ceres::Problem::Options shared;
  shared.evaluation_callback = &evaluation;
  shared.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  const std::unique_ptr<ceres::LossFunction> loss(lossOf(given));
  ceres::Problem problem(shared);
  double* const place = evaluation.place.data();
  for (int g = 0; g < given.groups; ++g)
    problem.AddResidualBlock(new Group(evaluation, g),
                             g < given.groups - given.plainGroups ? loss.get() : nullptr, place);
  for (int i = 0; i < evaluation.place.size(); ++i) {
    if (std::isfinite(given.lower[i])) problem.SetParameterLowerBound(place, i, given.lower[i]);
    if (std::isfinite(given.upper[i])) problem.SetParameterUpperBound(place, i, given.upper[i]);
  }
  Watch watch(given);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = given.tolerance;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-10;
  options.callbacks.push_back(&watch);
  options.update_state_every_iteration = true;
  // Near a bound steps that are cut off at it converge slowly: once a parameter is there it is held
  // and the rest goes on.
  std::vector<int> held;
  while (true) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (evaluation.raised) std::rethrow_exception(evaluation.raised);
    if (watch.isAborted) throw Aborted();
    solution.parameters = evaluation.place;
    solution.cost = summary.final_cost;
    solution.iterations += summary.num_successful_steps + summary.num_unsuccessful_steps;
    failure = failureOf(summary);
    if (!failure.empty()) return;
    const std::vector<int> now = atBounds(place, given);
    if (now.size() == held.size() || now.size() == std::size_t(given.start.size())) {
      held = now;
      break;
    }
    held = now;
    hold(problem, place, int(given.start.size()), held);
  }
  if (given.withCovariance) setCovariances(problem, place, held, solution);
}

}  // namespace
}  // namespace palpate

extern "C" __attribute__((visibility("default"))) void palpateSolveLeastSquares(
    const palpate::LeastSquaresProblem& problem, palpate::LeastSquaresSolution& solution,
    std::string& failure) {
  palpate::solve(problem, solution, failure);
}
