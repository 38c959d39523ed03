// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/tolerance_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "mesh/rim_grading.h"
#include "model/graded_model.h"

namespace palpate {
namespace {

constexpr int kLeastCoarsened = 20;  // vertices of the level -1

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

bool ToleranceLevels::hasCoarsened() {
  if (!isCoarsened_) {
    isCoarsened_ = true;
    try {
      coarsened_ = coarsenedModel(at({0, 0}).model, kLeastCoarsened);
    } catch (const std::runtime_error&) {
      // There is no OpenMesh.
    }
  }
  return coarsened_.has_value();
}

ElasticModel ToleranceLevels::model(MeshSetting setting) const {
  if (setting.level >= 0) return hierarchy_(setting.level, setting.layers);
  return setting.layers > 0 ? gradedModel(coarsened_->model, setting.layers) : coarsened_->model;
}

const ToleranceLevels::Solved& ToleranceLevels::solve(MeshSetting setting,
                                                      const Progress& progress) {
  const auto found = solved_.find(setting);
  if (found != solved_.end()) return found->second;
  const ElasticModel model = this->model(setting);
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

std::vector<int> ToleranceLevels::verticesOf(int level, MeshSetting finer) const {
  if (level < 0 && finer.level >= 0) return coarsened_->vertices;
  std::vector<int> same(at({level, 0}).vertices());
  std::iota(same.begin(), same.end(), 0);
  return same;
}

LoadDifferences ToleranceLevels::differences(MeshSetting finer, MeshSetting coarser,
                                             const SpreadLoads& loads) const {
  const Solved &fine = at(finer), &coarse = at(coarser);
  std::vector<int> vertices = verticesOf(coarser.level, finer);
  vertices.resize(coarse.vertices(), -1);
  return compareUnderLoads(*fine.result.view(), fine.model.mesh(), *coarse.result.view(),
                           coarse.model.mesh(), vertices, loads);
}

double ToleranceLevels::edgeRatio(int level) const {
  return level > 0 ? kEdgeGrowth : coarsened_->ratio;
}

LoadDifferences ToleranceLevels::rimErrors(MeshSetting layered, const SpreadLoads& loads) const {
  LoadDifferences errors = differences(layered, {layered.level, 0}, loads);
  scale(errors, 1 / (1 - widthOf(layered.layers)));
  return errors;
}

LoadDifferences ToleranceLevels::restOfDifference(MeshSetting setting,
                                                  const SpreadLoads& loads) const {
  const int level = setting.level - 1;
  const MeshSetting layered = layeredBefore(setting);
  const double ratio = edgeRatio(setting.level),
               rim = (ratio - 1) * widthOf(setting.layers) / ratio / (1 - widthOf(layered.layers));
  std::map<MeshSetting, double> factors;  // of one mesh in both differences the sum
  factors[{level, setting.layers}] -= 1;
  factors[layered] -= rim;
  factors[{level, 0}] += rim;
  std::vector<std::shared_ptr<const GreensFunctions>> greens{at(setting).result.view()};
  std::vector<ComparedMesh> meshes{
      {*greens[0], at(setting).model.mesh(), verticesOf(level, setting), 1}};
  for (const auto& [mesh, factor] : factors) {
    greens.push_back(at(mesh).result.view());
    meshes.push_back({*greens.back(), at(mesh).model.mesh(), verticesOf(level, mesh), factor});
  }
  return compareUnderLoads(meshes, *at({level, 0}).result.view(), loads);
}

ErrorEstimate ToleranceLevels::estimateByParts(MeshSetting setting) const {
  const SpreadLoads spread = loads(setting.level - 1);
  const LoadDifferences growth = differences(setting, {setting.level - 1, setting.layers}, spread),
                        rim = rimErrors(layeredBefore(setting), spread);
  LoadDifferences errors = restOfDifference(setting, spread);
  const double ratio = edgeRatio(setting.level), left = widthOf(setting.layers) / ratio;
  // Between levels the rest of the error differs by (ratio^2 - 1) times what is left of it, the
  // rim's part by (ratio - 1) times. Where the two are in the surface has nothing in common, so
  // that their squares add. Walls that lock are too stiff by a factor 1 + x, where x goes with the
  // square of the edges: their difference is to be seen relative to the coarser answer.
  const auto combine = [&](std::vector<double>& error, const std::vector<double>& grown,
                           const std::vector<double>& ofRim) {
    for (std::size_t load = 0; load < error.size(); ++load)
      error[load] = std::hypot(std::max(grown[load], 1.0) * error[load] / (ratio * ratio - 1),
                               left * ofRim[load]);
  };
  combine(errors.field, growth.fieldGrowth, rim.field);
  combine(errors.contact, growth.contactGrowth, rim.contact);
  ErrorEstimate estimate = otherErrors(*at(setting).result.view());
  addDiscretization(errors, 1, spread.length, estimate);
  return estimate;
}

}  // namespace palpate
