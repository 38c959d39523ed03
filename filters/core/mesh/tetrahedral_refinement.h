// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/tetrahedral_mesh.h"

namespace palpate {

/// Each tetrahedron cut into eight at the middles of its edges: four at its corners, and four round
/// the shortest diagonal of the octahedron that is left (J. Bey, Computing 55, 1995). Faces become
/// four triangles each, as those of a surface do that is subdivided flat.
/// @return  cells 8 t to 8 t + 7 fill cell t; the mesh's points come first.
TetrahedralMesh refineTetrahedra(const TetrahedralMesh& mesh);

}  // namespace palpate
