// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "identification/material_model.h"

namespace palpate {

/// A fit whose trustworthiness is asked for.
struct FittedMaterial {
  const MaterialModel& model;
  const Measurements& measurements;
  const std::vector<Eigen::Vector3d>& normals;  ///< #probes
  const Eigen::VectorXd& unknowns;
  const Eigen::VectorXd& weights;  ///< 3 #markers, 1 / standard deviation, 0 where left out
};

/// Which unknowns the data hardly see or do not see at all, as sentences that name what they are
/// mistaken for and the probe, of those at the present contacts, that would help most.
struct Observability {
  std::vector<std::string> weak;    ///< known, but badly
  std::vector<std::string> unseen;  ///< worse than the range that was looked in
};

/// @param covariance  of the unknowns; empty where the data do not determine them.
/// @param weakest     the combination that they see least.
Observability observability(const FittedMaterial& fit, const Eigen::MatrixXd& covariance,
                            const Eigen::VectorXd& weakest);

/// The forces of the probes, 3 by #probes.
Eigen::Matrix3Xd forcesOf(const Measurements& measurements);

}  // namespace palpate
