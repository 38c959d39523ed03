// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <Eigen/Core>
#include <tuple>
#include <vector>

namespace palpate {

/// A side of a triangle: the lower vertex, the higher vertex, the triangle, and its direction.
struct TriangleSide {
  int low, high, triangle;
  bool upwards;
  bool sameEdge(const TriangleSide& other) const { return low == other.low && high == other.high; }
};

/// All sides, those of one edge next to each other, in the order of their triangles.
/// @param triangles  3 by #F.
inline std::vector<TriangleSide> sortedSides(const Eigen::Ref<const Eigen::Matrix3Xi>& triangles) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * triangles.cols());
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(k, f), b = triangles((k + 1) % 3, f);
      sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Calls visit(first, last) with the range of sides of each edge.
template <class Visit>
void forEachEdge(const std::vector<TriangleSide>& sides, Visit&& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(
        first, sides.end(), [&](const TriangleSide& side) { return !side.sameEdge(*first); });
    visit(first, last);
    first = last;
  }
}

}  // namespace palpate
