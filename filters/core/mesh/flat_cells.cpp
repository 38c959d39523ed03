// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/flat_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <vector>

namespace palpate {
namespace {

constexpr double kFlatVolume = 1e-9;  // over the longest edge cubed
constexpr double kLeastShare = 0.02;  // of a diagonal, on either side of a crossing
constexpr double kCrossing = 1e-6;    // how far crossing diagonals are apart, over their lengths
constexpr int kEdgePairs[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}};

double longestEdge(const Eigen::Matrix3Xd& points, const Eigen::Vector4i& cell) {
  double longest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      longest = std::max(longest, (points.col(cell[i]) - points.col(cell[j])).norm());
  return longest;
}

bool isFlat(const Eigen::Matrix3Xd& points, const Eigen::Vector4i& cell) {
  const double longest = longestEdge(points, cell);
  const auto edge = [&](int k) -> Eigen::Vector3d {
    return (points.col(cell[k]) - points.col(cell[0])) / longest;
  };
  return std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6 < kFlatVolume;
}

void leaveOutAtBoundary(const Eigen::Matrix3Xd& points, Eigen::Matrix4Xi& tetrahedra) {
  const auto face = [&](Eigen::Index cell, int opposite) {
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = tetrahedra((opposite + 1 + k) % 4, cell);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::vector<Eigen::Index> flat, kept;
  std::map<std::array<int, 3>, int> cellsAt;  // of the faces of flat cells
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    if (isFlat(points, tetrahedra.col(t))) {
      flat.push_back(t);
      for (int k = 0; k < 4; ++k) cellsAt[face(t, k)] = 0;
    }
  if (flat.empty()) return;
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    for (int k = 0; k < 4; ++k) {
      const auto found = cellsAt.find(face(t, k));
      if (found != cellsAt.end()) ++found->second;
    }
  const auto hasTwoOuterFaces = [&](Eigen::Index t) {
    int outer = 0;
    for (int k = 0; k < 4; ++k) outer += cellsAt.at(face(t, k)) == 1;
    return outer == 2;
  };
  std::vector<bool> isLeftOut(tetrahedra.cols(), false);
  for (auto next = flat.begin();
       (next = std::find_if(flat.begin(), flat.end(), hasTwoOuterFaces)) != flat.end();
       flat.erase(next)) {
    isLeftOut[*next] = true;
    for (int k = 0; k < 4; ++k) --cellsAt.at(face(*next, k));
  }
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    if (!isLeftOut[t]) kept.push_back(t);
  tetrahedra = Eigen::Matrix4Xi(tetrahedra(Eigen::all, kept));
}

struct Crossing {
  int first[2], second[2];  // the diagonals
  Eigen::Vector3d place;
};

/// Where two edges of a flat cell cross inside both.
std::optional<Crossing> crossingOf(const Eigen::Matrix3Xd& points, const Eigen::Vector4i& cell) {
  for (const auto& pair : kEdgePairs) {
    const Eigen::Vector3d a = points.col(cell[pair[0]]), c = points.col(cell[pair[2]]),
                          ab = points.col(cell[pair[1]]) - a, cd = points.col(cell[pair[3]]) - c;
    const Eigen::Vector3d across = ab.cross(cd);
    const double size = across.squaredNorm();
    if (!(size > 0)) continue;
    const double s = (c - a).cross(cd).dot(across) / size, t = (c - a).cross(ab).dot(across) / size;
    const auto isInside = [](double share) {
      return share > kLeastShare && share < 1 - kLeastShare;
    };
    if (!isInside(s) || !isInside(t)) continue;
    const Eigen::Vector3d on = a + s * ab, other = c + t * cd;
    if ((on - other).norm() > kCrossing * longestEdge(points, cell)) continue;
    return Crossing{
        {cell[pair[0]], cell[pair[1]]}, {cell[pair[2]], cell[pair[3]]}, (on + other) / 2};
  }
  return std::nullopt;
}

int cornerOf(const Eigen::Vector4i& cell, int vertex) {
  for (int k = 0; k < 4; ++k)
    if (cell[k] == vertex) return k;
  return -1;
}

/// Cuts all cells around an edge in two at a point on it; those that are appended, too, are whole.
void cutAround(const int (&edge)[2], int point, std::vector<Eigen::Vector4i>& cells) {
  const std::size_t count = cells.size();
  for (std::size_t t = 0; t < count; ++t) {
    const int from = cornerOf(cells[t], edge[0]), to = cornerOf(cells[t], edge[1]);
    if (from < 0 || to < 0) continue;
    Eigen::Vector4i half = cells[t];
    half[to] = point;
    cells[t][from] = point;
    cells.push_back(half);
  }
}

void cutAtCrossings(Eigen::Matrix3Xd& points, Eigen::Matrix4Xi& tetrahedra) {
  std::vector<Eigen::Vector4i> cells;
  for (const auto& cell : tetrahedra.colwise()) cells.push_back(cell);
  for (Eigen::Index left = tetrahedra.cols(); left > 0; --left) {  // cuts may make others, for once
    std::optional<Crossing> crossing;
    const auto flat = std::find_if(cells.begin(), cells.end(), [&](const Eigen::Vector4i& cell) {
      if (!isFlat(points, cell)) return false;
      crossing = crossingOf(points, cell);
      return crossing.has_value();
    });
    if (flat == cells.end()) break;
    cells.erase(flat);
    const int point = static_cast<int>(points.cols());
    points.conservativeResize(Eigen::NoChange, point + 1);
    points.col(point) = crossing->place;
    cutAround(crossing->first, point, cells);
    cutAround(crossing->second, point, cells);
  }
  tetrahedra.resize(Eigen::NoChange, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t t = 0; t < cells.size(); ++t)
    tetrahedra.col(static_cast<Eigen::Index>(t)) = cells[t];
}

}  // namespace

void removeFlatCells(Eigen::Matrix3Xd& points, Eigen::Matrix4Xi& tetrahedra) {
  leaveOutAtBoundary(points, tetrahedra);
  cutAtCrossings(points, tetrahedra);
}

}  // namespace palpate
