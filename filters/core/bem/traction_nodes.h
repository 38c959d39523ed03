// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <numeric>
#include <vector>

namespace palpate::bem {

/// The traction nodes of a surface: one per vertex and smooth patch around it, so that traction may
/// jump across sharp edges while displacement stays continuous. On a smooth surface they coincide
/// with the vertices, as in [JP01]. Numbered by vertex, then by patch number.
struct TractionNodes {
  /// @param vertexCount  #V
  /// @param triangles    3 by #F
  /// @param areas        #F
  /// @param patch        #F, smooth patch of each triangle
  TractionNodes(int vertexCount, const Eigen::Matrix3Xi& triangles, const Eigen::VectorXd& areas,
                const Eigen::VectorXi& patch);

  int count() const { return static_cast<int>(vertex.size()); }
  int first(int v) const { return firstOfVertex[v]; }
  int end(int v) const { return firstOfVertex[v + 1]; }
  std::vector<int> ofVertex(int v) const {
    std::vector<int> nodes(end(v) - first(v));
    std::iota(nodes.begin(), nodes.end(), first(v));
    return nodes;
  }

  Eigen::Matrix3Xi ofCorner;       ///< 3 by #F, node of each triangle's corner
  std::vector<int> vertex;         ///< #nodes
  std::vector<int> patch;          ///< #nodes
  std::vector<double> area;        ///< #nodes, integral of the hat function over the patch
  std::vector<int> firstOfVertex;  ///< #V + 1
};

}  // namespace palpate::bem
