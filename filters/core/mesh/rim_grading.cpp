// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/rim_grading.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

using Ends = std::pair<int, int>;  // of an edge, ascending

Ends endsOf(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

struct Triangle {
  std::array<int, 3> corner;
  int parent;

  /// Turned so that the corner k comes first.
  std::array<int, 3> from(int k) const {
    return {corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]};
  }
};

class Grading {
 public:
  Grading(const SurfaceMesh& mesh, const std::vector<unsigned char>& types) : types_(types) {
    for (int v = 0; v < mesh.vertexCount(); ++v) {
      points_.push_back(mesh.points().col(v));
      parents_.push_back({v, v});
      shares_.push_back(0);
    }
    for (int f = 0; f < mesh.triangleCount(); ++f) {
      const Eigen::Vector3i corner = mesh.triangles().col(f);
      triangles_.push_back({{corner[0], corner[1], corner[2]}, f});
    }
    findRim();
  }

  /// Halves the edges between vertices of the rim that are not part of it.
  void halveChords() {
    for (const Triangle& t : takeTriangles()) {
      int chords = 0, chord = 0, other = 0;
      for (int k = 0; k < 3; ++k)
        if (isChord(t.corner[k], t.corner[(k + 1) % 3])) {
          chord = k;
          ++chords;
        } else {
          other = k;
        }
      if (chords == 0)
        triangles_.push_back(t);
      else if (chords == 1)
        halveOne(t.from(chord), t.parent);
      else if (chords == 2)
        halveTwo(t.from(other), t.parent);
      else
        halveThree(t.corner, t.parent);
    }
  }

  void addLayers(int count) {
    layers_ = count;
    newOn_.clear();
    for (const Triangle& t : takeTriangles()) {
      int rimCorner = 0, otherCorner = 0, corners = 0;
      for (int k = 0; k < 3; ++k)
        if (onRim_[t.corner[k]]) {
          rimCorner = k;
          ++corners;
        } else {
          otherCorner = k;
        }
      if (corners == 1)
        cutCorner(t.from(rimCorner), t.parent);
      else if (corners == 2)
        cutEdge(t.from(otherCorner), t.parent);
      else
        triangles_.push_back(t);
    }
  }

