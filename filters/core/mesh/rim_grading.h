// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

namespace palpate {

class SurfaceMesh;

/// A surface whose triangles were cut into layers along the rim of its support, with the way back.
struct GradedSurface {
  Eigen::Matrix3Xd points;     ///< the old vertices, then the new ones
  Eigen::Matrix3Xi triangles;  ///< 3 by any
  /// 2 by #points, vertices between which a new one lies, each before it; twice itself for an old
  /// one.
  Eigen::Matrix2Xi parents;
  Eigen::VectorXd share;            ///< #points, of the second parent
  std::vector<int> parentTriangle;  ///< #triangles

  /// The old vertices between which a point lies, with their shares.
  std::map<int, double> ancestors(int point) const;
};

/// How far from the rim a layer ends, as a part of the way to where the one before ended.
constexpr double kLayerShare = 0.25;

/// Cuts the triangles at the rim of the support, where stresses are singular: every edge that
/// leaves the rim gets a vertex at a quarter of its length, once for each layer, so that the layers
/// get thinner towards the rim from both sides while their triangles stay as long along it. The
/// surface stays where it is. Displacements go with the root of the distance from the rim and
/// tractions with its inverse, so that the error of responses goes with the width of the last
/// layer: each layer cuts it fourfold, as halving all edges does with the error of smooth fields.
/// Edges between two vertices of the rim that are not part of it are halved first. Triangles with
/// all three edges on it stay whole. A surface without a rim stays as it is.
/// @param types   #V, 0 free or 1 fixed; the support's triangles have three fixed corners.
/// @param layers  at least 0.
/// @throws std::invalid_argument for types of another number, or fewer layers.
GradedSurface gradeTowardsSupport(const SurfaceMesh& mesh, const std::vector<unsigned char>& types,
                                  int layers);

/// A new vertex is fixed if both its parents are.
/// @param types  of the old vertices.
std::vector<unsigned char> gradedBoundaryTypes(const GradedSurface& graded,
                                               const std::vector<unsigned char>& types);

/// New triangles have their parents' patch.
/// @param patches  of the old triangles.
Eigen::VectorXi gradedSmoothPatches(const GradedSurface& graded, const Eigen::VectorXi& patches);

}  // namespace palpate
