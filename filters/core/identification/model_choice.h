// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/measurements.h"

namespace palpate {

/// What a kind of model makes of a table.
struct TriedModel {
  Eigen::Matrix3Xd heldOut;   ///< residuals of probes left out, 3 by #markers; empty for none
  std::vector<int> outliers;  ///< markers
};

struct ModelChoice {
  int taken = -1;              ///< of those tried; -1 if none predicts anything
  std::vector<double> errors;  ///< relative, root mean squares; NaN of what predicts nothing
};

/// The simplest kind of model that predicts probes left out about as well as any: the first whose
/// error is within a twentieth of the least, or larger by less than the standard error of the
/// difference over probes (the rule of one standard error; Hastie, Tibshirani and Friedman, The
/// Elements of Statistical Learning, 2nd ed., 2009, 7.10). All are judged by the same
/// displacements, those that not every kind takes for outliers.
/// @param tried  from the most constrained on.
ModelChoice chooseModel(const Measurements& measurements, const std::vector<TriedModel>& tried);

}  // namespace palpate