  GradedSurface take() const {
    GradedSurface graded;
    const auto count = static_cast<Eigen::Index>(points_.size());
    graded.points.resize(3, count);
    graded.parents.resize(2, count);
    graded.share = Eigen::Map<const Eigen::VectorXd>(shares_.data(), count);
    for (Eigen::Index v = 0; v < count; ++v) {
      graded.points.col(v) = points_[v];
      graded.parents.col(v) << parents_[v].first, parents_[v].second;
    }
    graded.triangles.resize(3, triangles_.size());
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const std::array<int, 3>& corner = triangles_[f].corner;
      graded.triangles.col(f) << corner[0], corner[1], corner[2];
      graded.parentTriangle.push_back(triangles_[f].parent);
    }
    return graded;
  }

 private:
  bool isSupport(const Triangle& t) const {
    return types_[t.corner[0]] && types_[t.corner[1]] && types_[t.corner[2]];
  }

  bool isChord(int a, int b) const {
    return onRim_[a] && onRim_[b] && rim_.count(endsOf(a, b)) == 0;
  }

  /// The edges between the support's triangles and others.
  void findRim() {
    std::map<Ends, int> supportTriangles;
    for (const Triangle& t : triangles_)
      for (int k = 0; k < 3; ++k)
        supportTriangles[endsOf(t.corner[k], t.corner[(k + 1) % 3])] += isSupport(t);
    onRim_.assign(points_.size(), false);
    for (const auto& [ends, count] : supportTriangles)
      if (count == 1) {
        rim_.insert(ends);
        onRim_[ends.first] = onRim_[ends.second] = true;
      }
  }

  std::vector<Triangle> takeTriangles() { return std::exchange(triangles_, {}); }

  void add(int a, int b, int c, int parent) { triangles_.push_back({{a, b, c}, parent}); }

  /// Cut by the shorter diagonal.
  void addQuadrangle(int a, int b, int c, int d, int parent) {
    if ((points_[a] - points_[c]).norm() <= (points_[b] - points_[d]).norm()) {
      add(a, b, c, parent);
      add(a, c, d, parent);
    } else {
      add(a, b, d, parent);
      add(b, c, d, parent);
    }
  }

  int pointBetween(int from, int to, double share) {
    points_.push_back((1 - share) * points_[from] + share * points_[to]);
    parents_.push_back({from, to});
    shares_.push_back(share);
    onRim_.push_back(false);
    return static_cast<int>(points_.size()) - 1;
  }

  int middle(int a, int b) {
    std::vector<int>& points = newOn_[endsOf(a, b)];
    if (points.empty()) points.push_back(pointBetween(a, b, 0.5));
    return points.front();
  }

  /// The ends of the layers on an edge that leaves the rim, the nearest to the rim last.
  const std::vector<int>& ends(int rim, int other) {
    std::vector<int>& points = newOn_[endsOf(rim, other)];
    while (static_cast<int>(points.size()) < layers_)
      points.push_back(pointBetween(rim, points.empty() ? other : points.back(), kLayerShare));
    return points;
  }

  /// A triangle whose edge from the first corner to the second is halved.
  void halveOne(const std::array<int, 3>& corner, int parent) {
    const auto [a, b, c] = corner;
    add(a, middle(a, b), c, parent);
    add(middle(a, b), b, c, parent);
  }

  /// A triangle of which only that edge is not.
  void halveTwo(const std::array<int, 3>& corner, int parent) {
    const auto [a, b, c] = corner;
    add(c, middle(c, a), middle(b, c), parent);
    addQuadrangle(a, b, middle(b, c), middle(c, a), parent);
  }

  void halveThree(const std::array<int, 3>& corner, int parent) {
    const auto [a, b, c] = corner;
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    add(a, ab, ca, parent);
    add(b, bc, ab, parent);
    add(c, ca, bc, parent);
    add(ab, bc, ca, parent);
  }

  /// A triangle whose first corner alone is on the rim.
  void cutCorner(const std::array<int, 3>& corner, int parent) {
    auto [a, b, c] = corner;
    const std::vector<int>&onAb = ends(a, b), &onAc = ends(a, c);
    for (int layer = 0; layer < layers_; ++layer) {
      addQuadrangle(onAb[layer], b, c, onAc[layer], parent);
      b = onAb[layer];
      c = onAc[layer];
    }
    add(a, b, c, parent);
  }

  /// A triangle whose second and third corners are the ends of an edge of the rim.
  void cutEdge(const std::array<int, 3>& corner, int parent) {
    const auto [a, b, c] = corner;
    const std::vector<int>&onBa = ends(b, a), &onCa = ends(c, a);
    add(a, onBa[0], onCa[0], parent);
    for (int layer = 1; layer < layers_; ++layer)
      addQuadrangle(onBa[layer - 1], onBa[layer], onCa[layer], onCa[layer - 1], parent);
    addQuadrangle(onBa.back(), b, c, onCa.back(), parent);
  }

  const std::vector<unsigned char>& types_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Ends> parents_;
  std::vector<double> shares_;
  std::vector<Triangle> triangles_;
  std::set<Ends> rim_;
  std::vector<bool> onRim_;
  int layers_ = 0;
  std::map<Ends, std::vector<int>> newOn_;  ///< an edge's new vertices
};

}  // namespace

std::map<int, double> GradedSurface::ancestors(int point) const {
  if (parents(0, point) == point) return {{point, 1.0}};
  std::map<int, double> shares;
  for (int k = 0; k < 2; ++k)
    for (const auto& [ancestor, part] : ancestors(parents(k, point)))
      shares[ancestor] += part * (k == 0 ? 1 - share[point] : share[point]);
  return shares;
}

GradedSurface gradeTowardsSupport(const SurfaceMesh& mesh, const std::vector<unsigned char>& types,
                                  int layers) {
  if (static_cast<int>(types.size()) != mesh.vertexCount())
    throw std::invalid_argument("there are " + std::to_string(types.size()) +
                                " boundary types for " + std::to_string(mesh.vertexCount()) +
                                " vertices");
  if (layers < 0)
    throw std::invalid_argument("the layers at a rim are at least 0, not " +
                                std::to_string(layers));
  Grading grading(mesh, types);
  if (layers > 0) {
    grading.halveChords();
    grading.addLayers(layers);
  }
  return grading.take();
}

std::vector<unsigned char> gradedBoundaryTypes(const GradedSurface& graded,
                                               const std::vector<unsigned char>& types) {
  std::vector<unsigned char> all = types;
  for (Eigen::Index v = static_cast<Eigen::Index>(all.size()); v < graded.parents.cols(); ++v)
    all.push_back(all[graded.parents(0, v)] && all[graded.parents(1, v)]);
  return all;
}

Eigen::VectorXi gradedSmoothPatches(const GradedSurface& graded, const Eigen::VectorXi& patches) {
  return patches(graded.parentTriangle);
}

}  // namespace palpate
