// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <Eigen/Core>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "sentence.h"

namespace palpate {

/// How residuals count that are too large to be noise.
enum class RobustLoss {
  None,    ///< squared
  Huber,   ///< linearly
  Cauchy,  ///< by the logarithm of their square
  Tukey,   ///< not at all
};

/// @throws std::invalid_argument for a name other than none, huber, cauchy, tukey.
inline RobustLoss robustLossNamed(const std::string& name) {
  if (name == "none") return RobustLoss::None;
  if (name == "huber") return RobustLoss::Huber;
  if (name == "cauchy") return RobustLoss::Cauchy;
  if (name == "tukey") return RobustLoss::Tukey;
  refuse("there is no loss '", name, "': choose one of none, huber, cauchy, tukey");
}

/// Whether a parameter is at a bound rather than between its bounds.
inline bool isAtBound(double value, double lower, double upper) {
  const double reach = 1e-9 * std::min(1.0, upper - lower);
  return value <= lower + reach || value >= upper - reach;
}

/// Parameters within bounds whose residuals, in groups of three and over their standard deviation,
/// shall be small.
struct LeastSquaresProblem {
  Eigen::VectorXd start, lower, upper;  ///< #parameters; bounds may be infinite
  int groups = 0;                       ///< residuals over 3
  int plainGroups = 0;                  ///< of the last, which count squared whatever the loss
  RobustLoss loss = RobustLoss::None;
  double scale = 1;          ///< the norm of a group up to which the loss is about quadratic
  double tolerance = 1e-12;  ///< relative change of the sum of losses that ends it
  bool withCovariance = true;

  /// @param residuals  3 #groups, set.
  /// @param jacobian   3 #groups by #parameters, set if not null.
  std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals,
                     Eigen::MatrixXd* jacobian)>
      evaluate;
  std::function<bool()> goOn;  ///< asked after each step; false ends it with Aborted
};

struct LeastSquaresSolution {
  Eigen::VectorXd parameters;
  /// Inverse of the loss-corrected J^T J, as if there were no bounds. Where J has not full rank but
  /// for parameters at a bound, these are held: their rows and columns are zero. Empty where J has
  /// not full rank (weakest).
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd heldCovariance;  ///< with those at a bound held, whatever the rank
  Eigen::VectorXd weakest;         ///< the combination, of norm 1, that residuals see least
  double condition = 0;  ///< largest over smallest singular value of J, without those at a bound
  double cost = 0;       ///< half the sum of losses
  double gradient = 0;   ///< of what can move, columns of J at length 1, over 1 + |residuals|
  int iterations = 0;
};

/// With the reason, and how far it came.
struct NotConverged : std::runtime_error {
  NotConverged(const std::string& reason, Eigen::VectorXd parameters)
      : std::runtime_error("the identification did not converge: " + reason),
        parameters(std::move(parameters)) {}
  Eigen::VectorXd parameters;
};

/// Minimises by Ceres: Levenberg and Marquardt's steps within the bounds.
/// @throws Aborted; NotConverged; what `evaluate` throws; std::runtime_error if Palpate was built
///         without Ceres.
LeastSquaresSolution solveLeastSquares(const LeastSquaresProblem& problem);

/// What the library with Ceres has, under the name kLeastSquaresFunction.
using LeastSquaresFunction = void(const LeastSquaresProblem&, LeastSquaresSolution&,
                                  std::string& failure);
constexpr const char* kLeastSquaresLibrary = "libpalpate_ceres.so";
constexpr const char* kLeastSquaresFunction = "palpateSolveLeastSquares";

}  // namespace palpate
