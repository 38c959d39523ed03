// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkLoopRefinement.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/loop_subdivision.h"
#include "model_arrays.h"
#include "smooth_patch_arrays.h"
#include "progress.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkLoopRefinement);

void vtkLoopRefinement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << "\n";
}

namespace
{
/// Patches that were found on the coarse surface are to be found anew; given ones are inherited.
void removeFoundPatches(vtkPolyData* input, vtkPolyData* output)
{
  namespace convert = palpate::convert;
  if (!convert::hasField(input, palpate::arrays::SmoothAngle))
  {
    return;
  }
  output->GetFieldData()->RemoveArray(palpate::arrays::SmoothAngle);
  const palpate::SurfaceMesh mesh(convert::pointsOf(input), convert::trianglesOf(input));
  if (!convert::hasGivenPatches(input, mesh))
  {
    output->GetCellData()->RemoveArray(palpate::arrays::SmoothPatch);
  }
}
} // namespace

void vtkLoopRefinement::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  if (this->NumberOfLevels == 0)
  {
    return;
  }
  removeFoundPatches(input, output);
  convert::removeMeshResults(output);
  const bool hasTypes = input->GetPointData()->HasArray(palpate::arrays::BoundaryType);
  for (int step = 0; step < this->NumberOfLevels; ++step)
  {
    if (!this->ReportProgress(double(step) / this->NumberOfLevels, "refine"))
    {
      throw palpate::Aborted();
    }
    vtkNew<vtkPolyData> coarse;
    coarse->ShallowCopy(output);
    const palpate::LoopLevel level =
      palpate::subdivideLoop(convert::pointsOf(coarse), convert::trianglesOf(coarse));

    convert::setSurface(output, level.points, level.triangles);
    vtkPointData* points = output->GetPointData();
    points->Initialize();
    points->InterpolateAllocate(coarse->GetPointData(), level.points.cols());
    for (Eigen::Index v = 0; v < level.points.cols(); ++v)
    {
      points->InterpolateEdge(
        coarse->GetPointData(), v, level.parents(0, v), level.parents(1, v), 0.5);
    }
    if (hasTypes)
    {
      convert::setBoundaryTypes(
        output, palpate::refineBoundaryTypes(level, convert::boundaryTypesOf(coarse, false)));
    }
    vtkCellData* cells = output->GetCellData();
    cells->Initialize();
    cells->CopyAllocate(coarse->GetCellData(), level.triangles.cols());
    for (Eigen::Index f = 0; f < level.triangles.cols(); ++f)
    {
      cells->CopyData(coarse->GetCellData(), level.parentTriangle[f], f);
    }
  }
  this->ReportProgress(1, "refine");
}
