// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedral_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "mesh/mesh_defects.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kFlatVolume = 1e-12;
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

void requirePoints(const Eigen::Matrix3Xd& points, const Eigen::Matrix4Xi& tetrahedra) {
  if (tetrahedra.cols() == 0) refuse("the volume mesh has no tetrahedron");
  std::vector<bool> isUsed(points.cols(), false);
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    for (int corner : tetrahedra.col(t)) {
      if (corner < 0 || corner >= points.cols())
        refuse("tetrahedron ", t, " refers to point ", corner, " of ", points.cols());
      isUsed[corner] = true;
    }
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!isUsablePoint(points.col(i)))
      refuse("point ", i, " of the volume mesh is not finite or too far away");
    if (!isUsed[i]) refuse("point ", i, " of the volume mesh belongs to no tetrahedron");
  }
  const double diagonal = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  const std::vector<int> nearest = nearestDuplicates(points, kDuplicateDistance * diagonal);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (nearest[i] != i)
      refuse("points ", nearest[i], " and ", i, " of the volume mesh are the same: weld it");
}

}  // namespace

TetrahedralMesh::TetrahedralMesh(Eigen::Matrix3Xd points, Eigen::Matrix4Xi tetrahedra)
    : points_(std::move(points)), tetrahedra_(std::move(tetrahedra)), volumes_(tetrahedra_.cols()) {
  requirePoints(points_, tetrahedra_);
  for (int t = 0; t < cellCount(); ++t) {
    auto corner = tetrahedra_.col(t);
    const auto edge = [&](int from, int to) -> Eigen::Vector3d {
      return points_.col(corner[to]) - points_.col(corner[from]);
    };
    volumes_[t] = edge(0, 1).cross(edge(0, 2)).dot(edge(0, 3)) / 6;
    double longest = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) longest = std::max(longest, edge(i, j).norm());
    if (!(std::abs(volumes_[t]) > kFlatVolume * longest * longest * longest))
      refuse("tetrahedron ", t, " is flat: its volume is ", volumes_[t], " at edges up to ",
             longest);
    if (volumes_[t] < 0) std::swap(corner[2], corner[3]);
    volumes_[t] = std::abs(volumes_[t]);
  }
  findBoundary();
}

void TetrahedralMesh::findBoundary() {
  struct Face {
    std::array<int, 3> key;  // ascending
    int tetrahedron, number;
    bool isClockwise;  // the key's corners, seen from outside
    bool operator<(const Face& other) const { return key < other.key; }
  };
  std::vector<Face> faces;
  faces.reserve(4 * std::size_t(cellCount()));
  for (int t = 0; t < cellCount(); ++t)
    for (int f = 0; f < 4; ++f) {
      Face face{{}, t, f, false};
      for (int k = 0; k < 3; ++k) face.key[k] = tetrahedra_(kFaces[f][k], t);
      const auto [a, b, c] = face.key;
      face.isClockwise = ((a < b) + (b < c) + (c < a)) == 1;
      std::sort(face.key.begin(), face.key.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  std::vector<Face> alone;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].key == faces[i].key) ++end;
    if (end - i > 2)
      refuse("tetrahedra ", faces[i].tetrahedron, ", ", faces[i + 1].tetrahedron, " and ",
             faces[i + 2].tetrahedron, " share one face");
    if (end - i == 2 && faces[i].isClockwise == faces[i + 1].isClockwise)
      refuse("tetrahedra ", faces[i].tetrahedron, " and ", faces[i + 1].tetrahedron,
             " lie on the same side of a face that they share");
    if (end - i == 1) alone.push_back(faces[i]);
  }
  std::sort(alone.begin(), alone.end(), [](const Face& a, const Face& b) {
    return std::make_pair(a.tetrahedron, a.number) < std::make_pair(b.tetrahedron, b.number);
  });
  boundary_.resize(3, static_cast<Eigen::Index>(alone.size()));
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (int k = 0; k < 3; ++k)
      boundary_(k, static_cast<Eigen::Index>(i)) =
          tetrahedra_(kFaces[alone[i].number][k], alone[i].tetrahedron);
}

double TetrahedralMesh::smallestDihedralAngle() const {
  double largestCosine = -1;
  for (int t = 0; t < cellCount(); ++t) {
    Eigen::Vector3d normal[4];
    for (int f = 0; f < 4; ++f) {
      const auto point = [&](int k) { return points_.col(tetrahedra_(kFaces[f][k], t)); };
      normal[f] = (point(1) - point(0)).cross(point(2) - point(0)).normalized();
    }
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        largestCosine = std::max(largestCosine, -normal[i].dot(normal[j]));
  }
  return std::acos(std::min(1.0, largestCosine)) * 180 / 3.14159265358979323846;
}

}  // namespace palpate
