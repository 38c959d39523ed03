// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkSurfaceRefinement.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/smooth_patches.h"
#include "mesh/subdivision.h"
#include "mesh/surface_mesh.h"
#include "model_arrays.h"
#include "progress.h"
#include "smooth_patch_arrays.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceRefinement);

void vtkSurfaceRefinement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << "\n"
     << indent << "Subdivision: " << this->Subdivision << "\n"
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

void inheritCellData(vtkPolyData* coarse, const palpate::SubdivisionLevel& level, vtkPolyData* fine)
{
  vtkCellData* cells = fine->GetCellData();
  cells->Initialize();
  cells->CopyAllocate(coarse->GetCellData(), level.triangles.cols());
  for (Eigen::Index f = 0; f < level.triangles.cols(); ++f)
  {
    cells->CopyData(coarse->GetCellData(), level.parentTriangle[f], f);
  }
}
} // namespace

void vtkSurfaceRefinement::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  if (this->NumberOfLevels == 0)
  {
    return;
  }
  convert::removeMeshResults(output);
  for (int step = 0; step < this->NumberOfLevels; ++step)
  {
    if (!this->ReportProgress(double(step) / this->NumberOfLevels, "refine"))
    {
      throw palpate::Aborted();
    }
    vtkNew<vtkPolyData> coarse;
    coarse->ShallowCopy(output);
    const palpate::SurfaceMesh mesh(convert::pointsOf(coarse), convert::trianglesOf(coarse));
    if (step == 0)
    {
      convert::removeFoundPatches(coarse, mesh);
    }
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
    inheritCellData(coarse, level, output);
  }
  this->ReportProgress(1, "refine");
}
