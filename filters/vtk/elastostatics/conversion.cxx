// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <limits>
#include <stdexcept>

// Points and triangles.

namespace palpate::convert
{
namespace
{
/// VTK's ids as the core's indices; what cannot be one becomes -1, which validation names.
int indexOf(vtkIdType id)
{
  return id >= 0 && id <= std::numeric_limits<int>::max() ? static_cast<int>(id) : -1;
}

void requireIndexable(vtkPolyData* surface)
{
  if (surface->GetNumberOfPoints() > std::numeric_limits<int>::max() / 9 ||
    surface->GetNumberOfCells() > std::numeric_limits<int>::max() / 9)
  {
    throw std::invalid_argument("the surface has too many points or cells");
  }
}
} // namespace

Eigen::Matrix3Xd pointsOf(vtkPolyData* surface)
{
  requireIndexable(surface);
  Eigen::Matrix3Xd points(3, surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    surface->GetPoint(i, points.col(i).data());
  }
  return points;
}

bool hasOnlyTriangles(vtkPolyData* surface)
{
  return surface->GetNumberOfCells() == surface->GetNumberOfPolys() &&
    surface->GetPolys()->IsHomogeneous() == 3;
}

Eigen::Matrix3Xi trianglesOf(vtkPolyData* surface)
{
  requireIndexable(surface);
  vtkCellArray* polys = surface->GetPolys();
  const vtkIdType others = surface->GetNumberOfCells() - surface->GetNumberOfPolys();
  if (others > 0)
  {
    throw std::invalid_argument("the surface has " + std::to_string(others) +
      " vertex, line or strip cells: only triangles are allowed (vtkElasticMeshRepair or "
      "vtkTriangleFilter makes them)");
  }
  Eigen::Matrix3Xi triangles(3, surface->GetNumberOfPolys());
  auto cell = vtkSmartPointer<vtkCellArrayIterator>::Take(polys->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    const vtkIdType* ids;
    vtkIdType count;
    cell->GetCurrentCell(count, ids);
    if (count != 3)
    {
      throw std::invalid_argument("cell " + std::to_string(cell->GetCurrentCellId()) + " has " +
        std::to_string(count) + " corners: only triangles are allowed (vtkElasticMeshRepair or "
                                "vtkTriangleFilter makes them)");
    }
    for (int k = 0; k < 3; ++k)
    {
      triangles(k, cell->GetCurrentCellId()) = indexOf(ids[k]);
    }
  }
  return triangles;
}

Eigen::Matrix3Xi triangulatedCellsOf(vtkPolyData* surface)
{
  requireIndexable(surface);
  std::vector<Eigen::Vector3i> triangles;
  const auto add = [&](vtkIdType a, vtkIdType b, vtkIdType c)
  { triangles.emplace_back(indexOf(a), indexOf(b), indexOf(c)); };
  const auto forEachCell = [&](vtkCellArray* cells, auto&& action)
  {
    auto cell = vtkSmartPointer<vtkCellArrayIterator>::Take(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      const vtkIdType* ids;
      vtkIdType count;
      cell->GetCurrentCell(count, ids);
      action(ids, count);
    }
  };
  forEachCell(surface->GetPolys(),
    [&](const vtkIdType* ids, vtkIdType count)
    {
      for (vtkIdType k = 2; k < count; ++k)
      {
        add(ids[0], ids[k - 1], ids[k]);
      }
    });
  forEachCell(surface->GetStrips(),
    [&](const vtkIdType* ids, vtkIdType count)
    {
      for (vtkIdType k = 2; k < count; ++k)
      {
        k % 2 == 0 ? add(ids[k - 2], ids[k - 1], ids[k]) : add(ids[k - 1], ids[k - 2], ids[k]);
      }
    });
  Eigen::Matrix3Xi result(3, triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
  {
    result.col(f) = triangles[f];
  }
  return result;
}

void setSurface(
  vtkPolyData* surface, const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles)
{
  vtkNew<vtkPoints> vtkpoints;
  vtkpoints->SetDataTypeToDouble();
  vtkpoints->SetNumberOfPoints(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    vtkpoints->SetPoint(i, points.col(i).data());
  }
  vtkNew<vtkCellArray> polys;
  polys->AllocateExact(triangles.cols(), 3 * triangles.cols());
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
  {
    const vtkIdType ids[3] = { triangles(0, f), triangles(1, f), triangles(2, f) };
    polys->InsertNextCell(3, ids);
  }
  surface->SetPoints(vtkpoints);
  surface->SetVerts(nullptr);
  surface->SetLines(nullptr);
  surface->SetStrips(nullptr);
  surface->SetPolys(polys);
}
} // namespace palpate::convert
