// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_refinement.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "greens/error_estimate.h"
#include "shell/shell_greens_functions.h"

namespace palpate {
namespace {

constexpr int kMostRefined = 1000;
constexpr double kFinerOverCoarser = 1.0 / 2;  // errors of half as long edges

}  // namespace

Eigen::Matrix3Xd refineThickness(const SubdivisionLevel& level, const Eigen::Matrix3Xi& coarse,
                                 const Eigen::Matrix3Xd& thickness) {
  Eigen::Matrix3Xd fine(3, level.triangles.cols());
  for (int f = 0; f < fine.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const SurfacePoint parent = parentPoint(level, coarse, {f, Eigen::Vector3d::Unit(k)});
      fine(k, f) = thickness.col(parent.triangle).dot(parent.barycentric);
    }
  return fine;
}

HeldComponents refineHeldComponents(const SubdivisionLevel& level, const HeldComponents& held) {
  HeldComponents fine(6, level.parents.cols());
  for (Eigen::Index v = 0; v < fine.cols(); ++v)
    fine.col(v) = held.col(level.parents(0, v)) && held.col(level.parents(1, v));
  return fine;
}

ErrorEstimate estimateShellError(const ElasticModel& model, const ThinShell& shell,
                                 const GreensFunctions& greens, const Progress& progress) {
  ErrorEstimate estimate = otherErrors(greens);
  if (model.mesh().vertexCount() > kMostRefined) return estimate;
  try {
    SubdivisionLevel level = subdivide(model.mesh(), model.smoothPatches(), Subdivision::Curved);
    const ElasticModel finer(
        std::make_shared<const SurfaceMesh>(std::move(level.points), level.triangles,
                                            Rims::Allowed),
        model.material(),
        BoundaryConditions(refineBoundaryTypes(level, model.conditions().types())),
        refineSmoothPatches(level, model.smoothPatches()), Domain::Shell);
    const ThinShell finerShell(finer,
                               refineThickness(level, model.mesh().triangles(), shell.thickness()),
                               refineHeldComponents(level, shell.held()));
    const auto fine =
        computeShellGreensFunctions(finer, finerShell, {}, progress.callback()).take();
    const SpreadLoads loads = errorLoads(model);
    addDiscretization(compareUnderLoads(*fine, finer.mesh(), greens, model.mesh(), loads),
                      1 / (1 - kFinerOverCoarser), loads.length, estimate);
  } catch (const Aborted&) {
    throw;
  } catch (const std::exception&) {
    // The finer mesh has defects, or its system is singular or too large.
  }
  return estimate;
}

}  // namespace palpate
