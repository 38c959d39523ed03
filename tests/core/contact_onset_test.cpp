// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Balls from a tenth of an edge to ten: when they are first felt, and how their force goes on. They
// have a tool's number, as those of scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "contact/unilateral_contact.h"
#include "support/contact_bodies.h"
#include "support/obstacles.h"

namespace palpate::test {
namespace {

constexpr int kSquares = 6;
constexpr double kEdge = 1.0 / kSquares;

/// A cube held below, its top face of squares cut in two: triangles' longest edges are 1.4 kEdge.
const TouchedBody& cube() {
  static const TouchedBody body = [] {
    const Shape shape = box({1, 1, 1}, {kSquares, kSquares, kSquares});
    return touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() == 0; }), true);
  }();
  return body;
}

/// How deep a ball comes at a place of the top face, in steps of a thousandth, until it is felt.
double onset(double radius, double x, double y) {
  UnilateralContact contact(cube().greens, cube().mesh, ball(radius, 0, 0), {});
  const double step = 1e-3 * std::min(radius, kEdge);
  for (int tick = -100;; ++tick) {
    const RigidPose pose = at(x, y, 1 + radius - step * tick);
    contact.step(&pose);
    if (contact.force(0).norm() > 0 || step * tick > radius) return step * tick;
  }
}

TEST(ContactOnset, BallsOfAnySizeAreFeltWhereTheyMeetTheFace) {
  for (double edges : {0.1, 0.2, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0}) {
    const double radius = edges * kEdge;
    double deepest = 0;
    for (int i = 0; i <= 4; ++i)  // over a square and its neighbours' rims
      for (int j = 0; j <= 4; ++j)
        deepest = std::max(deepest, onset(radius, (2 + 0.25 * i) * kEdge, (2 + 0.25 * j) * kEdge));
    EXPECT_LE(deepest, 0.02 * radius) << edges;
    RecordProperty("sunk in, of the radius, " + std::to_string(edges) + " edges",
                   std::to_string(deepest / radius));
  }
}

RigidPose above(double radius, double depth, double x, double y) {
  return at(x, y, 1 + radius - depth);
}

/// Over corners, edges and faces, at a pace that is fast: an edge of 1 cm in .1 s.
TEST(ContactOnset, TheForceHasNoJumpsWhileABallSlides) {
  constexpr double step = 1e-2 * kEdge;
  for (double edges : {0.5, 1.0, 1.5, 2.0, 3.0, 5.0})
    for (double friction : {0.0, 0.3, 0.8})
      for (double share : {0.05, 0.2}) {
        const std::string what = std::to_string(edges) + " edges, friction " +
                                 std::to_string(friction) + ", depth " + std::to_string(share);
        const double radius = edges * kEdge, depth = share * std::min(radius, kEdge);
        UnilateralContact contact(cube().greens, cube().mesh, ball(radius, friction, 0), {});
        double stiffness = 0, largest = 0;
        Eigen::Vector3d last = Eigen::Vector3d::Zero();
        for (int tick = 0; tick <= 100; ++tick) {
          const RigidPose pose = above(radius, depth * tick / 100, 0.31, 0.37);
          contact.step(&pose);
          stiffness = std::max(stiffness, (contact.force(0) - last).norm() / (depth / 100));
          last = contact.force(0);
        }
        for (int tick = 1; tick < 240; ++tick) {
          const RigidPose pose =
              above(radius, depth, 0.31 + 0.96 * step * tick, 0.37 + 0.28 * step * tick);
          EXPECT_FALSE(contact.step(&pose).budgetCut) << what;
          EXPECT_GT(contact.force(0).z(), 0) << what;
          largest = std::max(largest, (contact.force(0) - last).norm());
          last = contact.force(0);
        }
        // As if all of the way were straight in, where the ball came down.
        EXPECT_LE(largest, stiffness * step) << what;
      }
}

