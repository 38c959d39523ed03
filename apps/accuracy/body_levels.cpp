// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/body_levels.h"

#include <conversion.h>
#include <model_arrays.h>
#include <smooth_patch_arrays.h>

#include "mesh/smooth_patches.h"
#include "model/support.h"

namespace palpate::app {
namespace {

constexpr double kSmoothAngle = 30;  // degrees, as `precompute` takes it

}  // namespace

BodyLevels::BodyLevels(vtkPolyData* surface, int levels, Subdivision subdivision) {
  const ElasticModel first = convert::modelOf(surface, kSmoothAngle, Domain::Interior);
  const bool isInherited =
      subdivision == Subdivision::Curved || convert::hasGivenPatches(surface, first.mesh());
  material_ = first.material();
  levels_.push_back({first.sharedMesh(), first.conditions(), first.smoothPatches(), {}});
  while (count() < levels) {
    const Level& coarse = levels_.back();
    SubdivisionLevel made = subdivide(*coarse.mesh, coarse.patches, subdivision);
    auto mesh = std::make_shared<SurfaceMesh>(std::move(made.points), made.triangles);
    const Eigen::VectorXi patches = isInherited ? refineSmoothPatches(made, coarse.patches)
                                                : findSmoothPatches(*mesh, kSmoothAngle);
    const BoundaryConditions conditions(refineBoundaryTypes(made, coarse.conditions.types()));
    levels_.push_back({mesh, conditions, patches, std::move(made)});
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
  if (jumps == TractionJumps::Nowhere) return Eigen::VectorXi::Zero(level.patches.size());
  if (jumps == TractionJumps::SharpEdges) return level.patches;
  return splitAtSupport(*level.mesh, level.conditions, level.patches);
}

ElasticModel BodyLevels::model(int level, TractionJumps jumps) const {
  const Level& found = at(level);
  return ElasticModel(found.mesh, material_, found.conditions, patches(found, jumps));
}

std::vector<SurfacePoint> BodyLevels::ancestors(const SurfacePoint& finest) const {
  std::vector<SurfacePoint> points{finest};
  for (int level = count(); level > 1; --level)
    points.insert(points.begin(),
                  parentPoint(at(level).made, mesh(level - 1).triangles(), points.front()));
  return points;
}

}  // namespace palpate::app
