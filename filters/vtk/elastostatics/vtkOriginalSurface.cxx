// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkOriginalSurface.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/surface_map.h"
#include "original_arrays.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <memory>
#include <string>

vtkStandardNewMacro(vtkOriginalSurface);

namespace
{
namespace arrays = palpate::arrays;
namespace convert = palpate::convert;

/// Values at places between the corners of triangles, of the array's own type.
vtkSmartPointer<vtkDataArray> interpolated(vtkDataArray* values, const palpate::SurfaceMesh& mesh,
  const std::vector<palpate::SurfacePoint>& places)
{
  const auto result = vtkSmartPointer<vtkDataArray>::Take(values->NewInstance());
  result->SetName(values->GetName());
  result->SetNumberOfComponents(values->GetNumberOfComponents());
  result->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
  for (std::size_t v = 0; v < places.size(); ++v)
  {
    for (int k = 0; k < values->GetNumberOfComponents(); ++k)
    {
      double sum = 0;
      for (int corner = 0; corner < 3; ++corner)
      {
        sum += places[v].barycentric[corner] *
          values->GetComponent(mesh.triangles()(corner, places[v].triangle), k);
      }
      result->SetComponent(static_cast<vtkIdType>(v), k, sum);
    }
  }
  return result;
}

/// Those of real numbers; vertex areas are the mesh's own.
void carryPointData(vtkPolyData* from, const palpate::SurfaceMesh& mesh,
  const std::vector<palpate::SurfacePoint>& places, vtkPolyData* to)
{
  for (int i = 0; i < from->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* values = from->GetPointData()->GetArray(i);
    if (values && values->GetName() && values->GetName() != std::string(arrays::VertexArea) &&
      (values->GetDataType() == VTK_DOUBLE || values->GetDataType() == VTK_FLOAT))
    {
      to->GetPointData()->AddArray(interpolated(values, mesh, places));
    }
  }
  if (!from->GetPointData()->HasArray(arrays::BoundaryType))
  {
    return;
  }
  const std::vector<unsigned char> types = convert::boundaryTypesOf(from, false);
  std::vector<unsigned char> carried;
  for (const palpate::SurfacePoint& place : places)
  {
    double fixed = 0;
    for (int corner = 0; corner < 3; ++corner)
    {
      fixed += place.barycentric[corner] * types[mesh.triangles()(corner, place.triangle)];
    }
    carried.push_back(fixed > 0.5);
  }
  convert::setBoundaryTypes(to, carried);
}

void carryCellData(vtkPolyData* from, const std::shared_ptr<const palpate::SurfaceMesh>& mesh,
  const palpate::SurfaceMesh& original, vtkPolyData* to)
{
  if (from->GetCellData()->GetNumberOfArrays() == 0)
  {
    return;
  }
  Eigen::Matrix3Xd middles(3, original.triangleCount());
  for (int f = 0; f < original.triangleCount(); ++f)
  {
    middles.col(f) = original.points()(Eigen::all, original.triangles().col(f)).rowwise().mean();
  }
  const palpate::SurfaceMap map = palpate::mapOnto(mesh, middles, original.triangleNormals());
  vtkCellData* cells = to->GetCellData();
  cells->CopyAllOn();
  cells->CopyAllocate(from->GetCellData(), original.triangleCount());
  for (int f = 0; f < original.triangleCount(); ++f)
  {
    cells->CopyData(from->GetCellData(), map.places[f].triangle, f);
  }
}
} // namespace

void vtkOriginalSurface::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  const palpate::SurfaceMesh original = convert::originalOf(input);
  const auto mesh = std::make_shared<const palpate::SurfaceMesh>(
    convert::pointsOf(input), convert::trianglesOf(input));
  const std::vector<palpate::SurfacePoint> places =
    convert::originalPlacesOf(input, *mesh, original.vertexCount());
  output->Initialize();
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  convert::removeGreensFunctions(output);
  for (const char* name : arrays::OriginalSurface)
  {
    output->GetFieldData()->RemoveArray(name);
  }
  convert::setSurface(output, original.points(), original.triangles());
  carryPointData(input, *mesh, places, output);
  carryCellData(input, mesh, original, output);
}
