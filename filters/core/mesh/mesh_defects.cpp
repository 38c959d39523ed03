// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <numeric>
#include <stdexcept>

#include "mesh/shells.h"
#include "mesh/triangle_sides.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kLargestCoordinate = 1e60;
constexpr double kShortestEdge = 1e-70;
constexpr double kDegenerateHeight = 1e-10;  // of the triangle's longest edge

class DefectList {
 public:
  explicit DefectList(std::size_t largestCount) : largestCount_(largestCount) {}
  void add(MeshDefectKind kind, int index, const std::string& text) {
    if (defects_.size() < largestCount_) defects_.push_back(describeDefect(kind, index, text));
  }
  bool empty() const { return defects_.empty(); }
  std::vector<MeshDefect> take() { return std::move(defects_); }

 private:
  std::size_t largestCount_;
  std::vector<MeshDefect> defects_;
};

void findBadNumbers(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                    DefectList& defects) {
  for (int v = 0; v < points.cols(); ++v) {
    const Eigen::Vector3d x = points.col(v);
    if (!isUsablePoint(x))
      defects.add(MeshDefectKind::NonFiniteCoordinate, v,
                  sentence("vertex ", v, " has a coordinate that is not a usable number (", x.x(),
                           ", ", x.y(), ", ", x.z(), ")"));
  }
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      if (triangles(k, f) < 0 || triangles(k, f) >= points.cols())
        defects.add(MeshDefectKind::IndexOutOfRange, f,
                    sentence("triangle ", f, " refers to vertex ", triangles(k, f),
                             ", but there are only ", points.cols(), " vertices"));
}

struct TriangleSize {
  double longestEdge, height;
  TriangleSize(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
      : longestEdge(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()})),
        height(longestEdge > 0 ? (b - a).cross(c - a).norm() / longestEdge : 0) {}
  bool isDegenerate() const {
    return longestEdge < kShortestEdge || height <= kDegenerateHeight * longestEdge;
  }
};

void findDegenerateTriangles(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                             DefectList& defects) {
  for (int f = 0; f < triangles.cols(); ++f) {
    const Eigen::Vector3i t = triangles.col(f);
    const TriangleSize size(points.col(t[0]), points.col(t[1]), points.col(t[2]));
    if (size.isDegenerate())
      defects.add(
          MeshDefectKind::DegenerateTriangle, f,
          sentence("triangle ", f, " (", t[0], ", ", t[1], ", ", t[2], ") is degenerate: height ",
                   size.height, " over longest edge ", size.longestEdge));
  }
}

void findUnusedAndDuplicateVertices(const Eigen::Matrix3Xd& points,
                                    const Eigen::Matrix3Xi& triangles, DefectList& defects) {
  std::vector<bool> used(points.cols(), false);
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) used[triangles(k, f)] = true;
  for (int v = 0; v < points.cols(); ++v)
    if (!used[v])
      defects.add(MeshDefectKind::UnusedVertex, v, sentence("vertex ", v, " is in no triangle"));

  const double diagonal = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  const std::vector<int> twin = nearestDuplicates(points, kDuplicateDistance * diagonal);
  for (int v = 0; v < points.cols(); ++v)
    if (twin[v] != v)
      defects.add(MeshDefectKind::DuplicateVertex, v,
                  sentence("vertex ", v, " lies on vertex ", twin[v], " (distance ",
                           (points.col(v) - points.col(twin[v])).norm(), ")"));
}

void findDuplicateTriangles(const Eigen::Matrix3Xi& triangles, DefectList& defects) {
  std::vector<std::array<int, 4>> keys(triangles.cols());
  for (int f = 0; f < triangles.cols(); ++f) {
    keys[f] = {triangles(0, f), triangles(1, f), triangles(2, f), f};
    std::sort(keys[f].begin(), keys[f].begin() + 3);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin()))
      defects.add(MeshDefectKind::DuplicateTriangle, keys[i][3],
                  sentence("triangle ", keys[i][3], " repeats triangle ", keys[i - 1][3]));
}

