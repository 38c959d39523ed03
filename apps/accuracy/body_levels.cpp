// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/body_levels.h"

#include <conversion.h>
#include <model_arrays.h>
#include <shell_arrays.h>
#include <smooth_patch_arrays.h>
#include <volume_arrays.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <utility>

#include "mesh/smooth_patches.h"
#include "mesh/tetrahedral_refinement.h"
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

Subdivision subdivisionOf(const AccuracyOptions& options, Domain domain, bool isFilled) {
  if (options.subdivision.empty())
    return isFilled                     ? Subdivision::Flat
           : domain == Domain::Interior ? Subdivision::Loop
           : domain == Domain::Shell    ? Subdivision::Curved
                                        : Subdivision::Flat;
  const Subdivision chosen = subdivisionNamed(options.subdivision);
  if (isFilled && chosen != Subdivision::Flat)
    refuse("--subdivision ", options.subdivision,
           " would move the surface off its tetrahedra: of a volume mesh it is flat");
  if (domain != Domain::Interior && chosen == Subdivision::Loop)
    refuse("--subdivision loop is one of closed surfaces: choose flat or curved with --method ",
           options.method);
  return chosen;
}

}  // namespace

BodyLevels::BodyLevels(vtkPolyData* surface, vtkUnstructuredGrid* volume, int levels,
                       const AccuracyOptions& options)
    : domain_(domainOf(methodNamed(options.method))) {
  const Subdivision subdivision = subdivisionOf(options, domain_, volume != nullptr);
  if (isSolid() && surface->GetPointData()->HasArray("HeldComponents"))
    refuse(
        "the surface has the point array 'HeldComponents', which levels of solids do not keep: "
        "take "
        "it away, or compare models of several meshes by --reference");
  const ElasticModel first = convert::modelOf(surface, kSmoothAngle, domain_);
  const bool isInherited = !isSolid() || subdivision == Subdivision::Curved ||
                           convert::hasGivenPatches(surface, first.mesh());
  material_ = first.material();
  levels_.push_back({first.sharedMesh(), first.conditions(), first.smoothPatches(), {}});
  if (domain_ == Domain::Shell) {
    levels_[0].thickness = convert::shellThicknessOf(surface, first.mesh(), options.thickness);
    levels_[0].held = convert::heldComponentsOf(surface, first.conditions(), !options.hinged);
  }
  if (volume) fill(volume);
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
    if (isFilled())
      fine.tetrahedra =
          std::make_shared<const TetrahedralMesh>(refineTetrahedra(*coarse.tetrahedra));
    levels_.push_back(std::move(fine));
  }
}

void BodyLevels::fill(vtkUnstructuredGrid* volume) {
  auto mesh = std::make_shared<const TetrahedralMesh>(convert::tetrahedraOf(volume));
  convert::CellMaterials cells = convert::materialsOf(volume, material_);
  levels_[0].tetrahedra = std::move(mesh);
  materials_ = std::move(cells.materials);
  materialOfCell_ = std::move(cells.ofCell);
}

SolidBody BodyLevels::filling(int level) const {
  const TetrahedralMesh& mesh = *at(level).tetrahedra;
  std::vector<int> materialOfCell(materialOfCell_.empty() ? 0 : mesh.cellCount());
  const int perCell = mesh.cellCount() / at(1).tetrahedra->cellCount();  // in the order of level 1
  for (std::size_t cell = 0; cell < materialOfCell.size(); ++cell)
    materialOfCell[cell] = materialOfCell_[cell / perCell];
  return SolidBody(this->mesh(level), mesh, materials_, std::move(materialOfCell));
}

bool BodyLevels::isNearlyIncompressible() const {
  if (!isFilled()) return material_.poissonRatio() >= Elasticity::kSplitFrom;
  return std::any_of(materials_.begin(), materials_.end(),
                     [](const Elasticity& material) { return material.isSplit(); });
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
