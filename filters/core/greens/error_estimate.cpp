// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "mesh/coarsening.h"
#include "mesh/edge_subdivision.h"
#include "model/support.h"

namespace palpate {
namespace {

constexpr int kLoads = 24;
constexpr double kSupportedOrder = 1.25, kSquareOrder = 2;
constexpr double kUsualCondition = 1e4;
constexpr double kLockingRatio = 0.25;  // of edges to walls, half of that of the coarser mesh
constexpr int kLeastVertices = 50, kLeastOfThird = 30;
constexpr int kMostRefined = 400;        // vertices of a model that is refined for its estimate
constexpr double kQuadratureShare = 30;  // errors of answers over that of integrated rotations

int patchCount(const Eigen::VectorXi& patches) {
  return static_cast<int>(std::set<int>(patches.begin(), patches.end()).size());
}

/// Whether the support's traction reaches beyond it, as it shares a smooth patch.
bool hasBluntSupport(const ElasticModel& model) {
  return patchCount(splitAtSupport(model.mesh(), model.conditions(), model.smoothPatches())) >
         patchCount(model.smoothPatches());
}

/// The model on another mesh; none if that has defects or leaves the body free.
std::optional<OtherMesh> otherMesh(const ElasticModel& model, Eigen::Matrix3Xd points,
                                   Eigen::Matrix3Xi triangles, std::vector<unsigned char> types,
                                   Eigen::VectorXi patches) {
  try {
    auto mesh = std::make_shared<SurfaceMesh>(std::move(points), std::move(triangles));
    const double ratio = double(mesh->vertexCount()) / model.mesh().vertexCount();
    return OtherMesh{ElasticModel(mesh, model.material(), BoundaryConditions(std::move(types)),
                                  std::move(patches), model.domain()),
                     {},
                     std::sqrt(ratio > 1 ? ratio : 1 / ratio)};
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

void estimateByCoarser(const ElasticModel& model, const OtherMesh& coarser,
                       const EstimatedMethod& method, const GreensFunctions& greens,
                       const Progress& progress, ErrorEstimate& estimate) {
  const double order = discretizationOrder(greens), gain = std::pow(coarser.ratio, order);
  const auto coarse = method.solve(coarser.model, progress.part(0, 0.5));
  const SurfaceMesh& mesh = coarser.model.mesh();
  SpreadLoads loads = errorLoads(coarser.model);
  const LoadDifferences differences =
      compareUnderLoads(greens, model.mesh(), *coarse, mesh, coarser.vertices, loads);
  if (!differences.field.empty()) {
    addDiscretization(differences, 1 / (gain - 1), loads.length, estimate);
  } else if (const auto third = coarsenedModel(coarser.model, kLeastOfThird)) {
    const auto coarsest = method.solve(third->model, progress.part(0.8, 1));
    const double factor = 1 / (std::pow(third->ratio, order) - 1) / gain;
    loads = errorLoads(third->model);
    addDiscretization(
        compareUnderLoads(*coarse, mesh, *coarsest, third->model.mesh(), third->vertices, loads),
        factor, loads.length, estimate);
    for (int& vertex : loads.vertices) vertex = third->vertices[vertex];
  }
  if (estimate.discretization < 0 || !method.bluntSupports || !hasBluntSupport(model)) return;
  const auto sharp = method.solve(withSupportPatch(coarser.model), progress.part(0.5, 0.8));
  addDiscretization(compareUnderLoads(*sharp, mesh, *coarse, mesh, loads), 1 / coarser.ratio,
                    loads.length, estimate);
}

void estimateByFiner(const ElasticModel& model, const OtherMesh& finer,
                     const EstimatedMethod& method, const GreensFunctions& greens,
                     const Progress& progress, ErrorEstimate& estimate) {
  const bool isBlunt = method.bluntSupports && hasBluntSupport(model);
  const auto fine = method.solve(isBlunt ? withSupportPatch(finer.model) : finer.model, progress);
  const std::vector<int> free = model.conditions().freeNodes();
  const bool isWhole =
      std::all_of(free.begin(), free.end(), [&](int node) { return greens.hasColumn(node); });
  const auto whole = isWhole ? nullptr : method.solve(model, progress.part(1, 1));
  const double gain = std::pow(finer.ratio, discretizationOrder(*fine));
  const SpreadLoads loads = errorLoads(model);
  addDiscretization(
      compareUnderLoads(*fine, finer.model.mesh(), isWhole ? greens : *whole, model.mesh(), loads),
      isBlunt ? 1 : gain / (gain - 1), loads.length, estimate);
}

}  // namespace

SpreadLoads errorLoads(const ElasticModel& model) {
  return chooseSpreadLoads(model.mesh(), model.conditions(), kLoads);
}

void addDiscretization(const LoadDifferences& differences, double factor, double length,
                       ErrorEstimate& estimate) {
  if (differences.field.empty()) return;
  estimate.loadLength = length;
  const auto add = [factor](double difference, double& error) {
    error = std::max(error, 0.0) + factor * difference;
  };
  add(LoadDifferences::mean(differences.field), estimate.discretization);
  add(LoadDifferences::mean(differences.contact), estimate.contact);
  add(LoadDifferences::most(differences.field), estimate.mostDiscretization);
  add(LoadDifferences::most(differences.contact), estimate.mostContact);
}

double discretizationOrder(const GreensFunctions& finer) {
  const GreensFunctionsInfo& info = finer.info();
  const bool locks = info.diagnostics.wallRatio > kLockingRatio;
  return locks || info.conditions.fixedNodes().empty() ? kSquareOrder : kSupportedOrder;
}

ErrorEstimate otherErrors(const GreensFunctions& greens) {
  const Diagnostics& diagnostics = greens.info().diagnostics;
  ErrorEstimate estimate;
  estimate.integration = kQuadratureShare * diagnostics.rotationDefect;
  const double condition = diagnostics.conditionEstimate;  // not known of iterative solves
  // Where a method has no residual, its rounding is part of the rigid rotation's error.
  estimate.solver =
      std::max(diagnostics.solverResidual, 0.0) * (condition > 0 ? condition : kUsualCondition);
  estimate.storage = greens.epsilon() / 2;
  return estimate;
}

std::optional<OtherMesh> refinedModel(const ElasticModel& model) {
  SubdivisionLevel level = subdivideCurved(model.mesh(), model.smoothPatches());
  std::vector<unsigned char> types = refineBoundaryTypes(level, model.conditions().types());
  Eigen::VectorXi patches = refineSmoothPatches(level, model.smoothPatches());
  return otherMesh(model, std::move(level.points), std::move(level.triangles), std::move(types),
                   std::move(patches));
}

std::optional<OtherMesh> coarsenedModel(const ElasticModel& model, int leastVertices) {
  const int count = model.mesh().vertexCount();
  if (count < 4 * leastVertices) return std::nullopt;
  CoarsenedSurface surface = coarsen(model.mesh().points(), model.mesh().triangles(),
                                     model.conditions().types(), model.smoothPatches(), count / 4);
  if (surface.points.cols() > count / 2) return std::nullopt;
  std::optional<OtherMesh> coarser =
      otherMesh(model, std::move(surface.points), std::move(surface.triangles),
                std::move(surface.boundaryTypes), std::move(surface.smoothPatches));
  if (coarser) coarser->vertices = std::move(surface.vertices);
  return coarser;
}

ErrorEstimate estimateError(const ElasticModel& model, const EstimatedMethod& method,
                            const GreensFunctions& greens, const Progress& progress) {
  ErrorEstimate estimate = otherErrors(greens);
  const auto attempt = [&](const auto& by) {
    ErrorEstimate attempted = estimate;
    try {
      by(attempted);
      estimate = attempted;
    } catch (const Aborted&) {
      throw;
    } catch (const std::exception&) {
      // The other mesh's system is singular or too large, or there is no OpenMesh.
    }
  };
  attempt([&](ErrorEstimate& attempted) {
    if (const auto coarser = coarsenedModel(model, kLeastVertices))
      estimateByCoarser(model, *coarser, method, greens, progress, attempted);
  });
  if (estimate.discretization >= 0 || model.mesh().vertexCount() > kMostRefined) return estimate;
  attempt([&](ErrorEstimate& attempted) {
    if (const auto finer = refinedModel(model))
      estimateByFiner(model, *finer, method, greens, progress, attempted);
  });
  return estimate;
}

}  // namespace palpate
