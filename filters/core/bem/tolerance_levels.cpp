// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/tolerance_levels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "mesh/rim_grading.h"

namespace palpate {
namespace {

void scale(LoadDifferences& differences, double factor) {
  for (std::vector<double>* list : {&differences.field, &differences.contact})
    for (double& difference : *list) difference *= factor;
}

/// Width of the triangles at the rim, over that without layers.
double widthOf(int layers) {
  return std::pow(kLayerShare, layers);
}

/// The mesh that shows the rim's part.
MeshSetting layeredBefore(MeshSetting setting) {
  return {setting.level - 1, std::max(setting.layers, 1)};
}

}  // namespace

double mostOf(const LoadDifferences& differences) {
  return std::max(LoadDifferences::most(differences.field),
                  LoadDifferences::most(differences.contact));
}

ToleranceLevels::ToleranceLevels(const MeshHierarchy& hierarchy, int mostVertices,
                                 BoundaryElementOptions options)
    : hierarchy_(hierarchy), mostVertices_(mostVertices), options_(std::move(options)) {}

const ToleranceLevels::Solved& ToleranceLevels::solve(MeshSetting setting,
                                                      const Progress& progress) {
  const auto found = solved_.find(setting);
  if (found != solved_.end()) return found->second;
  const ElasticModel model = hierarchy_(setting.level, setting.layers);
  if (model.mesh().vertexCount() > mostVertices_)
    throw std::runtime_error("the surface has " + std::to_string(model.mesh().vertexCount()) +
                             " vertices, more than the " + std::to_string(mostVertices_) +
                             " that a tolerance may take: allow more, or make the mesh coarser");
  const auto compute = [&] {
    return computeBoundaryElementGreensFunctions(model, options_, progress.callback());
  };
  const auto keep = [&](ComputedGreensFunctions result) -> const Solved& {
    return solved_.emplace(setting, Solved{model, std::move(result)}).first->second;
  };
  try {
    return keep(compute());
  } catch (const std::runtime_error& failure) {
    if (options_.precision != Precision::Float || dynamic_cast<const Aborted*>(&failure)) throw;
    options_.precision = Precision::Double;
    return keep(compute());
  }
}

const ToleranceLevels::Solved& ToleranceLevels::solveWithCoarser(MeshSetting setting,
                                                                 const Progress& progress) {
  solve({setting.level - 1, 0}, progress.part(0, 0.02));
  solve(layeredBefore(setting), progress.part(0.02, 0.1));
  return solve(setting, progress.part(0.1, 1));
}

LoadDifferences ToleranceLevels::differences(MeshSetting finer, MeshSetting coarser,
                                             const SpreadLoads& loads) const {
  const Solved &fine = at(finer), &coarse = at(coarser), &shared = at({coarser.level, 0});
  std::vector<int> vertices(coarse.vertices(), -1);
  for (int v = 0; v < shared.vertices(); ++v) vertices[v] = v;
  return compareUnderLoads(*fine.result.view(), fine.model.mesh(), *coarse.result.view(),
                           coarse.model.mesh(), vertices, loads);
}

LoadDifferences ToleranceLevels::rimErrors(MeshSetting layered, const SpreadLoads& loads) const {
  LoadDifferences errors = differences(layered, {layered.level, 0}, loads);
  scale(errors, 1 / (1 - widthOf(layered.layers)));
  return errors;
}

ErrorEstimate ToleranceLevels::estimateByParts(MeshSetting setting) const {
  const MeshSetting before{setting.level - 1, setting.layers};
  const SpreadLoads spread = loads(before.level);
  LoadDifferences errors = differences(setting, before, spread);
  const LoadDifferences rim = rimErrors(layeredBefore(setting), spread);
  const double left = widthOf(setting.layers) / kEdgeGrowth;
  // Between the levels the rest of the error differs by (4 - 1) times what is left of it, the rim's
  // part by (2 - 1) times.
  const auto combine = [&](std::vector<double>& error, const std::vector<double>& ofRim) {
    for (std::size_t load = 0; load < error.size(); ++load)
      error[load] =
          (error[load] + (kLevelGrowth - kEdgeGrowth) * left * ofRim[load]) / (kLevelGrowth - 1);
  };
  combine(errors.field, rim.field);
  combine(errors.contact, rim.contact);
  ErrorEstimate estimate = otherErrors(*at(setting).result.view());
  addDiscretization(errors, 1, spread.length, estimate);
  return estimate;
}

}  // namespace palpate
