// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpate {

/// A coarser mesh of a surface, its vertices some of the old ones.
struct CoarsenedSurface {
  Eigen::Matrix3Xd points;                   ///< 3 by #v
  Eigen::Matrix3Xi triangles;                ///< 3 by #f
  std::vector<int> vertices;                 ///< #v, their numbers in the surface, ascending
  std::vector<unsigned char> boundaryTypes;  ///< #v
  Eigen::VectorXi smoothPatches;             ///< #f
};

/// Takes vertices out of a surface, edges that are short for their neighbourhood first, by
/// collapses onto a neighbour (by OpenMesh). Graded meshes stay graded: edges grow everywhere by
/// about the same factor, the root of the numbers of vertices. The rims of smooth patches and of
/// the support (the triangles with three fixed corners) lose vertices along themselves alone and
/// keep corners that turn by more than 102 degrees; no triangle flips, turns by more than 60
/// degrees or becomes a sliver.
/// @param points         3 by #V.
/// @param triangles      3 by #F, a closed manifold.
/// @param boundaryTypes  #V, 0 free or 1 fixed.
/// @param smoothPatches  #F.
/// @param vertices       wanted, at least 4. More are left where rims and corners are too many.
/// @throws std::invalid_argument for sizes that do not fit or a surface that is no closed manifold;
///         std::runtime_error when the library was built without OpenMesh.
CoarsenedSurface coarsen(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                         const std::vector<unsigned char>& boundaryTypes,
                         const Eigen::VectorXi& smoothPatches, int vertices);

}  // namespace palpate
