// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/tetrahedral_mesh.h"

namespace palpate {

/// The same body in cells of half as long edges: each tetrahedron becomes four at its corners and
/// four about the shortest diagonal of what they leave (Bey 1995). Points are the old ones, then
/// one an edge; cells 8 i to 8 i + 7 come from cell i.
TetrahedralMesh subdivided(const TetrahedralMesh& mesh);

}  // namespace palpate
