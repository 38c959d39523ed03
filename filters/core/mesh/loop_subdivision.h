// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/subdivision.h"

namespace palpate {

/// One step of Loop's scheme (C. Loop, "Smooth subdivision surfaces based on triangles", 1987;
/// [JP01] section 3.2), by OpenMesh: the vertices move towards the smooth surface that they
/// control.
/// @param points     3 by #V.
/// @param triangles  3 by #F, a closed manifold.
/// @throws std::invalid_argument if they are none; std::runtime_error when the library was built
///         without OpenMesh.
SubdivisionLevel subdivideLoop(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);

}  // namespace palpate
