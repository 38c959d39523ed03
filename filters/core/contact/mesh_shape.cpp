// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "mesh/smooth_patches.h"
#include "mesh/triangle_queries.h"
#include "mesh/triangle_sides.h"

namespace palpate {
namespace {

constexpr double kSmoothAngle = 30;  ///< degrees, between the normals beside an edge
constexpr double kOnEdge = 1e-12;    ///< of barycentric coordinates

/// A triangle's normal, by the angle at one of its corners.
Eigen::Vector3d weightedNormal(const SurfaceMesh& mesh, int triangle, int corner) {
  const auto place = [&](int k) -> Eigen::Vector3d {
    return mesh.points().col(mesh.triangles()(k % 3, triangle));
  };
  const Eigen::Vector3d a = place(corner + 1) - place(corner),
                        b = place(corner + 2) - place(corner);
  return std::atan2(a.cross(b).norm(), a.dot(b)) * mesh.triangleNormals().col(triangle);
}

Eigen::Matrix3Xd angleWeightedNormals(const SurfaceMesh& mesh) {
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) normals.col(mesh.triangles()(k, f)) += weightedNormal(mesh, f, k);
  return normals;
}

/// Sums of the weighted normals of a triangle's patch at each corner, at 3 f + k.
Eigen::Matrix3Xd patchNormals(const SurfaceMesh& mesh, const Eigen::VectorXi& patches) {
  std::map<std::pair<int, int>, Eigen::Vector3d> sums;  // of a vertex and patch
  const auto sum = [&](int f, int k) -> Eigen::Vector3d& {
    const std::pair key(mesh.triangles()(k, f), patches[f]);
    return sums.try_emplace(key, Eigen::Vector3d::Zero()).first->second;
  };
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) sum(f, k) += weightedNormal(mesh, f, k);
  Eigen::Matrix3Xd normals(3, 3 * mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) normals.col(3 * f + k) = sum(f, k).normalized();
  return normals;
}

/// Whether the edge opposite to corner k of triangle f is a rim of its patch, at 3 f + k.
std::vector<char> rimsOf(const SurfaceMesh& mesh, const Eigen::VectorXi& patches) {
  std::vector<char> isRim(3 * std::size_t(mesh.triangleCount()), false);
  forEachEdge(sortedSides(mesh.triangles()), [&](auto first, auto last) {
    const bool smooth = std::distance(first, last) == 2 &&
                        patches[first->triangle] == patches[std::next(first)->triangle];
    for (auto side = first; !smooth && side != last; ++side)
      for (int k = 0; k < 3; ++k) {
        const int vertex = mesh.triangles()(k, side->triangle);
        if (vertex != side->low && vertex != side->high) isRim[3 * side->triangle + k] = true;
      }
  });
  return isRim;
}

/// Sums of the normals on both sides of the edge opposite to corner k of triangle f, at 3 f + k.
Eigen::Matrix3Xd edgeNormals(const SurfaceMesh& mesh) {
  Eigen::Matrix3Xd normals(3, 3 * mesh.triangleCount());
  forEachEdge(sortedSides(mesh.triangles()), [&](auto first, auto last) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto side = first; side != last; ++side) sum += mesh.triangleNormals().col(side->triangle);
    for (auto side = first; side != last; ++side)
      for (int k = 0; k < 3; ++k) {
        const int vertex = mesh.triangles()(k, side->triangle);
        if (vertex != side->low && vertex != side->high) normals.col(3 * side->triangle + k) = sum;
      }
  });
  return normals;
}

