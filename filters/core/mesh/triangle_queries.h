// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// Questions to a surface that are answered triangle by triangle, in any order: each keeps the best
// answer so far and with it a bound on the boxes of triangles that still matter.

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>

#include "mesh/surface_point.h"

namespace palpate {

/// Point of a triangle nearest to x, in barycentric coordinates (Ericson, "Real-time collision
/// detection", 5.1.5).
inline Eigen::Vector3d nearestInTriangle(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double d1 = ab.dot(x - a), d2 = ac.dot(x - a);
  const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
  const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

/// The point nearest to a place.
class NearestPoint {
 public:
  NearestPoint(const SurfaceMesh& mesh, const Eigen::Vector3d& place)
      : mesh_(mesh), place_(place) {}

  void visit(int triangle) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return mesh_.points().col(mesh_.triangles()(k, triangle));
    };
    const SurfacePoint here{triangle, nearestInTriangle(place_, corner(0), corner(1), corner(2))};
    const double distance = (placeOf(mesh_, here) - place_).squaredNorm();
    if (distance < smallest_) {
      smallest_ = distance;
      point_ = here;
    }
  }
  /// Boxes at this distance squared or farther hold no better answer.
  double bound() const { return smallest_; }
  /// Distance squared to a box.
  double distance(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
    return (place_ - place_.cwiseMax(low).cwiseMin(high)).squaredNorm();
  }
  const SurfacePoint& point() const { return point_; }

 private:
  const SurfaceMesh& mesh_;
  Eigen::Vector3d place_;
  double smallest_ = std::numeric_limits<double>::infinity();
  SurfacePoint point_{0, Eigen::Vector3d::UnitX()};
};

/// Where a segment first meets the surface. Triangles are taken to be larger by a margin, so that
/// no segment slips through between them.
class FirstCrossing {
 public:
  /// @param entriesOnly  whether crossings out of the material are passed over.
  FirstCrossing(const SurfaceMesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                bool entriesOnly)
      : mesh_(mesh),
        from_(from),
        way_(to - from),
        length_(way_.norm()),
        margin_(kMargin * mesh.diagonal()),
        bound_(1 + margin_ / length_),
        entriesOnly_(entriesOnly) {}

  void visit(int triangle) {
    const Eigen::Vector3i t = mesh_.triangles().col(triangle);
    const Eigen::Vector3d a = mesh_.points().col(t[0]) - from_;
    const Eigen::Vector3d b = mesh_.points().col(t[1]) - from_;
    const Eigen::Vector3d c = mesh_.points().col(t[2]) - from_;
    // Six-fold volumes of the segment with each edge: way . n times the coordinates of where they
    // meet.
    Eigen::Vector3d volumes(way_.dot(b.cross(c - b)), way_.dot(c.cross(a - c)),
                            way_.dot(a.cross(b - a)));
    const double sum = volumes.sum();
    const double facing = mesh_.triangleNormals().col(triangle).dot(way_);
    const bool isEntry = facing < 0;
    if (entriesOnly_ && !isEntry) return;
    if (!(std::abs(facing) > kMargin * length_) || !(sum * facing > 0)) return;
    const double sign = isEntry ? -1 : 1;
    if (sign * volumes[0] < -margin_ * length_ * (c - b).norm() ||
        sign * volumes[1] < -margin_ * length_ * (a - c).norm() ||
        sign * volumes[2] < -margin_ * length_ * (b - a).norm())
      return;
    Eigen::Vector3d barycentric = (sign * volumes).cwiseMax(0);
    barycentric /= barycentric.sum();
    const Eigen::Vector3d place = a * barycentric[0] + b * barycentric[1] + c * barycentric[2];
    const double fraction = place.dot(way_) / (length_ * length_);
    if (fraction >= bound_ || fraction < -margin_ / length_) return;
    bound_ = fraction;
    point_ = {triangle, barycentric};
    isEntry_ = isEntry;
  }
  /// Boxes that the segment enters from this fraction of its length on hold no earlier crossing.
  double bound() const { return bound_; }
  /// Fraction of its length at which the segment enters a box; infinite if it does not.
  double entrance(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
    double first = -margin_ / length_, last = bound_;
    for (int k = 0; k < 3; ++k) {
      const double below = low[k] - margin_ - from_[k], above = high[k] + margin_ - from_[k];
      if (way_[k] == 0) {
        if (below > 0 || above < 0) return std::numeric_limits<double>::infinity();
        continue;
      }
      first = std::max(first, std::min(below / way_[k], above / way_[k]));
      last = std::min(last, std::max(below / way_[k], above / way_[k]));
    }
    return first <= last ? first : std::numeric_limits<double>::infinity();
  }
  bool found() const { return point_.triangle >= 0; }
  bool isEntry() const { return isEntry_; }
  const SurfacePoint& point() const { return point_; }

 private:
  /// Of the body's diagonal: far more than rounding moves a place by. Crossings this far beyond the
  /// segment's ends count, so that none is lost between a segment and the one that goes on from its
  /// end.
  static constexpr double kMargin = 1e-12;

  const SurfaceMesh& mesh_;
  Eigen::Vector3d from_, way_;
  double length_, margin_, bound_;
  bool entriesOnly_, isEntry_ = false;
  SurfacePoint point_{-1, Eigen::Vector3d::Zero()};
};

}  // namespace palpate
