// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_point.h"

namespace palpate {

class SurfaceMesh;

/// What a closed surface stands for when it is refined.
enum class Subdivision {
  Loop,    ///< the control mesh of a smooth surface (subdivideLoop)
  Flat,    ///< itself (subdivideFlat)
  Curved,  ///< a surface through its vertices, smooth but for its sharp edges (subdivideCurved)
};

/// A closed surface whose triangles were split in four, with the way back.
struct SubdivisionLevel {
  Eigen::Matrix3Xd points;     ///< 3 by #V + #E: the old vertices, then one per edge
  Eigen::Matrix3Xi triangles;  ///< 3 by 4 #F
  /// 2 by #V + #E: the ends of the edge that a new vertex comes from; twice itself for an old one.
  Eigen::Matrix2Xi parents;
  std::vector<int> parentTriangle;  ///< 4 #F
};

/// @param smoothPatches  #F; only Curved goes by them.
/// @throws std::invalid_argument for more than ten million triangles; as the subdivision asked for.
SubdivisionLevel subdivide(const SurfaceMesh& mesh, const Eigen::VectorXi& smoothPatches,
                           Subdivision subdivision);

/// Carries boundary types along: a new vertex is fixed if both ends of its edge are.
/// @param types  #V values 0 or 1.
/// @throws std::invalid_argument if there is not one for each old vertex.
std::vector<unsigned char> refineBoundaryTypes(const SubdivisionLevel& level,
                                               const std::vector<unsigned char>& types);

/// Carries smooth patches along.
/// @param patches  #F.
/// @return 4 #F.
Eigen::VectorXi refineSmoothPatches(const SubdivisionLevel& level, const Eigen::VectorXi& patches);

/// The point of the coarse triangles that a point of the level descends from.
/// @param coarse  3 by #F, what the level was made of.
SurfacePoint parentPoint(const SubdivisionLevel& level, const Eigen::Matrix3Xi& coarse,
                         const SurfacePoint& point);

}  // namespace palpate
