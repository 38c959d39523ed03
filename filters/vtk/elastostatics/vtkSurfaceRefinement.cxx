// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkSurfaceRefinement.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/loop_limit.h"
#include "mesh/rim_grading.h"
#include "mesh/smooth_patches.h"
#include "mesh/subdivision.h"
#include "mesh/surface_mesh.h"
#include "model_arrays.h"
#include "progress.h"
#include "smooth_patch_arrays.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceRefinement);

void vtkSurfaceRefinement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << "\n"
     << indent << "SupportLayers: " << this->SupportLayers << "\n"
     << indent << "Subdivision: " << this->Subdivision << "\n"
     << indent << "LimitShare: " << this->LimitShare << "\n"
     << indent << "SmoothAngle: " << this->SmoothAngle << "\n";
}

namespace
{
namespace convert = palpate::convert;

void interpolatePointData(vtkPolyData* coarse, const palpate::SubdivisionLevel& level, vtkPolyData* fine)
{
  vtkPointData* points = fine->GetPointData();
  points->Initialize();
  points->InterpolateAllocate(coarse->GetPointData(), level.points.cols());
  for (Eigen::Index v = 0; v < level.points.cols(); ++v)
  {
    points->InterpolateEdge(coarse->GetPointData(), v, level.parents(0, v), level.parents(1, v), 0.5);
  }
  if (coarse->GetPointData()->HasArray(palpate::arrays::BoundaryType))
  {
    convert::setBoundaryTypes(
      fine, palpate::refineBoundaryTypes(level, convert::boundaryTypesOf(coarse, false)));
  }
}

void interpolatePointData(vtkPolyData* coarse, const palpate::GradedSurface& graded, vtkPolyData* fine)
{
  vtkPointData* points = fine->GetPointData();
  points->Initialize();
  points->InterpolateAllocate(coarse->GetPointData(), graded.points.cols());
  vtkNew<vtkIdList> ids;
  std::vector<double> shares;
  for (Eigen::Index v = 0; v < graded.points.cols(); ++v)
  {
    ids->Reset();
    shares.clear();
    for (const auto& [ancestor, share] : graded.ancestors(static_cast<int>(v)))
    {
      ids->InsertNextId(ancestor);
      shares.push_back(share);
    }
    points->InterpolatePoint(coarse->GetPointData(), v, ids, shares.data());
  }
  convert::setBoundaryTypes(
    fine, palpate::gradedBoundaryTypes(graded, convert::boundaryTypesOf(coarse, false)));
}

void inheritCellData(vtkPolyData* coarse, const std::vector<int>& parentTriangle, vtkPolyData* fine)
{
  vtkCellData* cells = fine->GetCellData();
  cells->Initialize();
  cells->CopyAllocate(coarse->GetCellData(), parentTriangle.size());
  for (std::size_t f = 0; f < parentTriangle.size(); ++f)
  {
    cells->CopyData(coarse->GetCellData(), parentTriangle[f], f);
  }
}

void moveTowardsLimit(vtkPolyData* surface, double share)
{
  const palpate::SurfaceMesh mesh(convert::pointsOf(surface), convert::trianglesOf(surface));
  convert::setSurface(surface, palpate::towardsLoopLimit(mesh, share), mesh.triangles());
}

void grade(vtkPolyData* surface, int layers)
{
  vtkNew<vtkPolyData> coarse;
  coarse->ShallowCopy(surface);
  const palpate::SurfaceMesh mesh(convert::pointsOf(coarse), convert::trianglesOf(coarse));
  const palpate::GradedSurface graded =
    palpate::gradeTowardsSupport(mesh, convert::boundaryTypesOf(coarse, false), layers);
  convert::setSurface(surface, graded.points, graded.triangles);
  interpolatePointData(coarse, graded, surface);
  inheritCellData(coarse, graded.parentTriangle, surface);
}
} // namespace

void vtkSurfaceRefinement::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  const bool isMoved = this->LimitShare > 0 && this->Subdivision == LOOP;
  if (this->NumberOfLevels == 0 && this->SupportLayers == 0 && !isMoved)
  {
    return;
  }
  convert::removeMeshResults(output);
  if (this->NumberOfLevels > 0 || isMoved)
  {
    convert::removeFoundPatches(
      output, palpate::SurfaceMesh(convert::pointsOf(output), convert::trianglesOf(output)));
  }
  for (int step = 0; step < this->NumberOfLevels; ++step)
  {
    if (!this->ReportProgress(double(step) / this->NumberOfLevels, "refine"))
    {
      throw palpate::Aborted();
    }
    vtkNew<vtkPolyData> coarse;
    coarse->ShallowCopy(output);
    const palpate::SurfaceMesh mesh(convert::pointsOf(coarse), convert::trianglesOf(coarse));
    Eigen::VectorXi patches = convert::storedPatches(coarse);
    if (this->Subdivision == CURVED && patches.size() == 0)
    {
      patches = palpate::findSmoothPatches(mesh, this->SmoothAngle);
      convert::setSmoothPatches(coarse, patches);
    }
    const palpate::SubdivisionLevel level =
      palpate::subdivide(mesh, patches, static_cast<palpate::Subdivision>(this->Subdivision));
    output->ShallowCopy(coarse);
    convert::setSurface(output, level.points, level.triangles);
    interpolatePointData(coarse, level, output);
    inheritCellData(coarse, level.parentTriangle, output);
  }
  if (isMoved)
  {
    moveTowardsLimit(output, this->LimitShare);
  }
  if (this->SupportLayers > 0)
  {
    grade(output, this->SupportLayers);
  }
  this->ReportProgress(1, "refine");
}
