// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/triangle_soup.h"

#include <algorithm>
#include <Eigen/Geometry>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

#include "mesh/mesh_defects.h"
#include "mesh/triangle_sides.h"

namespace palpate {
namespace {

bool isUsableTriangle(const Eigen::Matrix3Xd& points, const Eigen::Vector3i& t) {
  if (t.minCoeff() < 0 || t.maxCoeff() >= points.cols()) return false;
  return isUsablePoint(points.col(t[0])) && isUsablePoint(points.col(t[1])) &&
         isUsablePoint(points.col(t[2]));
}

/// For each vertex in `used` the vertex it is welded to, -1 for other vertices.
std::vector<int> weld(const Eigen::Matrix3Xd& points, const std::vector<int>& used) {
  std::vector<int> target(points.cols(), -1);
  if (used.empty()) return target;
  Eigen::Matrix3Xd usedPoints(3, used.size());
  for (std::size_t i = 0; i < used.size(); ++i) usedPoints.col(i) = points.col(used[i]);
  const double diagonal =
      (usedPoints.rowwise().maxCoeff() - usedPoints.rowwise().minCoeff()).norm();
  const std::vector<int> twin = nearestDuplicates(usedPoints, kDuplicateDistance * diagonal);
  for (std::size_t i = 0; i < used.size(); ++i) target[used[i]] = used[twin[i]];
  return target;
}

void keepTriangles(TriangleSoup& soup, const std::vector<bool>& keep) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    if (!keep[f]) continue;
    soup.triangles[count] = soup.triangles[f];
    soup.triangleOrigin[count++] = soup.triangleOrigin[f];
  }
  soup.triangles.resize(count);
  soup.triangleOrigin.resize(count);
}

std::vector<int> droppedOrigins(const TriangleSoup& soup, const std::vector<bool>& keep) {
  std::vector<int> dropped;
  for (std::size_t f = 0; f < keep.size(); ++f)
    if (!keep[f]) dropped.push_back(soup.triangleOrigin[f]);
  return dropped;
}