void findEdgeDefects(const Eigen::Matrix3Xi& triangles, Rims rims, DefectList& defects) {
  forEachEdge(sortedSides(triangles), [&](auto first, auto last) {
    const auto edge = [&, side = *first] {
      return sentence("edge (", side.low, ", ", side.high, ")");
    };
    const int f = first->triangle, second = std::prev(last)->triangle;
    if (last - first > 2)
      defects.add(MeshDefectKind::NonManifoldEdge, f,
                  sentence(edge(), " belongs to ", last - first, " triangles (the first is ", f,
                           "): the surface is not a manifold there",
                           rims == Rims::Allowed ? "; leave two of the sheets that meet in it, or "
                                                   "fill what they are as a solid (--method fem)"
                                                 : ""));
    else if (last - first == 1 && rims == Rims::Allowed)
      return;
    else if (last - first == 1)
      defects.add(MeshDefectKind::OpenBoundary, f,
                  sentence(edge(), " belongs to triangle ", f,
                           " alone: the surface is open there, but it must be closed"));
    else if (first->upwards == std::prev(last)->upwards)
      defects.add(MeshDefectKind::InconsistentOrientation, second,
                  sentence("triangles ", f, " and ", second, " run in opposite senses at ", edge(),
                           ": one of them is flipped"));
  });
}

/// The triangles around each vertex of an edge-manifold must form one fan, which is open on rims.
void findVertexDefects(int vertexCount, const Eigen::Matrix3Xi& triangles, DefectList& defects) {
  std::vector<int> next(3 * triangles.cols());  // successor of a corner around its vertex
  std::vector<std::array<int, 3>> spokes;       // (vertex, spoke's other end, corner)
  spokes.reserve(next.size());
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      spokes.push_back({triangles(k, f), triangles((k + 1) % 3, f), 3 * f + k});
  std::sort(spokes.begin(), spokes.end());
  std::vector<int> cornerCount(vertexCount, 0), firstCorner(vertexCount, -1);
  std::vector<bool> isNext(next.size(), false);
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::array<int, 3> wanted{triangles(k, f), triangles((k + 2) % 3, f), -1};
      const auto spoke = std::lower_bound(spokes.begin(), spokes.end(), wanted);
      const bool isRim =
          spoke == spokes.end() || (*spoke)[0] != wanted[0] || (*spoke)[1] != wanted[1];
      next[3 * f + k] = isRim ? -1 : (*spoke)[2];
      if (!isRim) isNext[next[3 * f + k]] = true;
      ++cornerCount[triangles(k, f)];
      firstCorner[triangles(k, f)] = 3 * f + k;
    }
  for (std::size_t c = 0; c < next.size(); ++c)  // an open fan begins at a rim
    if (!isNext[c]) firstCorner[triangles.data()[c]] = static_cast<int>(c);
  for (int v = 0; v < vertexCount; ++v) {
    int length = 0;
    for (int c = firstCorner[v]; c >= 0 && length <= cornerCount[v]; c = next[c]) {
      ++length;
      if (next[c] == firstCorner[v]) break;
    }
    if (length != cornerCount[v])
      defects.add(MeshDefectKind::NonManifoldVertex, v,
                  sentence("at vertex ", v, " two sheets of the surface touch in a point"));
  }
}

}  // namespace

const char* nameOf(MeshDefectKind kind) {
  switch (kind) {
    case MeshDefectKind::Empty:
      return "empty surface";
    case MeshDefectKind::NonFiniteCoordinate:
      return "non-finite coordinate";
    case MeshDefectKind::IndexOutOfRange:
      return "index out of range";
    case MeshDefectKind::DegenerateTriangle:
      return "degenerate triangle";
    case MeshDefectKind::DuplicateTriangle:
      return "duplicate triangle";
    case MeshDefectKind::UnusedVertex:
      return "unused vertex";
    case MeshDefectKind::DuplicateVertex:
      return "duplicate vertex";
    case MeshDefectKind::NonManifoldEdge:
      return "non-manifold edge";
    case MeshDefectKind::OpenBoundary:
      return "open boundary";
    case MeshDefectKind::InconsistentOrientation:
      return "inconsistent orientation";
    case MeshDefectKind::NonManifoldVertex:
      return "non-manifold vertex";
    case MeshDefectKind::InwardOrientation:
      return "inward orientation";
    case MeshDefectKind::NoVolume:
      return "no volume";
    case MeshDefectKind::SelfIntersection:
      return "self-intersection";
  }
  return "defect";
}

