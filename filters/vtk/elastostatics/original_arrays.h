// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_original_arrays_h
#define palpate_original_arrays_h

#include "mesh/surface_point.h"

#include <memory>
#include <vector>

class vtkPolyData;

/// The surface that another was remeshed from, and how it lies on it, as field data (see array_names.h).
/// Not for wrapping. All functions throw std::invalid_argument with a sentence for data that cannot be
/// used.
namespace palpate::convert
{
bool hasOriginal(vtkPolyData* surface);

/// The original surface that a surface carries.
SurfaceMesh originalOf(vtkPolyData* surface);

/// Where its points are on the surface that carries it.
/// @param mesh   of that surface.
/// @param count  of the original's points.
/// @throws also if the surface is another than the map was made for.
std::vector<SurfacePoint> originalPlacesOf(vtkPolyData* surface, const SurfaceMesh& mesh, int count);

/// Keeps an original with a surface that stands for it.
/// @param mesh  of that surface.
void setOriginal(
  vtkPolyData* surface, const std::shared_ptr<const SurfaceMesh>& mesh, const SurfaceMesh& original);
} // namespace palpate::convert

#endif
