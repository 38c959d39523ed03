// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpate {

/// A Loop subdivision surface one step finer than its control mesh, with the way back.
struct LoopLevel {
  Eigen::Matrix3Xd points;     ///< 3 by #V + #E: the control vertices, moved, then one per edge
  Eigen::Matrix3Xi triangles;  ///< 3 by 4 #F
  /// 2 by #V + #E: the ends of the edge that a new vertex comes from; twice itself for an old one.
  Eigen::Matrix2Xi parents;
  std::vector<int> parentTriangle;  ///< 4 #F
};

/// One step of Loop's scheme (C. Loop, "Smooth subdivision surfaces based on triangles", 1987;
/// [JP01] section 3.2), by OpenMesh.
/// @param points     3 by #V.
/// @param triangles  3 by #F, a closed manifold.
/// @throws std::invalid_argument if they are none; std::runtime_error when the library was built
///         without OpenMesh.
LoopLevel subdivideLoop(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);

/// Carries boundary types along: a new vertex is fixed if both ends of its edge are.
/// @param types  #V values 0 or 1.
/// @throws std::invalid_argument if there is not one for each control vertex.
std::vector<unsigned char> refineBoundaryTypes(const LoopLevel& level,
                                               const std::vector<unsigned char>& types);

}  // namespace palpate
