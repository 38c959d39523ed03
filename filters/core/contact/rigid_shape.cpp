// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/rigid_shape.h"

#include <algorithm>
#include <stdexcept>
#include <string>

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

}  // namespace

SphereShape::SphereShape(double radius) : radius_(radius) {
  requirePositive(radius);
}

Proximity SphereShape::proximity(const Eigen::Vector3d& place) const noexcept {
  return toBall(place, radius_);
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

double CapsuleShape::reach() const noexcept {
  return std::max(from_.norm(), (from_ + axis_).norm()) + radius_;
}

}  // namespace palpate
