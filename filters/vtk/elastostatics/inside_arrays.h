// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_inside_arrays_h
#define palpate_inside_arrays_h

#include "greens/greens_functions.h"

class vtkPolyData;

/// What a method that fills a body tells of its inside, as field arrays: what its weight does, and rows of
/// probes (see array_names.h). Not for wrapping.
namespace palpate::convert
{
/// Adds what there is of it.
void setInside(vtkPolyData* surface, const GreensFunctionsInfo& info);

/// Sets weightResponse, density and probes to what the surface carries.
/// @throws std::invalid_argument for an array that has not the size or the finite values that it must
///         have.
void readInside(vtkPolyData* surface, GreensFunctionsInfo& info);

/// Adds SurfaceElasticity.
/// @param materials  behind each triangle.
void setSurfaceElasticity(vtkPolyData* surface, const std::vector<Elasticity>& materials);

/// The same, read; nothing without the array.
/// @param factor  by which all is stiffer than it was.
/// @throws std::invalid_argument for an array of another size or of what is no elastic material.
std::vector<Elasticity> surfaceElasticityOf(vtkPolyData* surface, double factor);
} // namespace palpate::convert

#endif
