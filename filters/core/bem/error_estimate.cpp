// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/error_estimate.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "mesh/coarsening.h"
#include "mesh/curved_refinement.h"

namespace palpate {
namespace {

constexpr double kBluntOrder = 1, kSharpOrder = 1.25, kSmoothOrder = 1.5;
constexpr int kLeastVertices = 35;
constexpr int kMostRefined = 400;        // vertices of a model that is refined for its estimate
constexpr double kQuadratureShare = 10;  // errors of answers over that of integrated rotations

/// Whether hats of the support's traction reach beyond it: its triangles share a smooth patch.
bool hasBluntSupport(const ElasticModel& model) {
  const SurfaceMesh& mesh = model.mesh();
  std::vector<bool> holds(model.smoothPatches().maxCoeff() + 1), gives(holds.size());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    bool isSupport = true;
    for (int v : mesh.triangles().col(f)) isSupport = isSupport && model.conditions().isFixed(v);
    (isSupport ? holds : gives)[model.smoothPatches()[f]] = true;
  }
  for (std::size_t patch = 0; patch < holds.size(); ++patch)
    if (holds[patch] && gives[patch]) return true;
  return false;
}

template <class Surface>
std::optional<OtherMesh> otherMesh(const ElasticModel& model, Surface surface,
                                   std::vector<int> vertices) {
  try {
    auto mesh =
        std::make_shared<SurfaceMesh>(std::move(surface.points), std::move(surface.triangles));
    const double ratio = double(mesh->vertexCount()) / model.mesh().vertexCount();
    return OtherMesh{
        ElasticModel(mesh, model.material(), BoundaryConditions(std::move(surface.boundaryTypes)),
                     std::move(surface.smoothPatches), model.domain()),
        std::move(vertices), std::sqrt(ratio > 1 ? ratio : 1 / ratio)};
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::shared_ptr<const GreensFunctions> solve(const ElasticModel& model,
                                             const BoundaryElementOptions& options,
                                             const Progress& progress) {
  BoundaryElementOptions all;
  all.collocation = options.collocation;
  all.tolerance = options.tolerance;
  all.reciprocal = options.reciprocal;
  all.threads = options.threads;
  return computeBoundaryElementGreensFunctions(model, all,
                                               [&](double fraction, const char*) {
                                                 progress.report(fraction, "estimate");
                                                 return true;
                                               })
      .take();
}

void estimateByCoarser(const ElasticModel& model, const OtherMesh& coarser,
                       const BoundaryElementOptions& options, const GreensFunctions& greens,
                       const Progress& progress, ErrorEstimate& estimate) {
  const double order = discretizationOrder(model), gain = std::pow(coarser.ratio, order);
  const auto coarse = solve(coarser.model, options, progress.part(0, 0.8));
  ProbeLoads loads =
      chooseProbeLoads(coarser.model.mesh(), coarser.model.conditions(), kErrorLoads);
  setDiscretization(compareUnderLoads(greens, model.mesh(), *coarse, coarser.model.mesh(),
                                      coarser.vertices, loads),
                    1 / (gain - 1), loads.length, estimate);
  if (estimate.discretization >= 0) return;
  const auto third = coarsenedModel(coarser.model);
  if (!third) return;
  const auto coarsest = solve(third->model, options, progress.part(0.8, 1));
  loads = chooseProbeLoads(third->model.mesh(), third->model.conditions(), kErrorLoads);
  setDiscretization(compareUnderLoads(*coarse, coarser.model.mesh(), *coarsest, third->model.mesh(),
                                      third->vertices, loads),
                    1 / (std::pow(third->ratio, order) - 1) / gain, loads.length, estimate);
}

void estimateByFiner(const ElasticModel& model, const OtherMesh& finer,
                     const BoundaryElementOptions& options, const GreensFunctions& greens,
                     const Progress& progress, ErrorEstimate& estimate) {
  const double gain = std::pow(finer.ratio, discretizationOrder(model));
  const auto fine = solve(finer.model, options, progress);
  const ProbeLoads loads = chooseProbeLoads(model.mesh(), model.conditions(), kErrorLoads);
  setDiscretization(
      compareUnderLoads(*fine, finer.model.mesh(), greens, model.mesh(), finer.vertices, loads),
      gain / (gain - 1), loads.length, estimate);
}

}  // namespace

void setDiscretization(const LoadDifferences& differences, double factor, double length,
                       ErrorEstimate& estimate) {
  if (differences.field.empty()) return;
  estimate.loadLength = length;
  estimate.discretization = factor * LoadDifferences::mean(differences.field);
  estimate.contact = factor * LoadDifferences::mean(differences.contact);
  estimate.mostDiscretization = factor * LoadDifferences::most(differences.field);
  estimate.mostContact = factor * LoadDifferences::most(differences.contact);
}

double discretizationOrder(const ElasticModel& model) {
  if (model.conditions().fixedNodes().empty()) return kSmoothOrder;
  return hasBluntSupport(model) ? kBluntOrder : kSharpOrder;
}

ErrorEstimate otherErrors(const GreensFunctions& greens) {
  const Diagnostics& diagnostics = greens.info().diagnostics;
  ErrorEstimate estimate;
  estimate.integration = kQuadratureShare * diagnostics.rotationDefect;
  estimate.solver = diagnostics.solverResidual * diagnostics.conditionEstimate;
  estimate.storage = greens.epsilon() / 2;
  return estimate;
}

std::optional<OtherMesh> refinedModel(const ElasticModel& model) {
  std::vector<int> vertices(model.mesh().vertexCount());
  std::iota(vertices.begin(), vertices.end(), 0);
  return otherMesh(model,
                   refineCurved(model.mesh(), model.conditions().types(), model.smoothPatches()),
                   std::move(vertices));
}

std::optional<OtherMesh> coarsenedModel(const ElasticModel& model) {
  const int count = model.mesh().vertexCount();
  if (count < 4 * kLeastVertices) return std::nullopt;
  CoarsenedSurface surface = coarsen(model.mesh().points(), model.mesh().triangles(),
                                     model.conditions().types(), model.smoothPatches(), count / 4);
  if (surface.points.cols() > count / 2) return std::nullopt;
  std::vector<int> vertices = std::move(surface.vertices);
  return otherMesh(model, std::move(surface), std::move(vertices));
}

ErrorEstimate estimateError(const ElasticModel& model, const BoundaryElementOptions& options,
                            const GreensFunctions& greens, const Progress& progress) {
  ErrorEstimate estimate = otherErrors(greens);
  try {
    if (const auto coarser = coarsenedModel(model))
      estimateByCoarser(model, *coarser, options, greens, progress, estimate);
    if (estimate.discretization >= 0 || model.mesh().vertexCount() > kMostRefined) return estimate;
    if (const auto finer = refinedModel(model))
      estimateByFiner(model, *finer, options, greens, progress, estimate);
  } catch (const Aborted&) {
    throw;
  } catch (const std::runtime_error&) {
    // The other mesh's system is singular, or there is no OpenMesh: no estimate.
  }
  return estimate;
}

}  // namespace palpate
