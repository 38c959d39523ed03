// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

class SurfaceMesh;

/// Where Loop's scheme (subdivideLoop), repeated for ever, leads the vertices of a closed control
/// mesh: the points of its smooth surface that belong to them. Those of a subdivided mesh are the
/// same (H. Hoppe et al., "Piecewise smooth surface reconstruction", 1994, section 4).
/// @return 3 by #V.
/// @throws std::invalid_argument for a mesh with rims.
Eigen::Matrix3Xd loopLimit(const SurfaceMesh& mesh);

/// A share of the way to the limit at which flat triangles enclose what the surface does: where all
/// valences are 6 the control mesh is too large by what chords of the surface are too small, both
/// of the second order of the edges.
constexpr double kVolumeShare = 0.5;

/// Vertices moved so far from a control mesh towards their limit.
/// @param share  0 to 1.
/// @return 3 by #V.
Eigen::Matrix3Xd towardsLoopLimit(const SurfaceMesh& mesh, double share);

}  // namespace palpate
