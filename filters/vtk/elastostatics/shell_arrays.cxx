// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "sentence.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace palpate::convert
{
namespace
{
/// The array of a name, or null.
vtkDataArray* checkedArray(vtkFieldData* data, const char* name, vtkIdType count, int components)
{
  vtkDataArray* array = data->GetArray(name);
  if (array && (array->GetNumberOfTuples() != count || array->GetNumberOfComponents() != components))
  {
    refuse("the array '", name, "' must hold ", count, " by ", components, " numbers, not ",
      array->GetNumberOfTuples(), " by ", array->GetNumberOfComponents());
  }
  return array;
}

vtkDataArray* heldArrayOf(vtkPolyData* surface)
{
  return checkedArray(
    surface->GetPointData(), arrays::HeldComponents, surface->GetNumberOfPoints(), 6);
}

/// What an array holds of a vertex.
Eigen::Array<bool, 6, 1> heldAt(vtkDataArray* array, vtkIdType vertex)
{
  Eigen::Array<bool, 6, 1> held;
  for (int k = 0; k < 6; ++k)
  {
    const double value = array->GetComponent(vertex, k);
    if (value != 0 && value != 1)
    {
      refuse("held component ", k, " of vertex ", vertex, " must be 0 or 1, not ", value);
    }
    held[k] = value != 0;
  }
  return held;
}

Eigen::VectorXd numbersOf(vtkDataArray* array)
{
  Eigen::VectorXd numbers(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = array->GetComponent(i, 0);
  }
  return numbers;
}
} // namespace

BoundaryConditions shellConditionsOf(vtkPolyData* surface)
{
  std::vector<unsigned char> types = boundaryTypesOf(surface, true);
  if (vtkDataArray* array = heldArrayOf(surface))
  {
    for (std::size_t v = 0; v < types.size(); ++v)
    {
      if (heldAt(array, static_cast<vtkIdType>(v)).head<3>().all())
      {
        types[v] = 1;
      }
    }
  }
  return BoundaryConditions(std::move(types));
}

Eigen::Matrix3Xd shellThicknessOf(vtkPolyData* surface, const SurfaceMesh& mesh, double everywhere)
{
  if (everywhere != 0)
  {
    if (!(everywhere > 0))
    {
      refuse("the thickness of a shell must be a positive number, not ", everywhere);
    }
    return thicknessOfVertices(mesh, Eigen::VectorXd::Constant(mesh.vertexCount(), everywhere));
  }
  vtkDataArray* ofPoints =
    checkedArray(surface->GetPointData(), arrays::Thickness, mesh.vertexCount(), 1);
  vtkDataArray* ofCells =
    checkedArray(surface->GetCellData(), arrays::Thickness, mesh.triangleCount(), 1);
  if (ofPoints && ofCells)
  {
    refuse("the surface has a thickness of its points and another of its cells: leave one array '",
      arrays::Thickness, "' out");
  }
  if (!ofPoints && !ofCells)
  {
    refuse("the shell has no thickness: give one number, or a point or cell array '",
      arrays::Thickness, "'");
  }
  return ofPoints ? thicknessOfVertices(mesh, numbersOf(ofPoints))
                  : thicknessOfTriangles(mesh, numbersOf(ofCells));
}

HeldComponents heldComponentsOf(
  vtkPolyData* surface, const BoundaryConditions& conditions, bool clamped)
{
  HeldComponents held = heldComponents(conditions, clamped);
  vtkDataArray* array = heldArrayOf(surface);
  for (Eigen::Index v = 0; array && v < held.cols(); ++v)
  {
    const Eigen::Array<bool, 6, 1> given = heldAt(array, v);
    if (given.head<3>().all())
    {
      held.col(v) = given;
    }
    else
    {
      held.col(v) = held.col(v) || given;
    }
  }
  return held;
}

void readShellArrays(vtkPolyData* surface, const SurfaceMesh& mesh, GreensFunctionsInfo& info)
{
  const bool clamped =
    fieldNumber(surface, arrays::Clamped, "compute the Green's functions again") != 0;
  const HeldComponents held = heldComponentsOf(surface, info.conditions, clamped);
  info.rotationsHeld = areRotationsHeld(info.conditions, held);
  info.fingerprint = shellFingerprint(info.fingerprint, shellThicknessOf(surface, mesh, 0), held);
}

void setShellArrays(vtkPolyData* surface, double everywhere, bool clamped)
{
  setFieldNumber(surface, arrays::Clamped, clamped);
  setFieldNumber(surface, arrays::SmoothAngle, OnePatchAngle);
  if (everywhere != 0)
  {
    setPointNumbers(surface, arrays::Thickness,
      Eigen::VectorXd::Constant(surface->GetNumberOfPoints(), everywhere));
    surface->GetCellData()->RemoveArray(arrays::Thickness);
  }
}
} // namespace palpate::convert
