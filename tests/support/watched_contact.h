// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "contact/sliding_contact.h"

namespace palpate::test {

/// A sliding contact whose every tick is held to what its header promises: the bound on the jump of
/// force, and the balance of energy. (f_0 + f_1) / 2 . dx^H is the work of a tick.
class WatchedContact {
 public:
  WatchedContact(std::shared_ptr<const SurfaceStiffness> stiffness, double friction)
      : contact(stiffness, std::make_shared<const TouchedSurface>(stiffness->sharedMesh())) {
    contact.setFriction(friction);
  }

  void advance(const Eigen::Vector3d& place) {
    const bool touched = contact.isTouching();
    const Eigen::Vector3d force = contact.force(), staticPoint = contact.staticPoint();
    const Eigen::Matrix3d stiffness = contact.servedStiffness();
    const bool changes = contact.isChanging();
    contact.advance(place);
    const double step = ticks_ ? (place - place_).norm() : 0;
    jump = (contact.force() - force).norm();
    // A contact that begins has the stiffness of where it entered, which is not to be seen here.
    const double norm = touched ? stiffness.operatorNorm() : largestNorm();
    double allowed = SlidingContact::kContinuity * norm * (step + contact.relaxation());
    if (changes) allowed += 1e300;  // those ticks have a test of their own
    // Eigenvalues in closed form are exact to the root of rounding where they nearly coincide.
    EXPECT_LE(jump, allowed * (1 + 1e-7)) << "tick " << ticks_;
    EXPECT_GE(contact.point().barycentric.minCoeff(), 0);
    EXPECT_NEAR(contact.point().barycentric.sum(), 1, 1e-12);
    largestRatio = std::max(largestRatio, jump / allowed);

    const Eigen::Vector3d meanForce = (force + contact.force()) / 2;
    if (ticks_) work += meanForce.dot(place - place_);
    if (touched && contact.isTouching()) {
      const Eigen::Vector3d moved = contact.staticPoint() - staticPoint;
      const Eigen::Vector3d u0 = place_ - staticPoint, u1 = place - contact.staticPoint();
      byStiffness += std::abs(u0.dot((contact.servedStiffness() - stiffness) * u1)) / 2;
      byNormals += std::max(0., -meanForce.dot(moved));
      slid += moved.norm();
    }
    place_ = place;
    ++ticks_;
  }
  /// Straight on to a place, in steps of at most this length.
  template <class Visit>
  void moveTo(const Eigen::Vector3d& place, double step, const Visit& visit) {
    const Eigen::Vector3d from = place_;
    const int count = std::max(1, int(std::ceil((place - from).norm() / step)));
    for (int i = 1; i <= count; ++i) {
      advance(from + double(i) / count * (place - from));
      visit();
    }
  }
  void moveTo(const Eigen::Vector3d& place, double step) {
    moveTo(place, step, [] {});
  }
  double pressing() const { return -contact.normal().dot(contact.force()); }
  double across() const { return (contact.force() + pressing() * contact.normal()).norm(); }
  const Eigen::Vector3d& place() const { return place_; }

  SlidingContact contact;
  double jump = 0;                        ///< of force in the last tick
  double largestRatio = 0;                ///< of a jump to what was allowed
  double work = 0;                        ///< of the hand on the body so far
  double byStiffness = 0, byNormals = 0;  ///< the two parts of what a path may give back
  double slid = 0;                        ///< length of x^C's way

 private:
  double largestNorm() {
    if (largestNorm_ == 0)
      for (int v = 0; v < contact.stiffness().mesh().vertexCount(); ++v)
        largestNorm_ = std::max(largestNorm_, contact.stiffness().haptic(v).operatorNorm());
    return largestNorm_;
  }

  double largestNorm_ = 0;  ///< of K^H over the surface: no place between vertices has more
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();
  int ticks_ = 0;
};

}  // namespace palpate::test
