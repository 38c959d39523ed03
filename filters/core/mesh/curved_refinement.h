// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/remeshing.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// Splits every triangle in four on the surface that its mesh stands for: old vertices stay and
/// come first, new ones, one per edge, lie on the cubic through its ends that is perpendicular to
/// the normals there (A. Vlachos et al., "Curved PN triangles", 2001). Flat parts stay flat, edges
/// between smooth patches straight.
/// @param boundaryTypes  #V, 0 free or 1 fixed; a new vertex is fixed if both ends of its edge are.
/// @param smoothPatches  #F.
/// @throws std::invalid_argument for sizes that do not fit.
RemeshedSurface refineCurved(const SurfaceMesh& mesh,
                             const std::vector<unsigned char>& boundaryTypes,
                             const Eigen::VectorXi& smoothPatches);

}  // namespace palpate
