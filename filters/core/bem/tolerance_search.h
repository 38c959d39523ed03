// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bem/boundary_element_method.h"
#include "progress.h"

namespace palpate {

/// How far a search may go.
struct ToleranceLimits {
  int levels = 0;       ///< refinements of the mesh that is given, at most
  int vertices = 3000;  ///< of any mesh; double Green's functions take 72 bytes their square
};

/// The cheapest settings found.
struct ToleranceResult {
  int level = 0;  ///< refinements
  ComputedGreensFunctions greens;
  std::vector<std::string> steps;  ///< sentences: what was tried, what was chosen and why
};

/// Green's functions whose estimated error (ErrorEstimate::most: that of displacements and of
/// contact compliances, which 95 % of the loads do not exceed) is by a fifth within a tolerance, on
/// the coarsest level of a hierarchy of meshes that meets it.
/// - Levels are solved from the coarsest on, as each costs up to 64 times the one before. The error
///   of one below 200 vertices is that of its difference from the next; of others, from the one
///   before, by the order that three levels show, where there are three; estimateError serves where
///   there is no such level.
/// - Integrals and arithmetic take a hundredth of the tolerance: single precision from 1e-3 on,
///   where the system's condition allows.
/// @param level     gives the model's k-th level; called for 0, 1, 2 ... A level's vertices are the
///                  first of the next, though they may have moved.
/// @param tolerance relative, above 0 and below 1.
/// @param options   its tolerance and precision are chosen here.
/// @throws std::invalid_argument for another tolerance; std::runtime_error with the error that is
///         within reach if the limits do not allow the tolerance, or if no error can be estimated;
///         as computeBoundaryElementGreensFunctions.
ToleranceResult computeToTolerance(const std::function<ElasticModel(int level)>& level,
                                   double tolerance, const ToleranceLimits& limits,
                                   const BoundaryElementOptions& options,
                                   const ProgressCallback& progress = {});

}  // namespace palpate
