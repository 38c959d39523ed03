// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "smooth_patch_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/smooth_patches.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"
#include "model/support.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>

namespace palpate::convert
{
Eigen::VectorXi storedPatches(vtkPolyData* surface)
{
  vtkDataArray* array = surface->GetCellData()->GetArray(arrays::SmoothPatch);
  if (!array)
  {
    return {};
  }
  if (array->GetNumberOfTuples() != surface->GetNumberOfCells() ||
    array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(
      std::string("the cell array '") + arrays::SmoothPatch + "' must hold a number a cell");
  }
  Eigen::VectorXi patches(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < patches.size(); ++i)
  {
    patches[i] = wholeNumber(array->GetComponent(i, 0), "the smooth patch of triangle ", i);
  }
  return patches;
}

bool hasGivenPatches(vtkPolyData* surface, const SurfaceMesh& mesh)
{
  const Eigen::VectorXi stored = storedPatches(surface);
  if (stored.size() == 0 || !hasField(surface, arrays::SmoothAngle))
  {
    return stored.size() > 0;
  }
  const double angle = fieldNumber(surface, arrays::SmoothAngle, "compute the patches again");
  if (!(angle >= 0 && angle <= 180))
  {
    return true;
  }
  const Eigen::VectorXi found = findSmoothPatches(mesh, angle);
  return stored != found &&
    stored != splitAtSupport(mesh, BoundaryConditions(boundaryTypesOf(surface, true)), found);
}

void setSmoothPatches(vtkPolyData* surface, const Eigen::VectorXi& patches)
{
  vtkNew<vtkIntArray> array;
  array->SetName(arrays::SmoothPatch);
  for (int patch : patches)
  {
    array->InsertNextValue(patch);
  }
  surface->GetCellData()->AddArray(array);
}

void removeFoundPatches(vtkPolyData* surface, const SurfaceMesh& mesh)
{
  if (hasField(surface, arrays::SmoothAngle) && !hasGivenPatches(surface, mesh))
  {
    surface->GetCellData()->RemoveArray(arrays::SmoothPatch);
  }
  surface->GetFieldData()->RemoveArray(arrays::SmoothAngle);
}
} // namespace palpate::convert
