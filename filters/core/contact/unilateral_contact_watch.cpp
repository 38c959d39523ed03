// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which vertices are watched.

#include <algorithm>
#include <cmath>

#include "contact/unilateral_contact.h"

namespace palpate {

/// How far any point of an obstacle near the surface has moved to a pose, at most.
double UnilateralContact::wayOf(int obstacle, const RigidPose& pose) const noexcept {
  const MovingObstacle& moving = obstacles_[obstacle];
  if (!moving.placed) return 0;
  const double lever =
      std::min(moving.obstacle.shape->reach(), (moving.pose.position - centre_).norm() + radius_);
  return (pose.position - moving.pose.position).norm() +
         lever * moving.pose.orientation.angularDistance(pose.orientation);
}

/// The poses, and which vertices they may have brought near, or the last solve. One obstacle's way
/// counts for all: it may press the surface into another. Of obstacles and the surface the farther
/// way counts; where both move, wayLeft allows for it.
void UnilateralContact::advance(const RigidPose* poses) noexcept {
  double way = yielded_;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle)
    way = std::max(way, wayOf(obstacle, poses[obstacle]));
  travelled_ += way;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle) {
    MovingObstacle& moving = obstacles_[obstacle];
    if (!moving.placed) {
      std::fill(moving.lookAt.begin(), moving.lookAt.end(), 0);
      std::fill(moving.lookInside.begin(), moving.lookInside.end(), 0);
    }
    moving.pose = poses[obstacle];
    moving.placed = true;
  }
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle)
    for (int vertex = 0; vertex < mesh_->vertexCount(); ++vertex)
      if (obstacles_[obstacle].lookAt[vertex] <= travelled_ &&
          !obstacles_[obstacle].isWatched[vertex])
        look(obstacle, vertex);
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle) {
    const std::vector<double>& lookInsideAt = obstacles_[obstacle].lookInside;
    for (std::size_t slot = 0; slot < lookInsideAt.size(); ++slot)
      if (lookInsideAt[slot] <= travelled_) lookInside(obstacle, static_cast<int>(slot));
  }
}

/// How far obstacles and the surface may each move before a point that is pressed this far away is
/// looked at again, to be watched from a distance on. The forces can let go of it at any time,
/// hence no farther than the margin.
double UnilateralContact::wayLeft(double gap, double nearness) const noexcept {
  return std::min((gap - nearness / 2) / 2, margin_);
}

/// Watches a vertex that is near, and tells when to look at it again if it is not.
void UnilateralContact::look(int obstacle, int vertex) noexcept {
  MovingObstacle& moving = obstacles_[obstacle];
  if (isHeldFrom(obstacle, vertex)) return;  // looked at again as long as it is
  const Eigen::Vector3d place = mesh_->points().col(vertex);
  const double reach = moving.obstacle.shape->reach();
  const double atLeast = (place - moving.pose.position).norm() - reach;
  if (atLeast > margin_) {
    moving.lookAt[vertex] = travelled_ + atLeast - margin_;
    return;
  }
  const Proximity near = proximity(obstacle, place);
  if (near.distance > margin_) {
    moving.lookAt[vertex] = travelled_ + near.distance - margin_;
    return;
  }
  const Proximity now = proximity(obstacle, place + displacementOf(vertex));
  const Eigen::Vector3d& way = moving.body == 0 ? now.normal : near.normal;
  if (way.dot(mesh_->vertexNormals().col(vertex)) > kLargestCosine)
    moving.lookAt[vertex] = travelled_ + margin_ / 4;
  else if (moving.body == 0 && now.distance > margin_)
    moving.lookAt[vertex] = travelled_ + wayLeft(now.distance, margin_);
  else if (isNearestPart(obstacle, vertex, near.distance))
    watch(obstacle, vertex, near, now.distance);
}

/// The tractions of all forces on the first body.
void UnilateralContact::gatherLoads() noexcept {
  const GreensFunctions& greens = solver_.compliance().body(0);
  loadCount_ = 0;
  for (int contact = 0; contact < solver_.count(); ++contact) {
    const Eigen::Vector3d force = solver_.force(contact);
    if (force.isZero(0)) continue;
    const ContactSite& where = site(contact);
    for (int p = 0; p < where.count; ++p) {
      const auto [body, node, weight] = where.parts[p];
      if (body != 0 || greens.isFixed(node)) continue;
      loadedNodes_[loadCount_] = node;
      tractions_.segment<3>(3 * loadCount_++) = weight / greens.vertexArea(node) * force;
    }
  }
}

/// Displacement of a vertex under the gathered loads.
Eigen::Vector3d UnilateralContact::displacementOf(int vertex) const noexcept {
  const GreensFunctions& greens = solver_.compliance().body(0);
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  if (loadCount_ > 0 && !greens.isFixed(vertex))
    greens.accumulate(Eigen::Map<const Eigen::VectorXi>(loadedNodes_.data(), loadCount_),
                      tractions_.head(3 * loadCount_),
                      Eigen::Map<const Eigen::VectorXi>(&vertex, 1), displacement);
  return displacement;
}

