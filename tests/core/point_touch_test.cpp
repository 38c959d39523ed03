// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/point_touch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>

#include "contact/point_contact.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

ToolPose at(const Eigen::Vector3d& place, bool adheres = false) {
  ToolPose pose;
  pose.position = place;
  pose.buttons = adheres ? PointTouch::kAdheres : 0;
  return pose;
}

class PointTouchOfASphere : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    body_ = new TouchedBody(touchedSphere(2, true));
    stiffness_ = maskedStiffness(*body_, 2);
  }
  static void TearDownTestSuite() {
    stiffness_.reset();
    delete body_;
  }
  /// Steps all tools from one set of places to another, and returns the last wrenches.
  static std::vector<Wrench> move(PointTouch& touch, const std::vector<Eigen::Vector3d>& from,
                                  const std::vector<Eigen::Vector3d>& to, int ticks = 100) {
    std::vector<Wrench> wrenches(from.size());
    std::vector<ToolPose> poses(from.size());
    for (int t = 0; t <= ticks; ++t) {
      for (std::size_t i = 0; i < from.size(); ++i)
        poses[i] = at(from[i] + double(t) / ticks * (to[i] - from[i]));
      touch.step(poses.data(), wrenches.data());
    }
    return wrenches;
  }
  static TouchedBody* body_;
  static std::shared_ptr<const SurfaceStiffness> stiffness_;
};
TouchedBody* PointTouchOfASphere::body_ = nullptr;
std::shared_ptr<const SurfaceStiffness> PointTouchOfASphere::stiffness_;

TEST_F(PointTouchOfASphere, PushesBackOnAToolThatTouchesAloneBitForBitAsItsContactDoes) {
  const Eigen::Vector3d above(0, 0, 1.1), below(0.02, 0.01, 0.9), away(0.3, 0, 1.2);
  PointTouch one(stiffness_, 1, 0.3), both(stiffness_, 2, 0.3);
  SlidingContact contact(stiffness_, std::make_shared<TouchedSurface>(body_->mesh));
  contact.setFriction(0.3);
  for (int t = 0; t <= 300; ++t) {
    const Eigen::Vector3d place =
        above + std::sin(0.02 * t) * (below - above) + Eigen::Vector3d(0.002 * t, 0, 0);
    const ToolPose poses[2] = {at(place, t % 90 > 70), at(away)};
    Wrench alone, wrenches[2];
    contact.setAdhesion(t % 90 > 70);
    contact.advance(place);
    one.step(poses, &alone);
    const ContactCertificate certificate = both.step(poses, wrenches);
    EXPECT_EQ(alone.force, -contact.force());
    EXPECT_EQ(wrenches[0].force, alone.force) << "tick " << t;
    EXPECT_EQ(wrenches[1].force, Eigen::Vector3d::Zero());
    EXPECT_EQ(wrenches[0].torque, Eigen::Vector3d::Zero());
    EXPECT_EQ(certificate.residual, 0);
    EXPECT_EQ(certificate.iterations, contact.slideCount());
  }
}

TEST_F(PointTouchOfASphere, ItsSnapshotDeformsTheBodyAsTheContactsDo) {
  PointTouch touch(stiffness_, 2, 0.3);
  // Near each other, so that their masks share nodes.
  const std::vector<Wrench> wrenches =
      move(touch, {{0, 0, 1.1}, {0.2, 0, 1.1}}, {{0, 0, 0.9}, {0.18, 0.02, 0.87}});
  ContactSnapshot snapshot = touch.makeSnapshot();
  touch.fill(snapshot);
  const int n = body_->mesh->vertexCount();
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, n), sum = given, displacement, traction;
  std::map<int, int> listed;
  for (int i = 0; i < snapshot.loadedCount; ++i) {
    const int node = snapshot.loadedNodes[i];
    EXPECT_EQ(listed[node]++, 0) << "node " << node;
    given.col(node) = snapshot.loads[i] / body_->mesh->vertexAreas()[node];
  }
  for (int tool = 0; tool < 2; ++tool) {
    const ToolContact& contact = snapshot.tools[tool];
    EXPECT_TRUE(contact.touching);
    EXPECT_EQ(contact.wrench.force, wrenches[tool].force);
    EXPECT_EQ(contact.hapticPoint, contact.pose.position);
    const SurfacePoint point{contact.triangle, contact.barycentric};
    EXPECT_EQ(placeOf(*body_->mesh, point), contact.staticPoint);
    PointContact(stiffness_, point).deform(-contact.wrench.force, displacement, traction);
    sum += traction;
  }
  for (int v : body_->greens->info().conditions.fixedNodes()) sum.col(v).setZero();  // reactions
  EXPECT_LE((given - sum).norm(), 1e-14 * sum.norm());
  EXPECT_EQ(snapshot.certificate.contactCount, 2);

  move(touch, {{0, 0, 0.9}, {0.18, 0.02, 0.87}}, {{0, 0, 1.1}, {0.2, 0, 1.1}});
  touch.fill(snapshot);
  EXPECT_EQ(snapshot.loadedCount, 0);
  EXPECT_FALSE(snapshot.tools[0].touching);
}

