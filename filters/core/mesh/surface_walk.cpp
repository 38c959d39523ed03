// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_walk.h"

#include <Eigen/Geometry>

#include "mesh/triangle_sides.h"

namespace palpate {
namespace {

constexpr double kNoWay = 1e-12;  // of a triangle's size: what rounding may move at a corner

}  // namespace

SurfaceWalk::SurfaceWalk(std::shared_ptr<const SurfaceMesh> mesh)
    : mesh_(std::move(mesh)), across_(3 * mesh_->triangleCount()) {
  const auto opposite = [&](const TriangleSide& side) {
    int corner = 0;
    for (int v = mesh_->triangles()(corner, side.triangle); v == side.low || v == side.high;)
      v = mesh_->triangles()(++corner, side.triangle);
    return Side{side.triangle, corner};
  };
  forEachEdge(sortedSides(mesh_->triangles()), [&](auto first, auto last) {
    if (last - first < 2) return;  // a rim
    const Side one = opposite(first[0]), other = opposite(first[1]);
    across_[3 * one.triangle + one.corner] = other;
    across_[3 * other.triangle + other.corner] = one;
  });
}

SurfaceWalk::Walker SurfaceWalk::start(const SurfacePoint& point,
                                       const Eigen::Vector3d& way) const noexcept {
  const Eigen::Vector3d normal = mesh_->triangleNormals().col(point.triangle);
  const Eigen::Vector3d level = way - normal.dot(way) * normal;
  const double length = way.norm(), flat = level.norm();
  const bool isUpright = !(flat > 1e-9 * length) || !std::isfinite(length);
  return {point, isUpright ? Eigen::Vector3d::Zero() : Eigen::Vector3d(level * (length / flat))};
}

Eigen::Vector3d SurfaceWalk::step(Walker& walker) const noexcept {
  const int triangle = walker.point.triangle;
  const Eigen::Vector3d normal = mesh_->triangleNormals().col(triangle);
  const double doubleArea = 2 * mesh_->triangleAreas()[triangle];
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return mesh_->points().col(mesh_->triangles()(k % 3, triangle));
  };
  // Each coordinate grows along the normal of the edge that it vanishes on.
  Eigen::Vector3d change;
  for (int k = 0; k < 3; ++k)
    change[k] = normal.cross(corner(k + 2) - corner(k + 1)).dot(walker.ahead) / doubleArea;
  // By rounding a way along an edge could lead back over it, for ever.
  if (walker.enteredOver >= 0)
    change[walker.enteredOver] = std::max(0., change[walker.enteredOver]);

  double fraction = 1;
  int exit = -1;
  for (int k = 0; k < 3; ++k)
    if (change[k] < 0 && walker.point.barycentric[k] < -fraction * change[k]) {
      fraction = walker.point.barycentric[k] / -change[k];
      exit = k;
    }
  Eigen::Vector3d end = (walker.point.barycentric + fraction * change).cwiseMax(0);
  if (exit >= 0) end[exit] = 0;
  end /= end.sum();
  if (exit < 0) {
    walker.point.barycentric = end;
    walker.ahead.setZero();
    return end;
  }
  const Side beyond = across_[3 * triangle + exit];
  const Eigen::Vector3d edge = (corner(exit + 2) - corner(exit + 1)).normalized();
  const bool hasMoved = fraction * walker.ahead.norm() > kNoWay * std::sqrt(doubleArea);
  if (beyond.triangle < 0) {
    meetRim(walker, exit, end, fraction, hasMoved);
    return end;
  }
  walker.isCornered = walker.isCornered && !hasMoved;
  const Eigen::Vector3d left = (1 - fraction) * walker.ahead;
  walker.ahead = left.dot(edge) * edge +
                 left.dot(edge.cross(normal)) *
                     edge.cross(Eigen::Vector3d(mesh_->triangleNormals().col(beyond.triangle)));
  walker.point.triangle = beyond.triangle;
  walker.point.barycentric[beyond.corner] = 0;
  walker.point.barycentric[(beyond.corner + 1) % 3] = end[(exit + 2) % 3];
  walker.point.barycentric[(beyond.corner + 2) % 3] = end[(exit + 1) % 3];
  walker.enteredOver = beyond.corner;
  return end;
}

/// Turns what is left of the way along a rim, or ends it where it leads out over a corner twice.
void SurfaceWalk::meetRim(Walker& walker, int exit, const Eigen::Vector3d& end, double fraction,
                          bool hasMoved) const noexcept {
  const int triangle = walker.point.triangle;
  const Eigen::Vector3i corners = mesh_->triangles().col(triangle);
  const int low = (exit + 1) % 3, high = (exit + 2) % 3;
  const Eigen::Vector3d rim =
      mesh_->points().col(corners[high]) - mesh_->points().col(corners[low]);
  const double length = rim.norm(), along = walker.ahead.dot(rim) / length;
  const bool leadsOut = end[along > 0 ? low : high] <= kNoWay;
  const bool isEnd = leadsOut && walker.isCornered && !hasMoved;
  walker.point.barycentric = end;
  walker.ahead =
      isEnd ? Eigen::Vector3d::Zero() : Eigen::Vector3d((1 - fraction) * along / length * rim);
  walker.enteredOver = exit;
  walker.isCornered = leadsOut;
}

SurfaceWalk::Walker SurfaceWalk::walk(const SurfacePoint& point, const Eigen::Vector3d& way,
                                      int mostSteps) const noexcept {
  Walker walker = start(point, way);
  for (int steps = 0; !walker.hasArrived() && steps < mostSteps; ++steps) step(walker);
  return walker;
}

}  // namespace palpate
