// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef smooth_patch_arrays_h
#define smooth_patch_arrays_h

#include <Eigen/Core>

class vtkPolyData;

namespace palpate
{
class SurfaceMesh;
}

namespace palpate::convert
{
/// #F, the SmoothPatch array, or an empty vector.
/// @throws std::invalid_argument if it does not hold a whole number a triangle.
Eigen::VectorXi storedPatches(vtkPolyData* surface);

/// @param patches  #F.
void setSmoothPatches(vtkPolyData* surface, const Eigen::VectorXi& patches);

/// Whether the surface's SmoothPatch array was given, and not found by an earlier computation: what that
/// computation's SmoothAngle finds on the surface, split at its support or not, is not what the array
/// holds.
/// @param mesh  of the surface.
bool hasGivenPatches(vtkPolyData* surface, const SurfaceMesh& mesh);

/// Removes patches that are to be found anew, as what they were found on changes; given ones stay.
/// @param mesh  of the surface.
void removeFoundPatches(vtkPolyData* surface, const SurfaceMesh& mesh);
} // namespace palpate::convert

#endif
