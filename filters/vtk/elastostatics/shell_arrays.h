// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_shell_arrays_h
#define palpate_shell_arrays_h

#include "greens/greens_functions.h"
#include "shell/thin_shell.h"

class vtkPolyData;

/// What makes a surface a shell, as arrays of polydata (see array_names.h). Not for wrapping. All
/// functions throw std::invalid_argument with a sentence for data that cannot be used.
namespace palpate::convert
{
/// For findSmoothPatches: a shell takes one traction a vertex, folds or none.
constexpr double OnePatchAngle = 180;

/// The boundary types of a surface, all free if it has none, and fixed where HeldComponents hold all of
/// the displacement.
BoundaryConditions shellConditionsOf(vtkPolyData* surface);

/// The thickness at the corners of the triangles.
/// @param everywhere  if not 0 the thickness of all; else the point or the cell array Thickness gives it.
Eigen::Matrix3Xd shellThicknessOf(vtkPolyData* surface, const SurfaceMesh& mesh, double everywhere);

/// What is held: fixed vertices, clamped or not, and what HeldComponents hold besides; a vertex whose
/// whole displacement these hold, as they say.
HeldComponents heldComponentsOf(
  vtkPolyData* surface, const BoundaryConditions& conditions, bool clamped);

/// Takes both into account, of a surface that carries the Green's functions of a shell.
/// @param info  of its model, with modelFingerprint.
void readShellArrays(vtkPolyData* surface, const SurfaceMesh& mesh, GreensFunctionsInfo& info);

/// Adds to a surface that has been given the Green's functions of a shell what else they depend on.
/// @param everywhere, clamped  as above.
void setShellArrays(vtkPolyData* surface, double everywhere, bool clamped);
} // namespace palpate::convert

#endif
