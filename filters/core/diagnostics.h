// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace palpate {

/// How wrong Green's functions are estimated to be, by cause; negative where there is no estimate.
/// Errors are relative to the answer to unit forces, each spread like (1 - r / loadLength)+ around
/// a point of the free surface; two dozen points far from each other stand for all.
struct ErrorEstimate {
  double loadLength = -1;      ///< m
  double discretization = -1;  ///< of displacements, L2 over the free surface, mean square of loads
  double integration = -1;     ///< likewise, by the tolerance of the integrals
  double solver = -1;          ///< likewise, a bound
  double storage = -1;         ///< likewise, the rounding of stored numbers
  double contact = -1;         ///< discretisation's share in compliances where the load is
  double mostDiscretization = -1, mostContact = -1;  ///< what 95 % of the loads do not exceed

  /// The sum of all causes; -1 without an estimate.
  double total() const { return plusOthers(discretization); }
  /// The same of compliances.
  double contactTotal() const { return plusOthers(contact); }
  /// What 95 % of the loads do not exceed in either.
  double most() const {
    return plusOthers(mostContact > mostDiscretization ? mostContact : mostDiscretization);
  }

 private:
  double plusOthers(double error) const {
    return error < 0 ? -1 : error + integration + solver + storage;
  }
};

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
  ErrorEstimate error;
  /// Bytes held at the peak of the computation by its matrices.
  std::size_t peakBytes = 0;
  /// Stage name and wall-clock seconds, in order.
  std::vector<std::pair<std::string, double>> seconds;
  /// Sentences for the user, each with the measured number.
  std::vector<std::string> warnings;
};

}  // namespace palpate
