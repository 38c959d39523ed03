// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_volume_arrays_h
#define palpate_volume_arrays_h

#include "mesh/tetrahedral_mesh.h"
#include "model/elasticity.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

/// Tetrahedra and their materials from VTK's data, and the surfaces that bound them. Not for wrapping. All
/// functions throw std::invalid_argument with a sentence for data that cannot be used.
namespace palpate::convert
{
/// The tetrahedra of a grid, its points numbered as they are there but for those of no tetrahedron;
/// cells of lower dimension, which meshers write too, are left out.
TetrahedralMesh tetrahedraOf(vtkUnstructuredGrid* grid);

/// The boundary of a grid's tetrahedra, with the grid's point and field data. Where its cells have
/// materials and its field data none, those in the mean are the boundary's: a unit for the model.
vtkSmartPointer<vtkPolyData> boundaryOf(vtkUnstructuredGrid* grid);

/// Materials as the cell arrays of a grid give them (see vtkFiniteElementGreensFunctions).
struct CellMaterials
{
  std::vector<Elasticity> materials; // each once
  std::vector<int> ofCell;           // #tetrahedra, empty where there is one material
  Eigen::VectorXd densities;         // #tetrahedra, kg/m^3, empty where there is no such array
};
/// @param otherwise  where the grid has no such arrays.
CellMaterials materialsOf(vtkUnstructuredGrid* grid, const Material& otherwise);

/// Hash of a grid's tetrahedra and of the materials that its own arrays give.
std::uint64_t gridFingerprint(const TetrahedralMesh& mesh, const CellMaterials& materials);
} // namespace palpate::convert

#endif
