// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Obstacles that are deep in the body when contact begins.

#include <algorithm>

#include "contact/unilateral_contact.h"
#include "mesh/surface_point.h"

namespace palpate {
namespace {

/// Of the radius around its core: an obstacle that is deeper may press the surface to any side.
constexpr double kDeep = 0.5;
constexpr double kBehind = 3;     ///< radii, behind a sheet, where it is another side's
constexpr double kReturn = 0.1;   ///< of the margin, a step
constexpr double kClear = 1e-3;   ///< of the margin, off the surface
constexpr int kWithdrawals = 32;  ///< each by the deepest point's depth

}  // namespace

/// The deepest point of an obstacle's core, at a place, in the undeformed surface.
UnilateralContact::Depth UnilateralContact::depthOf(int obstacle,
                                                    const RigidPose& pose) const noexcept {
  const RigidShape& shape = *obstacles_[obstacle].obstacle.shape;
  const double radius = shape.coreRadius();
  Depth deepest;
  for (int k = 0; k < shape.coreCount(); ++k) {
    const Eigen::Vector3d place = pose.toWorld(shape.core(k));
    if ((place - centre_).norm() > radius_ + radius) continue;
    const SurfacePoint point = locator_.nearest(place);
    const Eigen::Vector3d to = palpate::placeOf(*mesh_, point) - place;
    const double distance = to.norm();
    const bool isInside = locator_.isInside(place);
    if (isInside && mesh_->rims() == Rims::Allowed && distance > kBehind * radius) continue;
    const double depth = isInside ? radius + distance : radius - distance;
    if (depth <= deepest.depth) continue;
    deepest.depth = depth;
    deepest.way = distance > kClear * margin_
                      ? Eigen::Vector3d((isInside ? 1 : -1) / distance * to)
                      : Eigen::Vector3d(mesh_->triangleNormals().col(point.triangle));
  }
  return deepest;
}

/// The way to where an obstacle that is deep in the body is just outside; zero if it is not deep.
/// Found by going on out of the deepest place, or else past all of the body.
Eigen::Vector3d UnilateralContact::wayOut(int obstacle, const RigidPose& pose) const noexcept {
  const RigidShape& shape = *obstacles_[obstacle].obstacle.shape;
  const double radius = shape.coreRadius();
  Depth deepest = depthOf(obstacle, pose);
  if (deepest.depth <= (radius > 0 ? kDeep * radius : margin_)) return Eigen::Vector3d::Zero();
  RigidPose outside = pose;
  for (int k = 0; k < kWithdrawals; ++k) {
    outside.position += (deepest.depth + kClear * margin_) * deepest.way;
    deepest = depthOf(obstacle, outside);
    if (deepest.depth <= 0) return outside.position - pose.position;
  }
  const Eigen::Vector3d from = pose.position - centre_;
  const double distance = from.norm();
  return (radius_ + shape.reach() + margin_) *
         (distance > 0 ? Eigen::Vector3d(from / distance) : Eigen::Vector3d::UnitZ());
}

/// Where the obstacles are taken to be: of those that were deep in the body when contact began,
/// on their way in.
const RigidPose* UnilateralContact::broughtIn(const RigidPose* poses) noexcept {
  startedInside_ = false;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle) {
    MovingObstacle& moving = obstacles_[obstacle];
    const double away = moving.away.norm();
    if (!moving.placed) {
      moving.away = wayOut(obstacle, poses[obstacle]);
      startedInside_ = startedInside_ || !moving.away.isZero(0);
    } else if (away > 0) {
      moving.away *= std::max(0.0, 1 - kReturn * margin_ / away);
    }
    taken_[obstacle] = poses[obstacle];
    taken_[obstacle].position += moving.away;
  }
  return taken_.data();
}

}  // namespace palpate
