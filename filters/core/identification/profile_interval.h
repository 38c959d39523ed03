// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "identification/least_squares.h"

namespace palpate {

constexpr double kNormal95 = 1.959963984540054;  ///< what 95 % of normal values are within

struct Interval {
  double lower = 0, upper = 0;
};

/// Values of a combination of the parameters that the data allow, by the profile of the likelihood:
/// where the least sum of squares that goes with a value exceeds the least of all by the square of
/// `normal`. Where residuals are linear and no bound is near this is `normal` standard deviations
/// to both sides; it follows curved residuals, and ends at bounds at the latest.
/// @param problem      without a loss.
/// @param solution     of it.
/// @param combination  #parameters; with more than one entry the first must be without bounds.
/// @param normal       quantile of the normal distribution.
/// @throws Aborted; what the problem's `evaluate` throws.
Interval profileInterval(const LeastSquaresProblem& problem, const LeastSquaresSolution& solution,
                         const Eigen::VectorXd& combination, double normal = kNormal95);

}  // namespace palpate
