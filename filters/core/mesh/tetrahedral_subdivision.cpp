// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedral_subdivision.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace palpate {
namespace {

// Edges of a tetrahedron, opposite ones at i and 5 - i; for each diagonal between the middles of
// opposite edges, the middles of the four others in their order about it.
constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr int kAround[3][4] = {{1, 2, 4, 3}, {0, 2, 5, 3}, {0, 1, 5, 4}};

}  // namespace

TetrahedralMesh subdivided(const TetrahedralMesh& mesh) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : mesh.points().colwise()) points.emplace_back(point);
  const auto middleOf = [&](int a, int b) {
    const auto [found, isNew] = middles.emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (isNew) points.push_back((mesh.points().col(a) + mesh.points().col(b)) / 2);
    return found->second;
  };
  Eigen::Matrix4Xi cells(4, 8 * mesh.cellCount());
  Eigen::Index next = 0;
  for (const auto& cell : mesh.tetrahedra().colwise()) {
    int middle[6];
    for (int e = 0; e < 6; ++e) middle[e] = middleOf(cell[kEdges[e][0]], cell[kEdges[e][1]]);
    for (int corner = 0; corner < 4; ++corner) {
      int used = 0;
      cells(used++, next) = cell[corner];
      for (int e = 0; e < 6; ++e)
        if (kEdges[e][0] == corner || kEdges[e][1] == corner) cells(used++, next) = middle[e];
      ++next;
    }
    const auto length = [&](int e) { return (points[middle[e]] - points[middle[5 - e]]).norm(); };
    int shortest = 0;
    for (int e = 1; e < 3; ++e)
      if (length(e) < length(shortest)) shortest = e;
    for (int k = 0; k < 4; ++k)
      cells.col(next++) << middle[shortest], middle[5 - shortest], middle[kAround[shortest][k]],
          middle[kAround[shortest][(k + 1) % 4]];
  }
  Eigen::Matrix3Xd all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) all.col(i) = points[i];
  return {std::move(all), std::move(cells)};
}

}  // namespace palpate