TEST_F(PointTouchOfASphere, PullsWithItsButton) {
  PointTouch touch(stiffness_, 1, 0.3);
  move(touch, {{0, 0, 1.1}}, {{0, 0, 0.95}});
  Wrench wrench;
  for (int t = 0; t <= 100; ++t) {
    const ToolPose pose = at({0, 0, 0.95 + 0.0015 * t}, true);
    touch.step(&pose, &wrench);
  }
  EXPECT_LT(wrench.force.z(), 0) << "the surface draws the tool back";
}

TEST_F(PointTouchOfASphere, ChangesFrictionAndStiffnessBetweenTicks) {
  PointTouch touch(stiffness_, 1, 1);
  const Eigen::Vector3d down(0, 0, 0.9), aside(0.05, 0, 0.9);
  move(touch, {{0, 0, 1.1}}, {down});
  const Eigen::Vector3d stuck = move(touch, {down}, {aside})[0].force;
  touch.setFriction(0);
  const Eigen::Vector3d slid = move(touch, {aside}, {aside}, 2000)[0].force;
  const auto across = [&](const Eigen::Vector3d& force) {
    return force.cross(touch.contact(0).normal()).norm() / force.norm();
  };
  EXPECT_GT(across(stuck), 0.1);
  EXPECT_LE(across(slid), 1e-5);
  for (const auto& next : {maskedStiffness(*body_, 3), stiffness_->withRigidStiffness(0.3),
                           stiffness_->withYoungsModulus(10)}) {
    touch.setStiffness(next);
    EXPECT_EQ(touch.stiffness(), next);
    move(touch, {aside}, {aside}, 2000);
    EXPECT_EQ(&touch.contact(0).stiffness(), next.get());
  }
  touch.setStiffness(stiffness_);
  const Eigen::Vector3d home = move(touch, {aside}, {aside}, 2000)[0].force;
  // Where the contact slid meanwhile it comes back from, to what is settled.
  EXPECT_LE((home - slid).norm(), 1e-4 * slid.norm());
}

TEST_F(PointTouchOfASphere, KeepsStiffnessesAsLongAsTheyAreInUseAndNoLonger) {
  PointTouch touch(stiffness_, 2, 0.5);
  const ToolPose poses[2] = {at({0, 0, 2}), at({0, 0, 2})};
  Wrench wrenches[2];
  std::vector<std::weak_ptr<const SurfaceStiffness>> made;
  for (int version = 0; version < 6; ++version) {
    const auto next = stiffness_->withYoungsModulus(1 + version);
    made.push_back(next);
    touch.setStiffness(next);
    for (int tick = 0; tick < 3 * SlidingContact::kBlendTicks; ++tick) touch.step(poses, wrenches);
  }
  EXPECT_TRUE(made[0].expired());
  EXPECT_TRUE(made[2].expired());
  EXPECT_FALSE(made[4].expired()) << "the contacts still know it";
  EXPECT_FALSE(made[5].expired());
}

TEST_F(PointTouchOfASphere, TakesChangesFromAnotherThread) {
  PointTouch touch(stiffness_, 1, 0.5);
  std::atomic<bool> done{false};
  std::thread other([&] {
    for (int i = 0; i < 200; ++i) {
      touch.setStiffness(stiffness_->withYoungsModulus(1 + i % 5));
      touch.setFriction(0.1 * (i % 10));
    }
    done = true;
  });
  Wrench wrench;
  double largest = 0;
  for (int tick = 0; !done || tick < 2000; ++tick) {
    const ToolPose pose = at({0.3 * std::sin(0.01 * tick), 0, 0.95});
    const ToolPose outside = at({0, 0, 1.1});
    touch.step(tick == 0 ? &outside : &pose, &wrench);
    largest = std::max(largest, wrench.force.norm());
  }
  other.join();
  EXPECT_GT(largest, 0);
  EXPECT_TRUE(std::isfinite(largest));
}

