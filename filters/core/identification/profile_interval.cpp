// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/profile_interval.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpate {
namespace {

constexpr double kSettled = 0.005;  // of the quantile
constexpr int kWidenings = 40, kNarrowings = 20;

/// The problem on the plane where the combination is a value: the pivot, its first entry, follows
/// from the other parameters.
class Profile {
 public:
  Profile(const LeastSquaresProblem& problem, const LeastSquaresSolution& solution,
          const Eigen::VectorXd& combination)
      : problem_(problem), combination_(combination), least_(squaresAt(solution.parameters)) {
    for (Eigen::Index i = combination.size() - 1; i >= 0; --i)
      if (combination[i] != 0) pivot_ = static_cast<int>(i);
    for (int i = 0; i < int(combination.size()); ++i)
      if (i != pivot_) others_.push_back(i);
    moving_ = solution.parameters(others_);
    best_ = combination.dot(solution.parameters);
    const bool isAlone = (combination.array() != 0).count() == 1;
    const double of = combination[pivot_];
    lower_ = isAlone ? of * problem.lower[pivot_] : -INFINITY;
    upper_ = isAlone ? of * problem.upper[pivot_] : INFINITY;
    if (lower_ > upper_) std::swap(lower_, upper_);
    start_ = moving_;
  }

  double best() const { return best_; }
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  void restart() { moving_ = start_; }

  /// The root of what the least sum of squares at a value is above the least of all.
  double at(double value) {
    if (!others_.empty()) {
      LeastSquaresProblem rest;
      rest.start = moving_;
      rest.lower = problem_.lower(others_);
      rest.upper = problem_.upper(others_);
      rest.groups = problem_.groups;
      rest.tolerance = problem_.tolerance;
      rest.withCovariance = false;
      rest.goOn = problem_.goOn;
      rest.evaluate = [&](const Eigen::VectorXd& moving, Eigen::VectorXd& residuals,
                          Eigen::MatrixXd* jacobian) {
        Eigen::MatrixXd all;
        problem_.evaluate(placeOf(value, moving), residuals, jacobian ? &all : nullptr);
        if (!jacobian) return;
        *jacobian = all(Eigen::all, others_);
        *jacobian -= all.col(pivot_) * combination_(others_).transpose() / combination_[pivot_];
      };
      try {
        moving_ = solveLeastSquares(rest).parameters;
      } catch (const NotConverged& ended) {
        moving_ = ended.parameters;
      }
    }
    return std::sqrt(std::max(0.0, squaresAt(placeOf(value, moving_)) - least_));
  }

 private:
  Eigen::VectorXd placeOf(double value, const Eigen::VectorXd& moving) const {
    Eigen::VectorXd place(combination_.size());
    place[pivot_] = 0;
    place(others_) = moving;
    place[pivot_] = (value - combination_.dot(place)) / combination_[pivot_];
    return place;
  }

  double squaresAt(const Eigen::VectorXd& place) const {
    Eigen::VectorXd residuals;
    problem_.evaluate(place, residuals, nullptr);
    return residuals.squaredNorm();
  }

  const LeastSquaresProblem& problem_;
  const Eigen::VectorXd& combination_;
  double least_, best_ = 0, lower_ = 0, upper_ = 0;
  int pivot_ = 0;
  std::vector<int> others_;
  Eigen::VectorXd moving_, start_;
};

/// Where the profile reaches the quantile on one side, or the bound before it does.
/// @param step  to that side, where it would be if residuals were linear.
double endOf(Profile& profile, double step, double bound, double normal) {
  const double best = profile.best();
  if ((bound - best) * step <= 0) return bound;
  const auto within = [&](double value) {
    return step > 0 ? std::min(value, bound) : std::max(value, bound);
  };
  profile.restart();
  double inside = best, rootInside = 0, outside = within(best + step);
  double rootOutside = profile.at(outside);
  for (int i = 0; rootOutside < normal; ++i) {
    if (outside == bound || i == kWidenings) return outside;
    inside = outside;
    rootInside = rootOutside;
    outside = within(best + 2 * (outside - best));
    rootOutside = profile.at(outside);
  }
  for (int i = 0; i < kNarrowings && rootOutside > (1 + kSettled) * normal; ++i) {
    const double share = (normal - rootInside) / (rootOutside - rootInside);
    const double middle =
        inside + std::clamp((1 + kSettled / 2) * share, 0.05, 0.95) * (outside - inside);
    const double root = profile.at(middle);
    (root < normal ? inside : outside) = middle;
    (root < normal ? rootInside : rootOutside) = root;
  }
  return outside;
}

}  // namespace

Interval profileInterval(const LeastSquaresProblem& problem, const LeastSquaresSolution& solution,
                         const Eigen::VectorXd& combination, double normal) {
  Profile profile(problem, solution, combination);
  const double variance = combination.dot(solution.covariance * combination),
               range = profile.upper() - profile.lower();
  double step = normal * std::sqrt(std::max(0.0, variance));
  if (!(step > 0) || step > range) step = std::isfinite(range) ? range : 1;
  return {endOf(profile, -step, profile.lower(), normal),
          endOf(profile, step, profile.upper(), normal)};
}

}  // namespace palpate
