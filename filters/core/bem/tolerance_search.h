// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bem/boundary_element_method.h"
#include "progress.h"

namespace palpate {

/// Gives the model of a surface that is refined so often and then has so many layers along the rim
/// of its support (gradedModel). A level's vertices, before it gets layers, are the first of all
/// finer ones, though they may have moved.
using MeshHierarchy = std::function<ElasticModel(int level, int layers)>;

/// How far a search may go.
struct ToleranceLimits {
  int levels = 0;       ///< refinements of the mesh that is given, at most
  int vertices = 3000;  ///< of any mesh; double Green's functions take 72 bytes their square
  int layers = 3;       ///< along the rim of the support (gradeTowardsSupport), at most
};

/// The cheapest settings found.
struct ToleranceResult {
  int level = 0, layers = 0;
  ComputedGreensFunctions greens;
  std::vector<std::string> steps;  ///< sentences: what was tried, what was chosen and why
};

/// Green's functions whose estimated error (ErrorEstimate::most: that of displacements and of
/// contact compliances, which 95 % of the loads do not exceed) is by a fifth within a tolerance, on
/// the smallest mesh of a hierarchy that meets it.
/// - Levels are solved from the coarsest on, as each costs up to 64 times the one before. Their
///   error is told by the level before, or by a coarsened mesh: what layers along the rim of the
///   support gain there, where they cost little, tells the rim's part from the rest
///   (ToleranceLevels). Without layers or a rim, the error of one below 200 vertices is that of its
///   difference from the next; of others, from the one before, by the order that three levels show,
///   where there are three; estimateError serves where there is no such level.
/// - From 200 vertices on, layers are chosen with the levels: of the meshes that should meet the
///   tolerance the smallest is solved, and judged by the level before with as many layers.
/// - Integrals and arithmetic take a hundredth of the tolerance: single precision from 1e-3 on,
///   where the system's condition allows.
/// @param tolerance relative, above 0 and below 1.
/// @param options   its tolerance and precision are chosen here.
/// @throws std::invalid_argument for another tolerance; std::runtime_error with the error that is
///         within reach if the limits do not allow the tolerance, or if no error can be estimated;
///         as computeBoundaryElementGreensFunctions.
ToleranceResult computeToTolerance(const MeshHierarchy& hierarchy, double tolerance,
                                   const ToleranceLimits& limits,
                                   const BoundaryElementOptions& options,
                                   const ProgressCallback& progress = {});

}  // namespace palpate
