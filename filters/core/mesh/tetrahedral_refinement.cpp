// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedral_refinement.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace palpate {
namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr int kOpposite[3][2] = {{0, 5}, {1, 4}, {2, 3}};  // edges without a corner in common
// The ring of edges between each of these pairs, in which neighbours share a face.
constexpr int kRings[3][4] = {{1, 2, 4, 3}, {0, 2, 5, 3}, {0, 1, 5, 4}};

}  // namespace

TetrahedralMesh refineTetrahedra(const TetrahedralMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : mesh.points().colwise()) points.emplace_back(point);
  std::map<std::pair<int, int>, int> middles;
  const auto middleOf = [&](int a, int b) {
    const auto [entry, isNew] = middles.emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (isNew) points.push_back((mesh.points().col(a) + mesh.points().col(b)) / 2);
    return entry->second;
  };
  Eigen::Matrix4Xi cells(4, 8 * mesh.cellCount());
  int next = 0;
  for (const auto& corners : mesh.tetrahedra().colwise()) {
    int middle[6];
    for (int e = 0; e < 6; ++e) middle[e] = middleOf(corners[kEdges[e][0]], corners[kEdges[e][1]]);
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector4i cell(corners[k], 0, 0, 0);
      int at = 1;
      for (int e = 0; e < 6; ++e)
        if (kEdges[e][0] == k || kEdges[e][1] == k) cell[at++] = middle[e];
      cells.col(next++) = cell;
    }
    const auto length = [&](int pair) {
      return (points[middle[kOpposite[pair][0]]] - points[middle[kOpposite[pair][1]]]).norm();
    };
    int shortest = 0;
    for (int pair = 1; pair < 3; ++pair)
      if (length(pair) < length(shortest)) shortest = pair;
    for (int k = 0; k < 4; ++k)
      cells.col(next++) << middle[kOpposite[shortest][0]], middle[kOpposite[shortest][1]],
          middle[kRings[shortest][k]], middle[kRings[shortest][(k + 1) % 4]];
  }
  Eigen::Matrix3Xd all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) all.col(i) = points[i];
  return {std::move(all), std::move(cells)};
}

}  // namespace palpate
