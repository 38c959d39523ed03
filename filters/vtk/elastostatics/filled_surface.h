// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_filled_surface_h
#define palpate_filled_surface_h

#include "mesh/surface_mesh.h"
#include "mesh/tetrahedral_mesh.h"
#include "progress.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <string>

class vtkPolyData;

/// Surfaces that finite elements fill. Not for wrapping.
namespace palpate::convert
{
/// A surface's filling with tetrahedra.
struct FilledSurface
{
  TetrahedralMesh mesh;
  /// What bounds it where that has other triangles than the surface, else null. It has the surface's point
  /// and cell data: those of its vertices, which come first and in their order, interpolated at new ones,
  /// and of the nearest triangle. A new vertex is fixed where all corners of that triangle are.
  vtkSmartPointer<vtkPolyData> boundary;
  std::string warning; // how many triangles are others; empty where there is no such boundary
};

/// @param mesh      of the surface.
/// @param cellSize  as of palpate::tetrahedralize, which this throws as.
FilledSurface fillSurface(vtkPolyData* surface, const std::shared_ptr<const SurfaceMesh>& mesh,
  double cellSize, const ProgressCallback& progress);

/// Puts the boundary of a filling in place of an output's own surface, and takes away what belonged to
/// that; an original that the surface stands for stays with it.
/// @param mesh  of the boundary.
void setBoundary(vtkPolyData* output, vtkPolyData* surface, vtkPolyData* boundary,
  const std::shared_ptr<const SurfaceMesh>& mesh);
} // namespace palpate::convert

#endif
