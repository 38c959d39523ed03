// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/body_levels.h"

#include <conversion.h>
#include <model_arrays.h>
#include <shell_arrays.h>
#include <smooth_patch_arrays.h>

#include "mesh/smooth_patches.h"
#include "model/support.h"
#include "sentence.h"
#include "shell/shell_refinement.h"
#include "subdivision_option.h"

namespace palpate::app {
namespace {

constexpr double kSmoothAngle = 30;  // degrees, as `precompute` takes it

Domain domainOf(Method method) {
  return method == Method::ThinShell   ? Domain::Shell
         : method == Method::HalfSpace ? Domain::HalfSpace
                                       : Domain::Interior;
}

Subdivision subdivisionOf(const AccuracyOptions& options, Domain domain) {
  if (options.subdivision.empty())
    return domain == Domain::Interior ? Subdivision::Loop
           : domain == Domain::Shell  ? Subdivision::Curved
                                      : Subdivision::Flat;
  const Subdivision chosen = subdivisionNamed(options.subdivision);
  if (domain != Domain::Interior && chosen == Subdivision::Loop)
    refuse("--subdivision loop is one of closed surfaces: choose flat or curved with --method ",
           options.method);
  return chosen;
}

}  // namespace

BodyLevels::BodyLevels(vtkPolyData* surface, int levels, const AccuracyOptions& options)
    : domain_(domainOf(methodNamed(options.method))) {
  const Subdivision subdivision = subdivisionOf(options, domain_);
  const ElasticModel first = convert::modelOf(surface, kSmoothAngle, domain_);
  const bool isInherited = !isSolid() || subdivision == Subdivision::Curved ||
                           convert::hasGivenPatches(surface, first.mesh());
  material_ = first.material();
  levels_.push_back({first.sharedMesh(), first.conditions(), first.smoothPatches(), {}});
  if (domain_ == Domain::Shell) {
    levels_[0].thickness = convert::shellThicknessOf(surface, first.mesh(), options.thickness);
    levels_[0].held = convert::heldComponentsOf(surface, first.conditions(), !options.hinged);
  }
  while (count() < levels) {
    const Level& coarse = levels_.back();
    SubdivisionLevel made = subdivide(*coarse.mesh, coarse.patches, subdivision);
    auto mesh =
        std::make_shared<SurfaceMesh>(std::move(made.points), made.triangles, rimsOf(domain_));
    const Eigen::VectorXi patches = isInherited ? refineSmoothPatches(made, coarse.patches)
                                                : findSmoothPatches(*mesh, kSmoothAngle);
    const BoundaryConditions conditions(refineBoundaryTypes(made, coarse.conditions.types()));
    Level fine{mesh, conditions, patches, std::move(made)};
    if (domain_ == Domain::Shell) {
      fine.thickness = refineThickness(fine.made, coarse.mesh->triangles(), coarse.thickness);
      fine.held = refineHeldComponents(fine.made, coarse.held);
    }
    levels_.push_back(std::move(fine));
  }
}

bool BodyLevels::hasSharpEdges(int level) const {
  const SurfaceMesh& mesh = this->mesh(level);
  const Eigen::VectorXi& patches = at(level).patches;
  for (int v = 0; v < mesh.vertexCount(); ++v)
    for (int f : mesh.trianglesOfVertex(v))
      if (patches[f] != patches[*mesh.trianglesOfVertex(v).begin()]) return true;
  return false;
}

Eigen::VectorXi BodyLevels::patches(const Level& level, TractionJumps jumps) const {
  if (!isSolid()) return level.patches;
  if (jumps == TractionJumps::Nowhere) return Eigen::VectorXi::Zero(level.patches.size());
  if (jumps == TractionJumps::SharpEdges) return level.patches;
  return splitAtSupport(*level.mesh, level.conditions, level.patches);
}

ElasticModel BodyLevels::model(int level, TractionJumps jumps) const {
  const Level& found = at(level);
  return ElasticModel(found.mesh, material_, found.conditions, patches(found, jumps), domain_);
}

ThinShell BodyLevels::shell(int level, const ElasticModel& model) const {
  return ThinShell(model, at(level).thickness, at(level).held);
}

std::vector<SurfacePoint> BodyLevels::ancestors(const SurfacePoint& finest) const {
  std::vector<SurfacePoint> points{finest};
  for (int level = count(); level > 1; --level)
    points.insert(points.begin(),
                  parentPoint(at(level).made, mesh(level - 1).triangles(), points.front()));
  return points;
}

}  // namespace palpate::app