MeshDefect describeDefect(MeshDefectKind kind, int index, const std::string& text) {
  return {kind, index, std::string(nameOf(kind)) + ": " + text};
}

bool isUsablePoint(const Eigen::Vector3d& point) {
  return point.allFinite() && point.cwiseAbs().maxCoeff() <= kLargestCoordinate;
}

bool isDegenerateTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  return TriangleSize(a, b, c).isDegenerate();
}

std::vector<int> nearestDuplicates(const Eigen::Matrix3Xd& points, double distance) {
  // Keys relative to a point of the set, so that a far-away origin does not swallow the distance.
  const Eigen::Vector3d direction =
      Eigen::Vector3d(0.5257311121191336, 0.6180339887498949, 0.5851023839).normalized();
  std::vector<double> key(points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    key[v] = direction.dot(points.col(v) - points.col(0));
  std::vector<int> order(points.cols()), twin(points.cols());
  std::iota(order.begin(), order.end(), 0);
  std::iota(twin.begin(), twin.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && key[order[j]] - key[order[i]] <= distance;
         ++j) {
      const int low = std::min(order[i], order[j]), high = std::max(order[i], order[j]);
      if ((points.col(low) - points.col(high)).norm() <= distance)
        twin[high] = std::min(twin[high], low);
    }
  for (std::size_t v = 0; v < twin.size(); ++v) twin[v] = twin[twin[v]];
  return twin;
}

std::vector<MeshDefect> findMeshDefects(const Eigen::Matrix3Xd& points,
                                        const Eigen::Matrix3Xi& triangles, std::size_t largestCount,
                                        Rims rims) {
  DefectList defects(largestCount);
  if (points.cols() == 0 || triangles.cols() == 0) {
    defects.add(MeshDefectKind::Empty, -1, "the surface has no triangles");
    return defects.take();
  }
  findBadNumbers(points, triangles, defects);
  if (!defects.empty()) return defects.take();
  findDegenerateTriangles(points, triangles, defects);
  findUnusedAndDuplicateVertices(points, triangles, defects);
  findDuplicateTriangles(triangles, defects);
  if (!defects.empty()) return defects.take();
  findEdgeDefects(triangles, rims, defects);
  if (!defects.empty()) return defects.take();
  findVertexDefects(static_cast<int>(points.cols()), triangles, defects);
  return defects.take();
}

std::vector<MeshDefect> findOrientationDefects(const Shells& shells, std::size_t largestCount) {
  DefectList defects(largestCount);
  for (int s = 0; s < shells.count(); ++s) {
    const int f = shells.firstTriangle[s];
    const bool cavity = shells.depth[s] % 2 == 1;
    if (shells.volume[s] == 0)
      defects.add(MeshDefectKind::NoVolume, f,
                  sentence("the surface of triangle ", f, " encloses no volume"));
    else if (cavity && shells.volume[s] > 0)
      defects.add(MeshDefectKind::InwardOrientation, f,
                  sentence("the cavity of triangle ", f,
                           " is not a hole: its normals must point out of the material, into the "
                           "cavity"));
    else if (!cavity && shells.volume[s] < 0)
      defects.add(MeshDefectKind::InwardOrientation, f,
                  sentence("the surface is inside out at triangle ", f,
                           ": its normals must point outwards"));
  }
  return defects.take();
}

void requireNoDefect(const std::vector<MeshDefect>& defects) {
  if (!defects.empty()) throw std::invalid_argument(defects.front().sentence);
}

}  // namespace palpate
