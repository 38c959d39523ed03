// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/traction_nodes.h"

#include <algorithm>
#include <utility>

namespace palpate::bem {

TractionNodes::TractionNodes(int vertexCount, const Eigen::Matrix3Xi& triangles,
                             const Eigen::VectorXd& areas, const Eigen::VectorXi& patchOfTriangle)
    : ofCorner(3, triangles.cols()), firstOfVertex(vertexCount + 1, 0) {
  std::vector<std::pair<int, int>> keys;  // (vertex, patch)
  keys.reserve(3 * triangles.cols());
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) keys.emplace_back(triangles(k, f), patchOfTriangle[f]);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  for (const auto& [v, p] : keys) {
    vertex.push_back(v);
    patch.push_back(p);
    ++firstOfVertex[v + 1];
  }
  for (int v = 0; v < vertexCount; ++v) firstOfVertex[v + 1] += firstOfVertex[v];
  area.assign(keys.size(), 0);
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> key(triangles(k, f), patchOfTriangle[f]);
      const auto node = std::lower_bound(keys.begin(), keys.end(), key) - keys.begin();
      ofCorner(k, f) = static_cast<int>(node);
      area[node] += areas[f] / 3;
    }
}

}  // namespace palpate::bem
