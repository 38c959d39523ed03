// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Geometry>
#include <limits>

namespace palpate {

/// Where a rigid body is: a point x of its own frame lies at position + orientation x.
struct RigidPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  Eigen::Vector3d toWorld(const Eigen::Vector3d& own) const { return position + orientation * own; }
  Eigen::Vector3d toOwn(const Eigen::Vector3d& world) const {
    return orientation.conjugate() * (world - position);
  }
};

/// How a place lies to a body.
struct Proximity {
  double distance;         ///< m, negative inside
  Eigen::Vector3d normal;  ///< unit, the way out: the distance's gradient
  int triangle = -1;       ///< the nearest one, of bodies that have triangles
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();  ///< of the nearest point there
};

/// The shape of a tool in its own frame. Queries are const, allocate nothing and are safe from
/// several threads.
class RigidShape {
 public:
  virtual ~RigidShape() = default;
  /// @param place  in the shape's frame, finite.
  virtual Proximity proximity(const Eigen::Vector3d& place) const noexcept = 0;
  /// The point of a triangle that lies deepest in the shape, in barycentric coordinates.
  /// @param corners  in columns, in the shape's frame, finite.
  virtual Eigen::Vector3d deepest(const Eigen::Matrix3d& corners) const noexcept = 0;
  /// Radius of a ball around the frame's origin that holds the shape, m; infinite for a half space.
  virtual double reach() const noexcept = 0;
  /// Of what sticks out of the shape, m; 0 for edges. Finer meshes than this meet it with their
  /// vertices.
  virtual double smallestRadius() const noexcept = 0;
  /// Points in the shape's frame such that it holds all within coreRadius() of each, and not much
  /// else: a ball's centre, points of a capsule's axis, vertices of a mesh; none of a half space.
  virtual int coreCount() const noexcept { return 0; }
  virtual Eigen::Vector3d core(int) const noexcept { return Eigen::Vector3d::Zero(); }
  virtual double coreRadius() const noexcept { return 0; }  ///< m
  /// Whether it is made of flat facets: then its normal jumps from place to place, and what lies
  /// deepest in it is searched for.
  virtual bool isFaceted() const noexcept { return false; }
  /// The normal of the smooth surface that facets stand for, unit, in the shape's frame.
  /// @param near  of this shape.
  virtual Eigen::Vector3d smoothNormal(const Proximity& near) const noexcept { return near.normal; }
};

/// A ball around the origin.
class SphereShape final : public RigidShape {
 public:
  /// @throws std::invalid_argument for a radius that is not positive.
  explicit SphereShape(double radius);
  Proximity proximity(const Eigen::Vector3d& place) const noexcept override;
  Eigen::Vector3d deepest(const Eigen::Matrix3d& corners) const noexcept override;
  double reach() const noexcept override { return radius_; }
  double smallestRadius() const noexcept override { return radius_; }
  int coreCount() const noexcept override { return 1; }
  double coreRadius() const noexcept override { return radius_; }

 private:
  double radius_;
};

/// All within a radius of a segment.
class CapsuleShape final : public RigidShape {
 public:
  /// @param from, to  the segment's ends, m; may coincide.
  /// @throws std::invalid_argument for a radius that is not positive or ends that are not finite.
  CapsuleShape(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
  Proximity proximity(const Eigen::Vector3d& place) const noexcept override;
  Eigen::Vector3d deepest(const Eigen::Matrix3d& corners) const noexcept override;
  double reach() const noexcept override;
  double smallestRadius() const noexcept override { return radius_; }
  int coreCount() const noexcept override { return kCorePoints; }
  Eigen::Vector3d core(int k) const noexcept override {
    return from_ + double(k) / (kCorePoints - 1) * axis_;
  }
  double coreRadius() const noexcept override { return radius_; }

 private:
  static constexpr int kCorePoints = 9;
  Eigen::Vector3d from_, axis_;
  double radius_;
};

/// The half space below z = 0.
class PlaneShape final : public RigidShape {
 public:
  Proximity proximity(const Eigen::Vector3d& place) const noexcept override {
    return {place.z(), Eigen::Vector3d::UnitZ()};
  }
  Eigen::Vector3d deepest(const Eigen::Matrix3d& corners) const noexcept override;
  double reach() const noexcept override { return std::numeric_limits<double>::infinity(); }
  double smallestRadius() const noexcept override {
    return std::numeric_limits<double>::infinity();
  }
};

}  // namespace palpate
