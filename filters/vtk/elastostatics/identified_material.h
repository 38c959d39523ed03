// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_identified_material_h
#define palpate_identified_material_h

#include "identification/measurements.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

/// Materials that are identified, and the surfaces they are of. Not for wrapping.
namespace palpate::convert
{
/// A copy of a surface with a material that only stands for the one that will be found.
vtkSmartPointer<vtkPolyData> withAnyMaterial(vtkPolyData* surface);

/// Regions of the tetrahedra of a grid, in their order; empty where it has none, or is null.
/// @param count  of regions, set.
std::vector<int> regionsOf(vtkUnstructuredGrid* grid, int& count);

/// Says that a Young's modulus is more than a hundred times larger or smaller than the one of a surface's
/// own field data; empty where it is not, or the surface has none.
std::string unitDoubt(vtkPolyData* surface, double youngsModulus);

/// "250 displacements under 5 probes (rig.csv)".
/// @param file  empty for a table that came as data.
std::string countOf(const Measurements& measurements, const std::string& file);
/// The last part of it, with the blank before.
std::string tableNamed(const std::string& file);
} // namespace palpate::convert

#endif