/// #F piece numbers: triangles hang together across edges of two triangles.
std::vector<int> findPieces(const TriangleSoup& soup, const std::vector<TriangleSide>& sides) {
  std::vector<int> root(soup.triangles.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  forEachEdge(sides, [&](auto first, auto last) {
    if (last - first == 2) root[find(std::prev(last)->triangle)] = find(first->triangle);
  });
  for (std::size_t f = 0; f < root.size(); ++f) root[f] = find(static_cast<int>(f));
  return root;
}

/// How many of an edge's triangles each piece owns.
template <class Side>
std::map<int, int> trianglesByPiece(Side first, Side last, const std::vector<int>& piece) {
  std::map<int, int> share;
  for (auto side = first; side != last; ++side) ++share[piece[side->triangle]];
  return share;
}

/// Pieces with an open border that own one triangle of an edge at which another piece owns two: a
/// surface passes there without them.
void dropDanglingPieces(TriangleSoup& soup, ChangeList& changes) {
  std::vector<int> dropped;
  for (bool changed = true; changed;) {
    const std::vector<TriangleSide> sides = sortedSides(soup.triangleMatrix());
    const std::vector<int> piece = findPieces(soup, sides);
    std::set<int> open, hanging;
    forEachEdge(sides, [&](auto first, auto last) {
      const std::map<int, int> share = trianglesByPiece(first, last, piece);
      const bool passes = std::any_of(share.begin(), share.end(),
                                      [](const auto& entry) { return entry.second == 2; });
      for (const auto& [number, count] : share) {
        if (last - first == 1) open.insert(number);
        if (last - first > 2 && count == 1 && passes) hanging.insert(number);
      }
    });
    std::vector<bool> keep;
    for (int number : piece) keep.push_back(!open.count(number) || !hanging.count(number));
    const std::vector<int> now = droppedOrigins(soup, keep);
    dropped.insert(dropped.end(), now.begin(), now.end());
    changed = !now.empty();
    keepTriangles(soup, keep);
  }
  changes.add("dropped triangles that hang from an edge of three", dropped);
}

/// True if the points lie in a plane up to kDuplicateDistance of their extent.
bool isFlat(const std::vector<Eigen::Vector3d>& points, const std::set<int>& vertices) {
  Eigen::Matrix3Xd arms(3, vertices.size());
  Eigen::Index i = 0;
  for (int v : vertices) arms.col(i++) = points[v] - points[*vertices.begin()];
  Eigen::Index farthest;
  const double extent = arms.colwise().norm().maxCoeff(&farthest);
  const Eigen::Vector3d along = arms.col(farthest).normalized();
  Eigen::Matrix3Xd across = arms - along * (along.transpose() * arms);
  across.colwise().norm().maxCoeff(&farthest);
  const Eigen::Vector3d normal = along.cross(across.col(farthest).normalized());
  return (normal.transpose() * arms).cwiseAbs().maxCoeff() <= kDuplicateDistance * extent;
}

void dropFlatPieces(TriangleSoup& soup, ChangeList& changes) {
  const std::vector<TriangleSide> sides = sortedSides(soup.triangleMatrix());
  const std::vector<int> piece = findPieces(soup, sides);
  std::map<int, std::set<int>> vertices;
  for (std::size_t f = 0; f < piece.size(); ++f)
    vertices[piece[f]].insert(soup.triangles[f].begin(), soup.triangles[f].end());
  forEachEdge(sides, [&](auto first, auto last) {
    for (auto side = first; last - first > 2 && side != last; ++side)
      vertices.erase(piece[side->triangle]);  // it hangs together with others
  });
  std::set<int> flat;
  for (const auto& [number, corners] : vertices)
    if (isFlat(soup.points, corners)) flat.insert(number);
  std::vector<bool> keep;
  for (int number : piece) keep.push_back(!flat.count(number));
  changes.add("dropped triangles of flat pieces that enclose nothing", droppedOrigins(soup, keep));
  keepTriangles(soup, keep);
}

/// At an edge of more than two triangles each piece must own two of them.
void requireClearEdges(const TriangleSoup& soup, const std::vector<TriangleSide>& sides,
                       const std::vector<int>& piece) {
  forEachEdge(sides, [&](auto first, auto last) {
    if (last - first <= 2) return;
    const std::map<int, int> share = trianglesByPiece(first, last, piece);
    for (const auto& [number, count] : share) {
      if (count == 2) continue;
      std::ostringstream text;
      text << "edge (" << soup.vertexOrigin[first->low] << ", " << soup.vertexOrigin[first->high]
           << ") belongs to " << last - first << " triangles (";
      for (auto side = first; side != last; ++side)
        text << (side == first ? "" : ", ") << soup.triangleOrigin[side->triangle];
      text << "), and it is not clear which of them bound a body";
      throw std::invalid_argument(text.str());
    }
  });
}

/// Where two pieces that share no edge are both open at a vertex, the surface is torn between them.
void requireClearBorders(const TriangleSoup& soup, const std::vector<TriangleSide>& sides,
                         const std::vector<int>& piece) {
  std::map<int, TriangleSide> sideAt;  // an open side at each vertex
  forEachEdge(sides, [&](auto first, auto last) {
    if (last - first != 1) return;
    for (int v : {first->low, first->high}) {
      const TriangleSide& other = sideAt.insert({v, *first}).first->second;
      if (piece[other.triangle] == piece[first->triangle]) continue;
      throw std::invalid_argument("the surface is torn at vertex " +
                                  std::to_string(soup.vertexOrigin[v]) + ": triangles " +
                                  std::to_string(soup.triangleOrigin[other.triangle]) + " and " +
                                  std::to_string(soup.triangleOrigin[first->triangle]) +
                                  " are open there, and share no edge that would join them");
    }
  });
}

}  // namespace

void ChangeList::add(const std::string& what, std::vector<int> which) {
  constexpr std::size_t longest = 8;
  if (which.empty()) return;
  std::sort(which.begin(), which.end());
  which.erase(std::unique(which.begin(), which.end()), which.end());
  std::ostringstream text;
  text << what << ": ";
  for (std::size_t i = 0; i < which.size() && i < longest; ++i) text << (i ? ", " : "") << which[i];
  if (which.size() > longest) text << ", ... (" << which.size() << " in all)";
  changes_.push_back(text.str());
}