TEST_F(PointTouchOfASphere, TellsWhenThereIsNoForceToServe) {
  // Columns of half the nodes: stiffnesses elsewhere cannot be made.
  GreensFunctionsInfo info = body_->greens->info();
  info.columnNodes.clear();
  for (int v = 0; v < body_->mesh->vertexCount(); ++v)
    if (body_->mesh->points()(2, v) > 0) info.columnNodes.push_back(v);
  const auto half = std::make_shared<SurfaceStiffness>(
      denseGreens(info, denseMatrix(*body_->greens)), body_->mesh, MaskShape::Linear, 0.3);
  PointTouch touch(half, 1, 0.5);
  Wrench wrench;
  const ToolPose outside = at({1.2, 0, -0.4}), inside = at({0.8, 0, -0.4});
  EXPECT_FALSE(touch.step(&outside, &wrench).failed);
  const ContactCertificate certificate = touch.step(&inside, &wrench);
  EXPECT_TRUE(certificate.failed && certificate.uncomputed);
  EXPECT_EQ(wrench.force, Eigen::Vector3d::Zero());
}

TEST_F(PointTouchOfASphere, ForgetsEverythingAtAReset) {
  PointTouch touch(stiffness_, 1, 0.5);
  move(touch, {{0, 0, 1.1}}, {{0, 0, 0.9}});
  touch.reset();
  ContactSnapshot snapshot = touch.makeSnapshot();
  touch.fill(snapshot);
  EXPECT_FALSE(snapshot.tools[0].touching);
  EXPECT_EQ(snapshot.loadedCount, 0);
  // Inside, it begins from nothing, which is told.
  ToolPose pose;
  pose.position = {0, 0, 0.9};
  Wrench wrench;
  EXPECT_TRUE(touch.step(&pose, &wrench).startedInside);
  EXPECT_LE(
      wrench.force.norm(),
      stiffness_->hapticAt(touch.contact(0).point().triangle, touch.contact(0).point().barycentric)
              .operatorNorm() *
          touch.contact(0).relaxation() * 1.001);
  EXPECT_FALSE(touch.step(&pose, &wrench).startedInside);
}

TEST_F(PointTouchOfASphere, APointThatIsNotThereTouchesNothing) {
  for (const int count : {1, 2}) {
    PointTouch touch(stiffness_, count, 0.5);
    std::vector<ToolPose> poses(2);
    poses[0].position = {0, 0, 0.9};
    poses[0].isThere = false;
    Wrench wrenches[2];
    for (int tick = 0; tick < 30; ++tick) {
      poses[1].position = {0.3, 0, 1.1 - 0.01 * tick};
      EXPECT_FALSE(touch.step(poses.data(), wrenches).startedInside);
      EXPECT_EQ(wrenches[0].force, Eigen::Vector3d::Zero());
    }
    if (count == 2) {
      EXPECT_GT(wrenches[1].force.norm(), 0);
    }
  }
}

TEST_F(PointTouchOfASphere, ATickWithItsSnapshotAllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  PointTouch touch(stiffness_, 2, 0.4);
  ContactSnapshot snapshot = touch.makeSnapshot();
  const auto other = maskedStiffness(*body_, 3);
  std::vector<ToolPose> poses(2);
  Wrench wrenches[2];
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick == 300) touch.setStiffness(other);
    if (tick == 600) touch.setStiffness(stiffness_);
    for (int i = 0; i < 2; ++i)
      poses[i] = at({0.4 * std::sin(0.005 * tick + i), 0.1 * i, 1.1 - 0.3 * std::sin(0.02 * tick)},
                    tick % 300 > 250);
    const long before = allocationCount();
    touch.step(poses.data(), wrenches);
    touch.fill(snapshot);
    EXPECT_EQ(allocationCount(), before);
  }
}

TEST_F(PointTouchOfASphere, WhatMakesNoSenseIsRefused) {
  EXPECT_TRUE(
      isRefused([&] { PointTouch(stiffness_, 0, 0.5); }, "there must be at least 1 tool, not 0"));
  PointTouch touch(stiffness_, 1, 0.5);
  for (double mu : {-0.1, double(NAN), double(INFINITY)})
    EXPECT_TRUE(isRefused([&] { touch.setFriction(mu); },
                          "the coefficient of friction must be at least 0 and finite, not "));
  const TouchedBody body = touchedSphere(1, true);
  EXPECT_TRUE(isRefused(
      [&] {
        touch.setStiffness(
            std::make_shared<SurfaceStiffness>(body.greens, body.mesh, MaskShape::Linear, 0));
      },
      "the stiffness is that of another mesh than the one being touched"));
}

}  // namespace
}  // namespace palpate::test
