// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace palpate {

/// What a computation knows about its own trustworthiness and cost. Quantities that were not
/// computed are negative.
struct Diagnostics {
  /// 1-norm condition number of the non-dimensional system that was factored (the worst body's).
  double conditionEstimate = -1;
  /// |S - S^T|_F / |S|_F of the raw force compliance S = Xi_ij / a_j over the stored free columns.
  /// It is zero for the exact operator, so it indicates the discretisation error.
  double reciprocityDefect = -1;
  /// |H omega x r|_inf / |omega x r|_inf over the three rotations: the integration error of H.
  double rotationDefect = -1;
  /// |A x - b|_F / (|A|_F |x|_F + |b|_F) of one sampled right-hand side.
  double solverResidual = -1;
  /// Relative integration tolerance that was asked for.
  double quadratureTolerance = -1;
  /// Largest edge length over local wall thickness (bending locks, see largestWallRatio).
  double wallRatio = -1;
  /// Narrowest width of a body's support in edge lengths.
  double supportWidth = -1;
  /// Largest rotation of the free surface per unit torque on it, rad/(N m).
  double rockingCompliance = -1;
  /// Bytes held at the peak of the computation by its matrices.
  std::size_t peakBytes = 0;
  /// Stage name and wall-clock seconds, in order.
  std::vector<std::pair<std::string, double>> seconds;
  /// Sentences for the user, each with the measured number.
  std::vector<std::string> warnings;
};

}  // namespace palpate
