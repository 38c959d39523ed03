// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/subdivision.h"

namespace palpate {

/// Every triangle cut in four by the middles of its edges: the same body on a finer mesh.
SubdivisionLevel subdivideFlat(const SurfaceMesh& mesh);

/// Every triangle split in four on the surface that the mesh stands for: old vertices stay, new
/// ones lie on the cubic through the ends of their edge that is perpendicular to the normals there
/// (A. Vlachos et al., "Curved PN triangles", 2001). Flat parts stay flat, edges between smooth
/// patches straight.
/// @param smoothPatches  #F.
/// @throws std::invalid_argument if there is not one for each triangle.
SubdivisionLevel subdivideCurved(const SurfaceMesh& mesh, const Eigen::VectorXi& smoothPatches);

}  // namespace palpate