double smallestConvexRadius(const SurfaceMesh& mesh) {
  constexpr double sharp = 3.14159265358979323846 / 6;
  double smallest = std::numeric_limits<double>::infinity();
  forEachEdge(sortedSides(mesh.triangles()), [&](auto first, auto last) {
    const Eigen::Vector3d edge = mesh.points().col(first->high) - mesh.points().col(first->low);
    for (auto one = first; one != last; ++one)
      for (auto other = std::next(one); other != last; ++other) {
        const Eigen::Vector3d across = mesh.triangleNormals()
                                           .col(one->triangle)
                                           .cross(mesh.triangleNormals().col(other->triangle));
        const double turn = std::atan2((one->upwards ? 1 : -1) * across.dot(edge) / edge.norm(),
                                       mesh.triangleNormals()
                                           .col(one->triangle)
                                           .dot(mesh.triangleNormals().col(other->triangle)));
        if (turn <= 0) continue;  // concave
        const double centres =
            2.0 / 3 / edge.norm() *
            (mesh.triangleAreas()[one->triangle] + mesh.triangleAreas()[other->triangle]);
        smallest = std::min(smallest, turn > sharp ? 0 : centres / turn);
      }
  });
  return smallest;
}

}  // namespace

MeshShape::MeshShape(std::shared_ptr<const SurfaceMesh> mesh)
    : locator_(mesh),
      vertexNormals_(angleWeightedNormals(*mesh)),
      edgeNormals_(edgeNormals(*mesh)),
      reach_(mesh->points().colwise().norm().maxCoeff()),
      smallestRadius_(smallestConvexRadius(*mesh)) {
  const Eigen::VectorXi patches = findSmoothPatches(*mesh, kSmoothAngle);
  cornerNormals_ = patchNormals(*mesh, patches);
  isSharp_ = rimsOf(*mesh, patches);
}

Eigen::Vector3d MeshShape::smoothNormal(const Proximity& near) const noexcept {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (near.barycentric[k] <= kOnEdge && isSharp_[3 * near.triangle + k]) return near.normal;
    normal += near.barycentric[k] * cornerNormals_.col(3 * near.triangle + k);
  }
  return normal.normalized();
}

Eigen::Vector3d MeshShape::pseudonormal(const SurfacePoint& point) const noexcept {
  const Eigen::Vector3d& weights = point.barycentric;
  int corner = -1, zeros = 0;
  for (int k = 0; k < 3; ++k)
    if (weights[k] <= kOnEdge) {
      ++zeros;
      corner = k;
    }
  if (zeros == 0) return locator_.mesh().triangleNormals().col(point.triangle);
  if (zeros == 1) return edgeNormals_.col(3 * point.triangle + corner);
  int largest;
  weights.maxCoeff(&largest);
  return vertexNormals_.col(locator_.mesh().triangles()(largest, point.triangle));
}

Proximity MeshShape::proximity(const Eigen::Vector3d& place) const noexcept {
  const SurfacePoint nearest = locator_.nearest(place);
  const Eigen::Vector3d away = place - placeOf(locator_.mesh(), nearest);
  const Eigen::Vector3d outwards = pseudonormal(nearest);
  const double length = away.norm(), sign = away.dot(outwards) < 0 ? -1 : 1;
  Proximity proximity;
  proximity.distance = sign * length;
  // On the surface itself, and as near as rounding, the direction of the difference means nothing.
  proximity.normal = length > 1e-9 * reach_ ? (sign / length * away).eval() : outwards.normalized();
  proximity.triangle = nearest.triangle;
  proximity.barycentric = nearest.barycentric;
  return proximity;
}

Eigen::Vector3d MeshShape::deepest(const Eigen::Matrix3d& corners) const noexcept {
  constexpr double third = 1.0 / 3, accuracy = 1e-3;
  const double size = (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff();
  Eigen::Vector3d best = Eigen::Vector3d::Constant(third);
  Proximity depth = proximity(corners * best);
  for (int k = 0; k < 3; ++k)
    if (const Proximity corner = proximity(corners.col(k)); corner.distance < depth.distance) {
      best = Eigen::Vector3d::Unit(k);
      depth = corner;
    }
  constexpr int mostSteps = 48;
  double step = size / 2;
  for (int k = 0; k < mostSteps && step > accuracy * size; ++k) {
    const Eigen::Vector3d point = nearestInTriangle(corners * best - step * depth.normal,
                                                    corners.col(0), corners.col(1), corners.col(2));
    const Proximity there = proximity(corners * point);
    if (there.distance < depth.distance) {
      best = point;
      depth = there;
    } else {
      step /= 2;
    }
  }
  return best;
}

}  // namespace palpate
