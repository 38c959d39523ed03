// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

class SurfaceMesh;

/// Numbers the smooth patches of a surface: the sets of triangles that can be reached from each
/// other without crossing an edge whose triangles' normals differ by more than an angle.
/// @param smoothAngle  degrees, 0..180; 180 makes every shell one patch (one traction per vertex).
/// @return #F patch numbers, counted from 0 in the order of the lowest triangle.
/// @throws std::invalid_argument for an angle outside [0, 180].
Eigen::VectorXi findSmoothPatches(const SurfaceMesh& mesh, double smoothAngle);

}  // namespace palpate
