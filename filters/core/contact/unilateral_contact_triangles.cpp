// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Contacts inside triangles.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contact/unilateral_contact.h"
#include "mesh/triangle_queries.h"

namespace palpate {
namespace {

/// How far an obstacle moves before a triangle that is near, but has its deepest point in a corner
/// or on another part of the tool, is looked at again: of the margin, and of a smooth tool's
/// radius. The depth missed between is the square of it over twice that radius.
constexpr double kSoon = 1.0 / 32, kSoonOfRadius = 1.0 / 256;
constexpr double kNeighbourhood = 0.1;  ///< of the mean edge
constexpr int kBalanceSteps = 12;
constexpr double kSiteAccuracy = 1e-4;  ///< of barycentric coordinates
/// From a corner, in barycentric coordinates, where a point begins to be watched. Farther off, a
/// tool that is small beside the edge would lie deep in the triangle by then, and the force jump.
constexpr double kOffCorner = kSiteAccuracy;
/// Slope of the gap along both edges from a corner, above which a point there is let go of: a
/// ball's foot is then beyond the corner by so many of its radii. Below, noise would bring it back.
constexpr double kBeyondCorner = 0.03;
constexpr double kSameWay = 0.866;  ///< cosine between normals, from which triangles face one way

/// Whether no point of a triangle is farther than so from another one that faces the same way. The
/// distance from a triangle is convex: it is largest in a corner.
bool isBeside(const SurfaceMesh& mesh, int triangle, int other, double distance) {
  if (mesh.triangleNormals().col(triangle).dot(mesh.triangleNormals().col(other)) < kSameWay)
    return false;
  const auto corner = [&mesh](int t, int k) { return mesh.points().col(mesh.triangles()(k, t)); };
  const Eigen::Vector3d a = corner(other, 0), b = corner(other, 1), c = corner(other, 2);
  const double reach = mesh.longestEdge(other) + distance;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d x = corner(triangle, k);
    if ((x - a).squaredNorm() > reach * reach) return false;
    const Eigen::Vector3d at = nearestInTriangle(x, a, b, c);
    if ((at[0] * a + at[1] * b + at[2] * c - x).squaredNorm() > distance * distance) return false;
  }
  return true;
}

double soon(const MovingObstacle& moving, double margin) {
  if (moving.isMany) return kSoon * margin;
  const double radius = moving.obstacle.shape->smallestRadius();
  return std::min(kSoon * margin, kSoonOfRadius * radius);
}

}  // namespace

/// A point of a triangle as it is deformed.
struct UnilateralContact::FacePoint {
  Eigen::Vector3d barycentric, place, faceNormal;
  Proximity near;

  bool isCorner(double within = 1e-9) const { return barycentric.maxCoeff() > 1 - within; }
  /// Whether it would be beyond a corner if the triangle went on there.
  bool isBeyondCorner(const Eigen::Matrix3d& corners) const {
    if (!isCorner()) return false;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = corners.col(k) - place;
      if (barycentric[k] < 0.5 && near.normal.dot(edge) < kBeyondCorner * edge.norm()) return false;
    }
    return true;
  }
};

/// Slivers beside one that is touched inside are left out, up to half the limit on either side: the
/// gaps between are then no wider than the edges that are left alone.
void UnilateralContact::findLargeTriangles() {
  for (MovingObstacle& moving : obstacles_) {
    if (moving.body > 0) continue;
    const RigidShape& shape = *moving.obstacle.shape;
    const int tool = moving.obstacle.tool;
    const auto parts = std::count_if(obstacles_.begin(), obstacles_.end(), [&](const auto& other) {
      return tool >= 0 && other.obstacle.tool == tool;
    });
    moving.isMany = parts > 1 || shape.isFaceted();
    const double limit = (moving.isMany ? kLargeEdgeOfMany : kLargeEdge) * shape.smallestRadius();
    std::vector<int> slivers;
    for (int triangle = 0; triangle < mesh_->triangleCount(); ++triangle) {
      const double edge = mesh_->longestEdge(triangle);
      if (edge <= limit) continue;
      const bool isNarrow = 2 * mesh_->triangleAreas()[triangle] < limit / 2 * edge;
      (isNarrow ? slivers : moving.large).push_back(triangle);
    }
    for (const int sliver : slivers)
      if (std::none_of(moving.large.begin(), moving.large.end(),
                       [&](int chosen) { return isBeside(*mesh_, sliver, chosen, limit / 2); }))
        moving.large.push_back(sliver);
    moving.lookInside.assign(moving.large.size(), 0);
  }
}

Eigen::Matrix3d UnilateralContact::restCorners(int triangle) const noexcept {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = mesh_->points().col(mesh_->triangles()(k, triangle));
  return corners;
}