/// Whether a vertex is not watched with a nearer part of the same tool. One that is farther, by
/// more than chatter, lets go of it.
bool UnilateralContact::isNearestPart(int obstacle, int vertex, double distance) noexcept {
  MovingObstacle& moving = obstacles_[obstacle];
  if (moving.obstacle.tool < 0) return true;
  const int held = partOf_[moving.obstacle.tool][vertex];
  if (held < 0) return true;
  const double other = proximity(held, mesh_->points().col(vertex)).distance;
  const double chatter = margin_ / 8;
  if (distance > other - chatter) {
    moving.lookAt[vertex] = travelled_ + std::max(chatter, (distance - other) / 2);
    return false;
  }
  for (int contact = 0; contact < solver_.count(); ++contact)
    if (anchors_[contact].obstacle == held && anchors_[contact].vertex == vertex) {
      unwatch(contact);
      break;
    }
  obstacles_[held].lookAt[vertex] = travelled_ + chatter;
  return true;
}

/// Whether there is room for one more point, if need be that of an open one whose gap is wider, by
/// more than chatter.
bool UnilateralContact::makeRoom(double gap) noexcept {
  if (solver_.count() < capacity()) return true;
  int widest = -1;
  double most = gap + margin_ / 8;
  for (int contact = 0; contact < solver_.count(); ++contact) {
    const ContactAnchor& anchor = anchors_[contact];
    if (solver_.status(contact) != ContactStatus::Open || anchor.isHeld || anchor.gap <= most)
      continue;
    widest = contact;
    most = anchor.gap;
  }
  if (widest < 0) return false;
  lookAgain(widest);
  unwatch(widest);
  return true;
}

/// Of a point that enters after it may have been left out, deep in an obstacle: that the force has
/// no jump, it is let out by and by.
double UnilateralContact::slackOf(double gap) const noexcept {
  return wasTruncated_ ? std::min(gap, 0.0) : 0;
}

/// Hands a point to the solver, and takes note of one in an obstacle that it cannot take.
bool UnilateralContact::enter(const ContactSite& site, double gap) noexcept {
  if (!makeRoom(gap)) {
    isTruncated_ = isTruncated_ || gap < 0;
    return false;
  }
  if (solver_.add(site)) return true;
  isUnserved_ = isUnserved_ || gap < 0;
  return false;
}

/// @param near  of the undeformed vertex.
/// @param gap   as it is deformed.
void UnilateralContact::watch(int obstacle, int vertex, const Proximity& near,
                              double gap) noexcept {
  if (!enter(siteAt(obstacle, vertex, near), gap)) return;
  const int contact = solver_.count() - 1;
  anchors_[contact] = {obstacle, vertex, -1, Eigen::Vector3d::Constant(NAN), gap, slackOf(gap)};
  obstacles_[obstacle].isWatched[vertex] = true;
  const int tool = obstacles_[obstacle].obstacle.tool;
  if (tool >= 0) partOf_[tool][vertex] = obstacle;
  ++transitions_;
}

void UnilateralContact::unwatch(int contact) noexcept {
  const int last = solver_.count() - 1;
  const int vertex = anchors_[contact].vertex;
  MovingObstacle& moving = obstacles_[anchors_[contact].obstacle];
  if (vertex >= 0) moving.isWatched[vertex] = false;
  if (vertex >= 0 && moving.obstacle.tool >= 0) partOf_[moving.obstacle.tool][vertex] = -1;
  solver_.remove(contact);
  anchors_[contact] = anchors_[last];
  ++transitions_;
}

/// Lets a point that will be watched no more be looked at in the next step.
void UnilateralContact::lookAgain(int contact) noexcept {
  const ContactAnchor& anchor = anchors_[contact];
  MovingObstacle& moving = obstacles_[anchor.obstacle];
  (anchor.vertex < 0 ? moving.lookInside[anchor.slot] : moving.lookAt[anchor.vertex]) = travelled_;
}

/// Stops watching vertices that are well away, as they are and as they would be undeformed.
void UnilateralContact::dismiss() noexcept {
  for (int contact = solver_.count() - 1; contact >= 0; --contact) {
    if (solver_.status(contact) != ContactStatus::Open || anchors_[contact].gap < 2 * margin_ ||
        anchors_[contact].vertex < 0)
      continue;
    const int obstacle = anchors_[contact].obstacle, vertex = anchors_[contact].vertex;
    const double gap = anchors_[contact].gap;
    const Proximity near = proximity(obstacle, mesh_->points().col(vertex));
    MovingObstacle& moving = obstacles_[obstacle];
    if (near.distance >= 2 * margin_)
      moving.lookAt[vertex] = travelled_ + near.distance - margin_;
    else if (moving.body == 0)
      moving.lookAt[vertex] = travelled_ + wayLeft(gap, margin_);
    else
      continue;
    unwatch(contact);
  }
}

}  // namespace palpate
