// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/subdivision.h"

namespace palpate {

/// One step of Loop's scheme (C. Loop, "Smooth subdivision surfaces based on triangles", 1987;
/// [JP01] section 3.2), by OpenMesh: the vertices move towards the smooth surface that they
/// control.
/// @throws std::runtime_error when the library was built without OpenMesh.
SubdivisionLevel subdivideLoop(const SurfaceMesh& surface);

}  // namespace palpate
