// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <optional>
#include <vector>

#include "bem/boundary_element_method.h"
#include "diagnostics.h"
#include "greens/load_differences.h"
#include "progress.h"

namespace palpate {

/// Another mesh of a model.
struct OtherMesh {
  ElasticModel model;
  std::vector<int> vertices;  ///< #vertices of the coarser one, their numbers in the finer
  double ratio;  ///< edges of the coarser over the finer's: the root of the numbers of vertices
};

/// A mesh of half as long edges through the model's vertices (refineCurved); none if that surface
/// has defects.
std::optional<OtherMesh> refinedModel(const ElasticModel& model);

/// A mesh of a quarter of the model's vertices (coarsen); none where rims and corners leave more
/// than half of them, fewer than 35 remain, or the support would no longer hold the body.
std::optional<OtherMesh> coarsenedModel(const ElasticModel& model);

/// How wrong the answers of Green's functions are, by hierarchy: the model is solved on a coarser
/// mesh too, or on a finer one if it is small or cannot be coarsened. Between meshes of edge ratio
/// r answers differ by (r^q - 1) times the error of the finer for an order q: 1 where the support
/// shares a smooth patch with the free surface, as its traction then reaches half an edge beyond
/// it; 5/4 for other supports, on whose rims stresses are singular; 3/2 without any. True orders
/// from .75 to 2 leave the estimate within a factor of 2 or so. Where columns are missing that the
/// loads need, the error is that of the coarser mesh by a third one, continued with the same order.
/// @param options  that the Green's functions were made with.
ErrorEstimate estimateError(const ElasticModel& model, const BoundaryElementOptions& options,
                            const GreensFunctions& greens, const Progress& progress = {});

/// The order q of a model on its own.
double discretizationOrder(const ElasticModel& model);

/// What of an estimate one mesh tells: all but the discretisation's error.
ErrorEstimate otherErrors(const GreensFunctions& greens);

/// Loads of an estimate.
constexpr int kErrorLoads = 12;

/// Sets the discretisation's errors to differences times a factor; leaves them if there are none.
/// @param length  of the loads, m.
void setDiscretization(const LoadDifferences& differences, double factor, double length,
                       ErrorEstimate& estimate);

}  // namespace palpate
