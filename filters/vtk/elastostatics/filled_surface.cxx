// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "filled_surface.h"

#include "conversion.h"
#include "mesh/surface_locator.h"
#include "mesh/tetrahedralization.h"
#include "original_arrays.h"
#include "sentence.h"

#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <utility>
#include <vector>

namespace palpate::convert
{
namespace
{
vtkSmartPointer<vtkIdList> cornersAt(const SurfaceMesh& mesh, int triangle)
{
  auto corners = vtkSmartPointer<vtkIdList>::New();
  for (int corner : mesh.triangles().col(triangle))
  {
    corners->InsertNextId(corner);
  }
  return corners;
}

/// Point data of vertices, interpolated at new ones, which are fixed where all about them are.
void carryPoints(const Eigen::Matrix3Xd& points, const SurfaceMesh& mesh, const SurfaceLocator& locator,
  vtkPolyData* surface, vtkPolyData* boundary)
{
  const int kept = mesh.vertexCount(), count = static_cast<int>(points.cols());
  std::vector<unsigned char> types = boundaryTypesOf(surface, true);
  vtkPointData* data = boundary->GetPointData();
  data->CopyAllOn();
  data->InterpolateAllocate(surface->GetPointData(), count);
  for (int v = 0; v < count; ++v)
  {
    if (v < kept)
    {
      data->CopyData(surface->GetPointData(), v, v);
      continue;
    }
    const SurfacePoint place = locator.nearest(points.col(v));
    double weights[3] = { place.barycentric[0], place.barycentric[1], place.barycentric[2] };
    data->InterpolatePoint(surface->GetPointData(), v, cornersAt(mesh, place.triangle), weights);
    bool isFixed = true;
    for (int corner : mesh.triangles().col(place.triangle))
    {
      isFixed = isFixed && types[corner] != 0;
    }
    types.push_back(isFixed);
  }
  setBoundaryTypes(boundary, types);
}

/// Cell data of the nearest triangles.
void carryCells(
  const TetrahedralMesh& filling, const SurfaceLocator& locator, vtkPolyData* surface, vtkPolyData* boundary)
{
  const Eigen::Matrix3Xi& triangles = filling.boundary();
  vtkCellData* data = boundary->GetCellData();
  data->CopyAllOn();
  data->CopyAllocate(surface->GetCellData(), triangles.cols());
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int corner : triangles.col(f))
    {
      middle += filling.points().col(corner) / 3;
    }
    data->CopyData(surface->GetCellData(), locator.nearest(middle).triangle, f);
  }
}

vtkSmartPointer<vtkPolyData> boundaryOf(
  const Tetrahedralization& filled, const std::shared_ptr<const SurfaceMesh>& mesh, vtkPolyData* surface)
{
  const Eigen::Matrix3Xd points =
    filled.mesh.points().leftCols(mesh->vertexCount() + filled.newBoundaryPoints);
  auto boundary = vtkSmartPointer<vtkPolyData>::New();
  boundary->ShallowCopy(surface);
  setSurface(boundary, points, filled.mesh.boundary());
  const SurfaceLocator locator(mesh);
  carryPoints(points, *mesh, locator, surface, boundary);
  carryCells(filled.mesh, locator, surface, boundary);
  return boundary;
}
} // namespace

FilledSurface fillSurface(vtkPolyData* surface, const std::shared_ptr<const SurfaceMesh>& mesh,
  double cellSize, const ProgressCallback& progress)
{
  Tetrahedralization filled = tetrahedralize(*mesh, cellSize, progress);
  vtkSmartPointer<vtkPolyData> boundary;
  std::string warning;
  if (filled.lostTriangles > 0)
  {
    boundary = boundaryOf(filled, mesh, surface);
    warning = sentence(filled.lostTriangles, " of ", mesh->triangleCount(),
      " triangles of the surface are others now, with ", filled.newBoundaryPoints,
      " new vertices: those that its filling with tetrahedra has");
  }
  return { std::move(filled.mesh), boundary, warning };
}

void setBoundary(vtkPolyData* output, vtkPolyData* surface, vtkPolyData* boundary,
  const std::shared_ptr<const SurfaceMesh>& mesh)
{
  output->CopyStructure(boundary);
  output->GetPointData()->ShallowCopy(boundary->GetPointData());
  output->GetCellData()->ShallowCopy(boundary->GetCellData());
  removeMeshResults(output);
  if (hasOriginal(surface))
  {
    setOriginal(output, mesh, originalOf(surface));
  }
}
} // namespace palpate::convert
