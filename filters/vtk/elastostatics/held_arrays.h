// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_held_arrays_h
#define palpate_held_arrays_h

#include "fem/solid_elements.h"
#include "greens/greens_functions.h"

class vtkPolyData;

/// Single components of displacement that are held, as an array of polydata (see array_names.h). Not for
/// wrapping.
namespace palpate::convert
{
/// Of a solid's surface, 3 by #points; empty without the array HeldComponents, or where it holds nothing
/// of a free vertex.
/// @throws std::invalid_argument if the array is not of 3 or 6 components, 0 or 1 each.
HeldDisplacements heldDisplacementsOf(vtkPolyData* surface, const BoundaryConditions& conditions);

/// Takes them into account, of a surface that carries Green's functions that were made with them.
/// @param info  of its model, with modelFingerprint.
void readHeldArrays(vtkPolyData* surface, GreensFunctionsInfo& info);
} // namespace palpate::convert

#endif
