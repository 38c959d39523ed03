// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/rigid_shape.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "mesh/triangle_queries.h"

namespace palpate {
namespace {

void requirePositive(double radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw std::invalid_argument("the radius of a tool must be positive, not " +
                                std::to_string(radius));
}

/// Of a ball around the origin; at its centre every way out is as good.
Proximity toBall(const Eigen::Vector3d& place, double radius) {
  const double length = place.norm();
  return {length - radius, length > 0 ? (place / length).eval() : Eigen::Vector3d::UnitZ().eval()};
}

/// Where on the segment from a to b the other segment, from p to q, comes nearest, as a share of it
/// (Ericson, "Real-time collision detection", 5.1.9).
double nearestShare(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p,
                    const Eigen::Vector3d& q) {
  const Eigen::Vector3d along = b - a, other = q - p, between = a - p;
  const double aa = along.squaredNorm(), oo = other.squaredNorm(), ao = along.dot(other);
  const double ab = along.dot(between), ob = other.dot(between);
  const double determinant = aa * oo - ao * ao;
  if (!(aa > 0)) return 0;
  double share = determinant > 0 ? std::clamp((ao * ob - ab * oo) / determinant, 0.0, 1.0) : 0;
  const double opposite = oo > 0 ? std::clamp((ao * share + ob) / oo, 0.0, 1.0) : 0;
  share = (ao * opposite - ab) / aa;
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace

SphereShape::SphereShape(double radius) : radius_(radius) {
  requirePositive(radius);
}

Proximity SphereShape::proximity(const Eigen::Vector3d& place) const noexcept {
  return toBall(place, radius_);
}

Eigen::Vector3d SphereShape::deepest(const Eigen::Matrix3d& corners) const noexcept {
  return nearestInTriangle(Eigen::Vector3d::Zero(), corners.col(0), corners.col(1), corners.col(2));
}

CapsuleShape::CapsuleShape(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius)
    : from_(from), axis_(to - from), radius_(radius) {
  requirePositive(radius);
  if (!from.allFinite() || !to.allFinite())
    throw std::invalid_argument("the ends of a capsule must be finite");
}

Proximity CapsuleShape::proximity(const Eigen::Vector3d& place) const noexcept {
  const double length = axis_.squaredNorm();
  const double along = length > 0 ? std::clamp(axis_.dot(place - from_) / length, 0.0, 1.0) : 0.0;
  return toBall(place - from_ - along * axis_, radius_);
}

/// A segment comes nearest to a triangle at one of its ends or on one of the triangle's edges,
/// unless it pierces the triangle, where no way out is better than another.
Eigen::Vector3d CapsuleShape::deepest(const Eigen::Matrix3d& corners) const noexcept {
  const Eigen::Vector3d to = from_ + axis_;
  std::array<Eigen::Vector3d, 2 + 3> candidates;
  candidates[0] = nearestInTriangle(from_, corners.col(0), corners.col(1), corners.col(2));
  candidates[1] = nearestInTriangle(to, corners.col(0), corners.col(1), corners.col(2));
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double share = nearestShare(corners.col(k), corners.col(next), from_, to);
    candidates[2 + k].setZero();
    candidates[2 + k][k] = 1 - share;
    candidates[2 + k][next] = share;
  }
  const auto distance = [&](const Eigen::Vector3d& point) {
    return proximity(corners * point).distance;
  };
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
}

double CapsuleShape::reach() const noexcept {
  return std::max(from_.norm(), (from_ + axis_).norm()) + radius_;
}

Eigen::Vector3d PlaneShape::deepest(const Eigen::Matrix3d& corners) const noexcept {
  int lowest;
  corners.row(2).minCoeff(&lowest);
  return Eigen::Vector3d::Unit(lowest);
}

}  // namespace palpate
