// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/unilateral_contact.h"
#include "support/contact_bodies.h"
#include "support/obstacles.h"

// Balls on slivers: round vertices of high valence, and across ridges of long triangles.

namespace palpate::test {
namespace {

/// A surface of revolution round the z axis.
/// @param around   vertices of a ring.
/// @param profile  radius and height of each ring, from the top down; the first and last are points
///                 on the axis.
Shape revolved(int around, const std::vector<Eigen::Vector2d>& profile) {
  std::vector<Eigen::Vector3d> points{{0, 0, profile.front().y()}};
  std::vector<Eigen::Vector3i> triangles;
  const int last = static_cast<int>(profile.size()) - 2;
  for (int ring = 1; ring <= last; ++ring)
    for (int i = 0; i < around; ++i) {
      const double turn = 2 * M_PI * i / around, radius = profile[ring].x();
      points.push_back({radius * std::cos(turn), radius * std::sin(turn), profile[ring].y()});
    }
  const int bottom = static_cast<int>(points.size());
  points.push_back({0, 0, profile.back().y()});
  const auto on = [around](int ring, int i) { return 1 + (ring - 1) * around + i % around; };
  for (int i = 0; i < around; ++i) {
    triangles.push_back({0, on(1, i), on(1, i + 1)});
    triangles.push_back({bottom, on(last, i + 1), on(last, i)});
    for (int ring = 1; ring < last; ++ring) {
      triangles.push_back({on(ring, i), on(ring + 1, i), on(ring + 1, i + 1)});
      triangles.push_back({on(ring, i), on(ring + 1, i + 1), on(ring, i + 1)});
    }
  }
  return fromLists(points, triangles);
}

constexpr double kSupport = 2.22;  ///< polar angle of the rim of the fixed cap

TouchedBody heldBelow(const Shape& shape) {
  return touchedBody(
      shape, fixedWhere(shape, [](const auto& x) { return x.z() < std::cos(kSupport) + 1e-9; }),
      true);
}

/// A unit sphere with poles of that valence.
TouchedBody fan(int valence) {
  std::vector<Eigen::Vector2d> profile{{0, 1}};
  for (double angle : {0.03, 0.15, 0.27, 0.39, 0.51, 0.63, 0.9, 1.3, 1.7, kSupport, 2.7})
    profile.push_back({std::sin(angle), std::cos(angle)});
  profile.push_back({0, -1});
  return heldBelow(revolved(valence, profile));
}

/// Points inside slivers are many, and near each other: what a ball feels is the body, and not
/// they.
TEST(UnilateralContactSlivers, ABallOverAVertexOfValenceSixtyFeelsWhatItFeelsOnAGoodMesh) {
  const TouchedBody slivers = fan(60);
  const TouchedBody good = heldBelow(ringedSphere(
      [](double angle) { return 0.06 + 0.2 * std::max(0.0, angle - 0.5); }, {kSupport}));
  UnilateralContactSettings settings;
  constexpr double radius = 0.27, depth = 0.15, step = 1.5e-3;
  for (double friction : {0.0, 0.3, 0.7}) {
    UnilateralContact contact(slivers.greens, slivers.mesh, ball(radius, friction, 0), settings);
    UnilateralContact reference(good.greens, good.mesh, ball(radius, friction, 0), settings);
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    double stiffness = 0;
    int inARow = 0;
    for (int tick = 0; tick < 300; ++tick) {
      const double angle = -0.2 + step * std::max(0, tick - 100);
      const double height = 1 + radius - depth * std::min(1.0, 0.01 * tick);
      const RigidPose pose = at(height * std::sin(angle), 0.01, height * std::cos(angle));
      const ContactCertificate certificate = contact.step(&pose);
      reference.step(&pose);
      inARow = certificate.budgetCut && certificate.residual > 1e-3 ? inARow + 1 : 0;
      EXPECT_LT(inARow, 10) << friction << ' ' << tick;  // 20 are a fault to ForceSafety
      const Eigen::Vector3d force = contact.force(0), wanted = reference.force(0);
      if (tick <= 100)
        stiffness = std::max(stiffness, (force - before).norm() / (0.01 * depth));
      else
        EXPECT_LE((force - before).norm(), stiffness * step * height) << friction << ' ' << tick;
      if (tick >= 60) {
        // Its rings' edges are twice as long as the good mesh's, two thirds of the contact's
        // radius.
        EXPECT_LE((force - wanted).norm(), 0.17 * wanted.norm()) << friction << ' ' << tick;
      }
      before = force;
    }
  }
}

/// The largest jump of a small ball's force in a step, without friction, as it passes a ridge of
/// long triangles: a lens with edges of five radii.
/// @param stiffness  of its way in, before.
double jumpOverRidge(const TouchedBody& lens, double step, double& stiffness) {
  constexpr double radius = 0.2, depth = radius / 4;
  UnilateralContact contact(lens.greens, lens.mesh, ball(radius, 0, 0), {});
  const auto over = [](double x) {  // the rings' heights between
    const double from = x < 2 ? 1 : 2, share = x - from;
    const auto height = [](double r) { return r < 3 ? 3 * std::sqrt(1 - r * r / 9.06) : 0.0; };
    const double z = (1 - share) * height(from) + share * height(from + 1);
    const Eigen::Vector3d way = Eigen::Vector3d(x, 0, std::sqrt(9.06 - x * x)).normalized();
    return (Eigen::Vector3d(x, 0.03, z) + (radius - depth) * way).eval();
  };
  const auto pressed = [&](const Eigen::Vector3d& place) {
    RigidPose pose;
    pose.position = place;
    contact.step(&pose);
    return contact.force(0);
  };
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  stiffness = 0;
  for (int tick = 0; tick <= 100; ++tick) {
    const Eigen::Vector3d in = (1 - 0.01 * tick) * depth * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d force = pressed(over(1.6) + in);
    stiffness = std::max(stiffness, (force - before).norm() / (0.01 * depth));
    before = force;
  }
  double largest = 0;
  for (double x = 1.6; x < 2.4; x += step) {
    const Eigen::Vector3d force = pressed(over(x));
    EXPECT_GT(force.z(), 0) << x;
    largest = std::max(largest, (force - before).norm());
    before = force;
  }
  return largest;
}

TEST(UnilateralContactSlivers, ASmallBallPassesARidgeOfLongTrianglesWithoutAJump) {
  std::vector<Eigen::Vector2d> profile{{0, 3}};
  for (double radius : {0.2, 1.0, 2.0})
    profile.push_back({radius, 3 * std::sqrt(1 - radius * radius / 9.06)});
  profile.insert(profile.end(), {{3, 0}, {3, -1}, {0, -1}});
  const Shape shape = revolved(12, profile);
  const TouchedBody lens =
      touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() < -0.9; }), true);
  for (double step : {5e-3, 1e-3, 2e-4}) {
    double stiffness = 0;
    const double jump = jumpOverRidge(lens, step, stiffness);
    // The way is a third longer where the ball turns about the ridge, which yields sideways.
    EXPECT_LE(jump, 1.5 * stiffness * step) << step;
    EXPECT_GT(jump, 0) << step;
  }
}

}  // namespace
}  // namespace palpate::test