/// Much smaller than what it slides over, a ball goes from one triangle to the next within a step:
/// the same whether it is a tool of one part or none.
TEST(ContactOnset, ATinyBallCrossesEdgesWithoutAJump) {
  constexpr double radius = 0.02 * kEdge, depth = 0.05 * radius, step = 0.002 * kEdge;
  for (const int tool : {-1, 0}) {
    double largest = 0;
    for (int run = 0; run < 6; ++run) {
      const double angle = 1.1 * run, x = 0.5 - 0.02 * run, y = 0.47 + 0.01 * run;
      UnilateralContact contact(cube().greens, cube().mesh, ball(radius, 0, tool), {});
      double stiffness = 0;
      Eigen::Vector3d last = Eigen::Vector3d::Zero();
      for (int tick = -100; tick < 400; ++tick) {
        const double in = std::min(0, tick) / 100., along = step * std::max(0, tick);
        const RigidPose pose = above(radius, depth * (1 + in), x + std::cos(angle) * along,
                                     y + std::sin(angle) * along);
        contact.step(&pose);
        const double change = (contact.force(0) - last).norm();
        if (tick <= 0)
          stiffness = std::max(stiffness, change / (depth / 100));
        else
          largest = std::max(largest, change / (stiffness * step));
        last = contact.force(0);
        EXPECT_TRUE(tick < 0 || last.z() > 0) << tool << ' ' << run << ' ' << tick;
      }
    }
    EXPECT_LE(largest, 0.05) << tool;
    RecordProperty("largest change, tool " + std::to_string(tool), std::to_string(largest));
  }
}

/// Nobody holds still: 10 um of noise on edges of 1 cm.
TEST(ContactOnset, NoiseMakesNoContactChatter) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1e-3 * kEdge, 1e-3 * kEdge);
  for (double edges : {1.0, 1.5, 2.0, 3.0})
    for (double friction : {0.0, 0.3})
      for (int place = 0; place < 8; ++place) {
        const double radius = edges * kEdge, depth = (place % 2 ? 0.05 : 0.2) * kEdge;
        const double x = 0.34 + 0.013 * place, y = 0.36 + 0.011 * place;
        UnilateralContact contact(cube().greens, cube().mesh, ball(radius, friction, 0), {});
        for (int tick = 0; tick < 40; ++tick) {
          const RigidPose pose = above(radius, depth, x, y);
          contact.step(&pose);
        }
        const long before = contact.transitions();
        for (int tick = 0; tick < 20; ++tick) {
          const RigidPose pose =
              above(radius, depth + noise(random), x + noise(random), y + noise(random));
          contact.step(&pose);
        }
        EXPECT_LE(contact.transitions() - before, 2) << edges << ' ' << friction << ' ' << place;
      }
}

/// Without friction the work of a closed path is given back.
TEST(ContactOnset, NoWorkIsLeftOverAfterAClosedPath) {
  for (double edges : {0.7, 1.0, 2.0, 4.0})
    for (int sense : {-1, 1}) {
      const double radius = edges * kEdge;
      UnilateralContact contact(cube().greens, cube().mesh, ball(radius, 0, 0), still(300));
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), before = force;
      double work = 0, most = 0;
      constexpr int steps = 800;
      for (int tick = 0; tick <= steps; ++tick) {
        const double turn = 2 * M_PI * tick / steps;
        const RigidPose pose =
            above(radius, 0.2 * kEdge * (1 - std::cos(turn)) / 2,
                  0.5 + 1.1 * kEdge * std::cos(turn), 0.5 + 1.3 * sense * kEdge * std::sin(turn));
        contact.step(&pose);
        if (tick > 0) work -= (contact.force(0) + force).dot(pose.position - before) / 2;
        force = contact.force(0);
        before = pose.position;
        most = std::max(most, work);
      }
      EXPECT_LE(std::abs(work), 0.01 * most) << edges;
    }
}

}  // namespace
}  // namespace palpate::test
