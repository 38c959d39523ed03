// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "diagnostics.h"
#include "greens/greens_functions.h"
#include "greens/load_differences.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

/// Another mesh of a model.
struct OtherMesh {
  ElasticModel model;
  std::vector<int> vertices;  ///< of a coarser one, their numbers in the model; of a finer one, the
                              ///< model's are the first
  double ratio;  ///< edges of the coarser over the finer's: the root of the numbers of vertices
};

/// A mesh of half as long edges through the model's vertices (subdivideCurved); none if that
/// surface has defects.
std::optional<OtherMesh> refinedModel(const ElasticModel& model);

/// A mesh of a quarter of the model's vertices (coarsen); none where rims and corners leave more
/// than half of them, there are fewer than four times `leastVertices`, or the support would no
/// longer hold the body.
std::optional<OtherMesh> coarsenedModel(const ElasticModel& model, int leastVertices);

/// How the Green's functions were made whose error is estimated.
struct EstimatedMethod {
  /// Makes all free nodes' Green's functions of another mesh.
  std::function<std::shared_ptr<const GreensFunctions>(const ElasticModel&, const Progress&)> solve;
  /// Whether tractions of a support reach beyond it where it shares a smooth patch.
  bool bluntSupports;
};

/// How wrong the answers of Green's functions are, by hierarchy: the model is solved on a coarser
/// mesh too, or on a finer one if it is small or cannot be coarsened. Between meshes of edge ratio
/// r answers differ by (r^q - 1) times the error of the finer for an order q: 5/4 with a support,
/// on whose rim stresses are singular; 2 without, and where walls are so thin for the coarser mesh
/// that bending locks, which goes with the square of the edges. Where supports are blunt and share
/// a smooth patch with the free surface, their traction also reaches half an edge beyond them; what
/// that does is the difference from a support with a patch of its own, in proportion to the edges.
/// Where columns are missing that the loads need, the error is that of the coarser mesh by a third
/// one, continued with the order. Unknown (-1) where the other mesh cannot be made or solved.
ErrorEstimate estimateError(const ElasticModel& model, const EstimatedMethod& method,
                            const GreensFunctions& greens, const Progress& progress = {});

/// The order q between a mesh and one of twice its edges.
double discretizationOrder(const GreensFunctions& finer);

/// What of an estimate one mesh tells: all but the discretisation's error.
ErrorEstimate otherErrors(const GreensFunctions& greens);

/// The loads of an estimate.
SpreadLoads errorLoads(const ElasticModel& model);

/// Adds differences times a factor to the discretisation's errors.
/// @param length  of the loads, m.
void addDiscretization(const LoadDifferences& differences, double factor, double length,
                       ErrorEstimate& estimate);

}  // namespace palpate
