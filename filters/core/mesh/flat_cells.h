// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// Takes tetrahedra without volume out of a mesh that fits together: four vertices on one circle,
/// such as those of a regular grid, may make such a cell of a Delaunay triangulation.
/// - Where it has two faces on the boundary it is left out, and the two others, of the same four
///   vertices, are in their place.
/// - Elsewhere a point is added where its diagonals cross: the cells around both are cut there, and
///   then fit together without it.
/// What has another shape is left.
/// @param points  added ones are behind those that are there.
void removeFlatCells(Eigen::Matrix3Xd& points, Eigen::Matrix4Xi& tetrahedra);

}  // namespace palpate
