// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "bem/collocation.h"
#include "greens/computed_greens_functions.h"
#include "greens/error_estimate.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

/// Arithmetic and storage of precomputed Green's functions.
enum class Precision {
  Double,  ///< factored, solved and stored in double
  Mixed,   ///< factored in float, refined and stored in double
  Float,   ///< factored, solved and stored in float: half the memory, about 1e-5 relative
};

/// How the dense system is solved.
enum class LinearSolver {
  Direct,     ///< factored
  Iterative,  ///< by solveIterativeInPlace, in double: cheaper for few columns of large surfaces
};

struct BoundaryElementOptions {
  Precision precision = Precision::Double;
  LinearSolver solver = LinearSolver::Direct;
  Collocation collocation = Collocation::Averaged;
  /// Relative tolerance of each integral over a triangle. The default costs less than the
  /// discretisation error of any mesh that it is used on.
  double tolerance = 1e-6;
  /// Nodes whose Green's functions are computed; empty for all free nodes ([JP01] section 3.6).
  std::vector<int> columns;
  /// Also compute, at vertices on sharp edges, the response to a traction on one patch alone.
  bool patchColumns = false;
  /// Symmetrise the force compliance between free nodes (exact Green's functions are reciprocal).
  bool reciprocal = true;
  /// Also estimate the error on another mesh of the model (see estimateError).
  bool estimateError = false;
  int threads = 0;  ///< 0 for all cores
};

/// Computes the discrete Green's functions of a homogeneous isotropic body by collocation of the
/// boundary integral equation with linear displacements and tractions on flat triangles ([JP01]
/// section 3.4, eq. 8-13), in double or, for Precision::Float, in float. Each body of the model is
/// a system of its own.
/// @throws std::invalid_argument for columns out of range, or an iterative solver in float;
///         Aborted; std::bad_alloc; std::runtime_error if a system is singular, or not solved by
///         iterations.
ComputedGreensFunctions computeBoundaryElementGreensFunctions(
    const ElasticModel& model, const BoundaryElementOptions& options = {},
    const ProgressCallback& progress = {});

/// The same method for another mesh, to estimate errors by.
EstimatedMethod estimatedMethod(const BoundaryElementOptions& options);

}  // namespace palpate
