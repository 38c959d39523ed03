// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "progress.h"

namespace palpate {

/// Another mesh of a surface, and what it takes over.
struct RemeshedSurface {
  Eigen::Matrix3Xd points;                   ///< 3 by #V
  Eigen::Matrix3Xi triangles;                ///< 3 by #F
  std::vector<unsigned char> boundaryTypes;  ///< #V, 0 free or 1 fixed
  Eigen::VectorXi smoothPatches;             ///< #F
};

/// Remeshes a surface to edges of about one length: edges are split, collapsed and flipped, and
/// vertices relaxed and projected onto the old surface (Botsch and Kobbelt 2004, by CGAL). The rims
/// of smooth patches and of the support keep their place: a triangle belongs to the support if all
/// its corners are fixed, and a vertex of the new mesh is fixed if it belongs to such a triangle.
/// @param points         3 by #V.
/// @param triangles      3 by #F, a closed manifold.
/// @param boundaryTypes  #V, 0 or 1.
/// @param smoothPatches  #F.
/// @param edgeLength     wanted, in the points' unit, > 0 and below the surface's diagonal.
/// @param iterations     1 to 100; 3 settle.
/// @throws std::invalid_argument for sizes that do not fit, an edge length that is out of range or
///         would give more than ten million triangles, or a fixed vertex that no fixed triangle
///         holds; std::runtime_error if the result bounds no body or the library was built without
///         CGAL; Aborted.
RemeshedSurface remeshIsotropic(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                                const std::vector<unsigned char>& boundaryTypes,
                                const Eigen::VectorXi& smoothPatches, double edgeLength,
                                int iterations = 3, const ProgressCallback& progress = {});

}  // namespace palpate