/// The corners of a triangle under the gathered loads.
Eigen::Matrix3d UnilateralContact::cornersOf(int triangle) const noexcept {
  Eigen::Matrix3d corners = restCorners(triangle);
  for (int k = 0; k < 3; ++k) corners.col(k) += displacementOf(mesh_->triangles()(k, triangle));
  return corners;
}

Eigen::Vector3d UnilateralContact::deepestIn(int obstacle,
                                             const Eigen::Matrix3d& corners) const noexcept {
  const MovingObstacle& moving = obstacles_[obstacle];
  Eigen::Matrix3d own;
  for (int k = 0; k < 3; ++k) own.col(k) = moving.pose.toOwn(corners.col(k));
  return moving.obstacle.shape->deepest(own);
}

UnilateralContact::FacePoint UnilateralContact::facePoint(
    int obstacle, const Eigen::Matrix3d& corners,
    const Eigen::Vector3d& barycentric) const noexcept {
  const Eigen::Vector3d place = corners * barycentric;
  return {barycentric, place,
          (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized(),
          proximity(obstacle, place)};
}

/// The point of a contact's triangle that is deepest when the contact's force acts there: the
/// centre of pressure. As the force goes on, the triangle tilts away from where it presses and its
/// deepest point comes back: steps are halved whenever it turns.
Eigen::Vector3d UnilateralContact::balance(int contact,
                                           const Eigen::Matrix3d& corners) const noexcept {
  const GreensFunctions& greens = solver_.compliance().body(0);
  const ContactSite& where = site(contact);
  const Eigen::Vector3d force = solver_.force(contact);
  std::array<Eigen::Matrix3d, 3> moved;  // all corners, by the force at each one
  Eigen::Vector3d point;
  Eigen::Matrix3d unmoved = corners;
  for (int j = 0; j < 3; ++j) {
    const int loaded = where.parts[j].node;
    for (int k = 0; k < 3; ++k) {
      const int node = where.parts[k].node;
      Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
      if (!greens.isFixed(loaded) && !greens.isFixed(node))
        greens.gather(Eigen::Map<const Eigen::VectorXi>(&node, 1),
                      Eigen::Map<const Eigen::VectorXi>(&loaded, 1), block.data());
      moved[j].col(k) = block * force / greens.vertexArea(loaded);
    }
    point[j] = where.parts[j].weight;
    unmoved -= point[j] * moved[j];
  }
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double share = 1;
  for (int k = 0; k < kBalanceSteps; ++k) {
    const Eigen::Vector3d step =
        deepestIn(anchors_[contact].obstacle,
                  unmoved + point[0] * moved[0] + point[1] * moved[1] + point[2] * moved[2]) -
        point;
    if (step.dot(before) < 0) share /= 2;
    point += share * step;
    before = step;
    if (step.cwiseAbs().maxCoeff() < kSiteAccuracy) break;
  }
  return point;
}

/// Whether no other part of the same tool holds the point more deeply, by more than chatter.
bool UnilateralContact::isDeepestPart(int obstacle, const FacePoint& point) const noexcept {
  const int tool = obstacles_[obstacle].obstacle.tool;
  for (int other = 0; tool >= 0 && other < obstacleCount(); ++other)
    if (other != obstacle && obstacles_[other].obstacle.tool == tool &&
        proximity(other, point.place).distance < point.near.distance - margin_ / 8)
      return false;
  return true;
}

/// As look, for the inside of a triangle.
void UnilateralContact::lookInside(int obstacle, int slot) noexcept {
  MovingObstacle& moving = obstacles_[obstacle];
  double& lookAt = moving.lookInside[slot];
  const int triangle = moving.large[slot];
  if (isHeldBeside(triangle)) return;
  const Eigen::Matrix3d corners = restCorners(triangle);
  const Eigen::Vector3d middle = corners.rowwise().mean();
  const double size = (corners.colwise() - middle).colwise().norm().maxCoeff();
  double atLeast = (middle - moving.pose.position).norm() - moving.obstacle.shape->reach() - size;
  const double nearness = kNear * margin_;
  if (atLeast <= nearness) atLeast = proximity(obstacle, middle).distance - size;
  if (atLeast > nearness) {
    lookAt = travelled_ + atLeast - nearness;
    return;
  }
  const Eigen::Matrix3d now = cornersOf(triangle);
  const FacePoint point = facePoint(obstacle, now, deepestIn(obstacle, now));
  if (point.near.distance > nearness)
    lookAt = travelled_ + wayLeft(point.near.distance, nearness);
  else if (point.isCorner(kOffCorner) || point.near.normal.dot(point.faceNormal) > kLargestCosine ||
           !isDeepestPart(obstacle, point))
    lookAt = travelled_ + soon(moving, margin_);
  else if (watchInside(obstacle, slot, point))
    lookAt = std::numeric_limits<double>::infinity();
}

bool UnilateralContact::watchInside(int obstacle, int slot, const FacePoint& point) noexcept {
  const int triangle = obstacles_[obstacle].large[slot];
  if (!enter(ContactSite::inTriangle(0, mesh_->triangles().col(triangle), point.barycentric),
             point.near.distance))
    return false;
  const int contact = solver_.count() - 1;
  anchors_[contact] = {obstacle,
                       -1,
                       slot,
                       Eigen::Vector3d::Constant(NAN),
                       point.near.distance,
                       slackOf(point.near.distance),
                       point.faceNormal};
  ++transitions_;
  inheritSlip(contact, point.place);
  return true;
}

/// Where a contact with a tool lies by the displacements of its nodes under the gathered loads:
/// without the yield of fixed ones and what its site is raised by, which go with its force.
Eigen::Vector3d UnilateralContact::placeByNodes(int contact) const noexcept {
  const ContactSite& where = site(contact);
  Eigen::Vector3d place = restPlace(contact);
  for (int p = 0; p < where.count; ++p)
    place += where.parts[p].weight * displacementOf(where.parts[p].node);
  return place;
}

/// A contact that goes on over an edge sticks, or has slipped, as it did before.
void UnilateralContact::inheritSlip(int contact, const Eigen::Vector3d& place) noexcept {
  ContactAnchor& anchor = anchors_[contact];
  const RigidPose& pose = obstacles_[anchor.obstacle].pose;
  double nearest = kNeighbourhood * mesh_->meanEdgeLength();
  for (int other = 0; other < contact; ++other) {
    const double away = (restPlace(other) - restPlace(contact)).norm();
    if (anchors_[other].obstacle != anchor.obstacle || away > nearest ||
        solver_.force(other).isZero(0))
      continue;
    nearest = away;
    anchor.place = pose.toOwn(place - placeByNodes(other) + pose.toWorld(anchors_[other].place));
  }
}

/// Lets a contact go on to another point of its triangle. If it sticks, it sticks as far from
/// there: both places are those of the corners alone, or each move would shed what goes with the
/// force, and a contact at rest would creep.
/// @return whether it is another point.
bool UnilateralContact::moveInside(int contact, const Eigen::Matrix3d& corners,
                                   const FacePoint& point) noexcept {
  ContactAnchor& anchor = anchors_[contact];
  anchor.faceNormal = point.faceNormal;
  ContactSite moved = site(contact);
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double way = 0;
  for (int k = 0; k < 3; ++k) {
    before += moved.parts[k].weight * corners.col(k);
    way = std::max(way, std::abs(point.barycentric[k] - moved.parts[k].weight));
    moved.parts[k].weight = point.barycentric[k];
  }
  if (way <= kSiteAccuracy) return false;
  const RigidPose& pose = obstacles_[anchor.obstacle].pose;
  if (anchor.place.allFinite()) anchor.place += pose.toOwn(point.place) - pose.toOwn(before);
  solver_.move(contact, moved);
  return true;
}

/// Brings contacts inside triangles to where the obstacles are deepest. Between steps, stops
/// watching those that bear nothing and are well away or beyond a corner, and those on another
/// part.
/// @return whether it has moved any or let go of one.
bool UnilateralContact::followInside(bool betweenSteps) noexcept {
  const auto isInside = [](const ContactAnchor& anchor) { return anchor.vertex < 0; };
  if (std::none_of(anchors_.begin(), anchors_.begin() + solver_.count(), isInside)) return false;
  const double nearness = kNear * margin_;
  bool isChanged = false;
  gatherLoads();  // advance may have let go of some, and a solve changes them
  for (int contact = solver_.count() - 1; contact >= 0; --contact) {
    if (anchors_[contact].vertex >= 0 || anchors_[contact].isHeld) continue;
    const int obstacle = anchors_[contact].obstacle, slot = anchors_[contact].slot;
    MovingObstacle& moving = obstacles_[obstacle];
    const Eigen::Matrix3d corners = cornersOf(moving.large[slot]);
    const bool idle = solver_.force(contact).isZero(0);
    const FacePoint point = facePoint(
        obstacle, corners, idle ? deepestIn(obstacle, corners) : balance(contact, corners));
    const bool isElsewhere =
        idle && (point.isBeyondCorner(corners) || point.near.distance >= 2 * nearness);
    if (!betweenSteps || (!isElsewhere && isDeepestPart(obstacle, point))) {
      if (!idle || point.near.distance < nearness / 2)
        isChanged = moveInside(contact, corners, point) || isChanged;
      continue;
    }
    moving.lookInside[slot] =
        travelled_ + std::max(soon(moving, margin_), wayLeft(point.near.distance, nearness));
    unwatch(contact);
    isChanged = true;
  }
  return isChanged;
}

}  // namespace palpate