TriangleSoup cleanSoup(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                       ChangeList& changes) {
  std::vector<int> unusable, usable, used;
  for (int f = 0; f < triangles.cols(); ++f) {
    const bool isUsable = isUsableTriangle(points, triangles.col(f));
    (isUsable ? usable : unusable).push_back(f);
    if (isUsable) used.insert(used.end(), triangles.col(f).begin(), triangles.col(f).end());
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const std::vector<int> target = weld(points, used);

  TriangleSoup soup;
  std::vector<int> collapsed, repeated, welded, unused, number(points.cols(), -1);
  std::set<std::array<int, 3>> seen;
  for (int f : usable) {
    std::array<int, 3> corners{target[triangles(0, f)], target[triangles(1, f)],
                               target[triangles(2, f)]};
    std::array<int, 3> key = corners;
    std::sort(key.begin(), key.end());
    if (key[0] == key[1] || key[1] == key[2]) {
      collapsed.push_back(f);
    } else if (!seen.insert(key).second) {
      repeated.push_back(f);
    } else {
      for (int v : corners) number[v] = 0;
      soup.triangles.push_back(corners);
      soup.triangleOrigin.push_back(f);
    }
  }
  for (int v = 0; v < points.cols(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(soup.points.size());
    soup.points.push_back(points.col(v));
    soup.vertexOrigin.push_back(v);
  }
  for (std::array<int, 3>& corners : soup.triangles)
    for (int& v : corners) v = number[v];
  for (int v = 0; v < points.cols(); ++v)
    if (target[v] >= 0 && target[v] != v)
      welded.push_back(v);
    else if (number[v] < 0)
      unused.push_back(v);
  changes.add("dropped triangles with unusable indices or coordinates", unusable);
  changes.add("welded vertices to another at the same place", welded);
  changes.add("dropped triangles with a repeated vertex", collapsed);
  changes.add("dropped triangles that repeat another", repeated);
  changes.add("dropped unused vertices", unused);
  return soup;
}

void dropLooseTriangles(TriangleSoup& soup, ChangeList& changes) {
  dropDanglingPieces(soup, changes);
  dropFlatPieces(soup, changes);
}

void separatePieces(TriangleSoup& soup) {
  const std::vector<TriangleSide> sides = sortedSides(soup.triangleMatrix());
  const std::vector<int> piece = findPieces(soup, sides);
  requireClearEdges(soup, sides, piece);
  requireClearBorders(soup, sides, piece);
  std::vector<int> owner(soup.points.size(), -1);
  std::map<std::pair<int, int>, int> copy;  // of a vertex for a piece that does not own it
  for (std::size_t f = 0; f < piece.size(); ++f)
    for (int& v : soup.triangles[f]) {
      if (owner[v] < 0) owner[v] = piece[f];
      if (owner[v] == piece[f]) continue;
      const auto [entry, isNew] =
          copy.insert({{v, piece[f]}, static_cast<int>(soup.points.size())});
      if (isNew) {
        soup.points.push_back(Eigen::Vector3d(soup.points[v]));
        soup.vertexOrigin.push_back(soup.vertexOrigin[v]);
      }
      v = entry->second;
    }
}

void requireTwoSided(const TriangleSoup& soup, const std::vector<int>& merged) {
  Eigen::Matrix3Xi triangles = soup.triangleMatrix();
  for (int& v : triangles.reshaped()) v = merged[v];
  forEachEdge(sortedSides(triangles), [&](auto first, auto last) {
    if (last - first != 2 || first->upwards != std::prev(last)->upwards) return;
    std::ostringstream text;
    text << "the surface is one-sided: triangles " << soup.triangleOrigin[first->triangle]
         << " and " << soup.triangleOrigin[std::prev(last)->triangle]
         << " cannot both point out of the material";
    throw std::invalid_argument(text.str());
  });
}

}  // namespace palpate
