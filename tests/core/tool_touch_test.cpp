// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/tool_touch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/snapshot_deformation.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

std::shared_ptr<const TouchTool> ballTool(double radius) {
  return std::make_shared<RigidTouchTool>(std::make_shared<SphereShape>(radius));
}

/// Two balls side by side.
class Pair final : public TouchTool {
 public:
  int partCount() const noexcept override { return 2; }
  std::shared_ptr<const RigidShape> shape(int) const override {
    return std::make_shared<SphereShape>(0.2);
  }
  void place(const ToolPose& pose, RigidPose* poses) const noexcept override {
    for (int part = 0; part < 2; ++part)
      poses[part] = {pose.position + pose.orientation * Eigen::Vector3d(part ? 0.3 : -0.3, 0, 0),
                     pose.orientation};
  }
};

ToolPose at(double x, double y, double z) {
  ToolPose pose;
  pose.position = {x, y, z};
  return pose;
}

TEST(ToolTouch, SnapshotsDeformTheSurfaceThatBearsTheForces) {
  const TouchedBody body = touchedSphere(3, true);
  ToolTouch touch(body.greens, body.mesh, {ballTool(0.3)}, 0.3);
  const ToolPose pose = at(0.05, 0, 1.27);
  Wrench wrench;
  for (int tick = 0; tick < 10; ++tick) touch.step(&pose, &wrench);
  ContactSnapshot snapshot = touch.makeSnapshot();
  touch.fill(snapshot);
  EXPECT_TRUE(snapshot.tools[0].touching);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < snapshot.loadedCount; ++i) sum += snapshot.loads[i];
  EXPECT_LE((sum + wrench.force).norm(), 1e-12);
  EXPECT_LE((snapshot.tools[0].wrench.force - wrench.force).norm(), 1e-12);
  EXPECT_LE((snapshot.tools[0].wrench.torque - wrench.torque).norm(), 1e-12);

  SnapshotDeformation deformation(body.greens);
  deformation.computeAll(snapshot);
  const Eigen::Matrix3Xd all = deformation.displacement();
  for (int v = 0; v < body.mesh->vertexCount(); ++v) {
    if (body.greens->isFixed(v)) {
      EXPECT_TRUE(all.col(v).isZero(0));
      continue;
    }
    const Eigen::Vector3d place = body.mesh->points().col(v) + all.col(v);
    EXPECT_GE((place - pose.position).norm(), 0.3 - 1e-6);  // gaps met to second order
  }
  SnapshotDeformation some(body.greens);
  const std::vector<int> loaded = some.loadedNodes(snapshot);
  ASSERT_FALSE(loaded.empty());
  some.computeAt(loaded, snapshot);
  for (int node : loaded) EXPECT_LE((some.displacement().col(node) - all.col(node)).norm(), 1e-12);
  EXPECT_THROW(some.computeAt({-1}, snapshot), std::invalid_argument);
}

TEST(ToolTouch, SnapshotsTellWhichPartPressesEachNode) {
  const TouchedBody body = touchedSphere(3, true);
  ToolTouch touch(body.greens, body.mesh, {ballTool(0.3), std::make_shared<Pair>()}, 0.3);
  const ToolPose poses[] = {at(-0.9, 0, 0.9), at(0.1, 0, 1.1)};
  Wrench wrenches[2];
  for (int tick = 0; tick < 10; ++tick) touch.step(poses, wrenches);
  ContactSnapshot snapshot = touch.makeSnapshot();
  touch.fill(snapshot);
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  for (int i = 0; i < snapshot.loadedCount; ++i) {
    ASSERT_TRUE(snapshot.loadedParts[i] >= 0 && snapshot.loadedParts[i] < 3);
    sums.col(snapshot.loadedParts[i]) += snapshot.loads[i];
  }
  const Wrench parts[] = {touch.partWrench(0, 0), touch.partWrench(1, 0), touch.partWrench(1, 1)};
  for (int part = 0; part < 3; ++part) {
    EXPECT_GT(parts[part].force.norm(), 0) << part;
    EXPECT_LE((sums.col(part) + parts[part].force).norm(), 1e-12) << part;
  }
}

TEST(ToolTouch, AStiffnessScaleChangesForcesAndNotShapes) {
  const TouchedBody body = touchedSphere(2, true);
  ToolTouch touch(body.greens, body.mesh, {ballTool(0.3)}, 0);
  const ToolPose pose = at(0, 0, 1.25);
  Wrench soft, stiff;
  for (int tick = 0; tick < 30; ++tick) touch.step(&pose, &soft);  // gaps settle
  ContactSnapshot snapshot = touch.makeSnapshot();
  touch.fill(snapshot);
  SnapshotDeformation first(body.greens), second(body.greens);
  first.computeAll(snapshot);
  touch.setStiffnessScale(4);
  touch.step(&pose, &stiff);
  touch.fill(snapshot);
  second.computeAll(snapshot, 4);
  EXPECT_LE((stiff.force - 4 * soft.force).norm(), 1e-6 * stiff.force.norm());
  EXPECT_LE((second.displacement() - first.displacement()).norm(),
            1e-6 * first.displacement().norm());
}

/// Of a ball that presses on the support, where only fixed vertices yield: as if made with another
/// stiffness, before the first step and while it presses.
TEST(ToolTouch, TheRigidStiffnessIsThatOfTheSupport) {
  const TouchedBody body = touchedSphere(2, true);  // fixed below -0.6
  const ToolPose pose = at(0, 0, -1.25);
  Wrench wrench;
  const auto pressed = [&](ToolTouch& touch) {
    for (int tick = 0; tick < 10; ++tick) EXPECT_FALSE(touch.step(&pose, &wrench).failed);
    return wrench.force.norm();
  };
  const auto touchOf = [&](double rigid) {
    UnilateralContactSettings settings;
    settings.rigidStiffness = rigid;
    return std::make_unique<ToolTouch>(body.greens, body.mesh, std::vector{ballTool(0.3)}, 0.3,
                                       settings);
  };
  const double soft = pressed(*touchOf(20)), hard = pressed(*touchOf(60));
  EXPECT_NEAR(hard, 3 * soft, 1e-6 * hard);
  const auto touch = touchOf(20);
  touch->setRigidStiffness(60);
  EXPECT_NEAR(pressed(*touch), hard, 1e-6 * hard);
  touch->setRigidStiffness(20);
  EXPECT_NEAR(pressed(*touch), soft, 1e-6 * soft);
  touch->setRigidStiffness(0);
  EXPECT_NEAR(pressed(*touch), pressed(*touchOf(0)), 1e-6 * pressed(*touchOf(0)));
  for (const double wrong : {-1., double(NAN), double(INFINITY)})
    EXPECT_TRUE(isRefused([&] { touch->setRigidStiffness(wrong); }, "rigid stiffness must be"));
}

TEST(ToolTouch, TheLastSettingHoldsHoweverManyThereWereSinceTheLastStep) {
  const TouchedBody body = touchedSphere(2, true);
  ToolTouch touch(body.greens, body.mesh, {ballTool(0.3)}, 0.3);
  const ToolPose pose = at(0.1, 0, 1.25);
  Wrench before, after;
  for (int tick = 0; tick < 10; ++tick) touch.step(&pose, &before);
  for (int i = 0; i < 1000; ++i) {
    touch.setStiffnessScale(1 + i);
    touch.setFriction(0.01 * i);
  }
  touch.setStiffnessScale(2);
  touch.setFriction(0.3);
  touch.step(&pose, &after);
  EXPECT_LE((after.force - 2 * before.force).norm(), 1e-6 * after.force.norm());
  for (const double bad : {-1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(touch.setFriction(bad), std::invalid_argument);
    EXPECT_THROW(touch.setStiffnessScale(bad), std::invalid_argument);
  }
}

TEST(ToolTouch, PartsOfAToolAddUpToItsWrench) {
  const TouchedBody body = touchedSphere(3, true);
  ToolTouch touch(body.greens, body.mesh, {std::make_shared<Pair>()}, 0.2);
  ToolPose pose = at(0.02, 0, 1.12);
  Wrench wrench;
  touch.step(&pose, &wrench);
  const Wrench left = touch.partWrench(0, 0), right = touch.partWrench(0, 1);
  EXPECT_GT(left.force.norm(), 0);
  EXPECT_GT(right.force.norm(), 0);
  EXPECT_LE((left.force + right.force - wrench.force).norm(), 1e-14);
  const Eigen::Vector3d arm(0.3, 0, 0);
  EXPECT_LE(
      (left.torque + right.torque + arm.cross(right.force) - arm.cross(left.force) - wrench.torque)
          .norm(),
      1e-14);
}

TEST(ToolTouch, APartnerBearsTheOppositeLoads) {
  const TouchedBody body = touchedSphere(2, true);
  RigidPose pose;
  pose.position = {0, 0, 1.97};
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()));
  ToolTouch touch(body.greens, body.mesh, {ballTool(0.1)}, 0, {},
                  {{body.greens, body.mesh, pose, 0.3}});
  const ToolPose away = at(5, 5, 5);
  Wrench wrench;
  for (int tick = 0; tick < 5; ++tick) touch.step(&away, &wrench);
  EXPECT_EQ(wrench.force.norm(), 0);
  ContactSnapshot snapshot = touch.makeSnapshot();
  touch.fill(snapshot);
  Eigen::Vector3d sums[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int i = 0; i < snapshot.loadedCount; ++i)
    sums[snapshot.loadedBodies[i]] += snapshot.loads[i];
  EXPECT_LT(sums[0].z(), 0);
  EXPECT_LE((sums[0] + sums[1]).norm(), 1e-14);
  // Both yield: the upper one, turned over, upwards.
  SnapshotDeformation lower(body.greens), upper(body.greens, 1, pose.orientation);
  lower.computeAll(snapshot);
  upper.computeAll(snapshot);
  int pole;
  body.mesh->points().row(2).maxCoeff(&pole);
  EXPECT_LT(lower.displacement()(2, pole), 0);
  EXPECT_GT(upper.displacement()(2, pole), 0);
}

/// A hand's worth of torque comes with the pull: the tool is turned about what it holds.
TEST(ToolTouch, ToolsThatHoldPullAndTwistWhileTheirButtonsArePressed) {
  const TouchedBody body = touchedSphere(3, true);
  for (const bool holds : {false, true}) {
    ToolTouch touch(body.greens, body.mesh, {ballTool(0.3), std::make_shared<Pair>()}, 0.3);
    touch.setHolds(holds);
    ToolPose poses[2] = {at(-0.9, 0, 0.9), at(0.1, 0, 1.1)};
    Wrench wrenches[2], before[2];
    for (int tick = 0; tick < 30; ++tick) touch.step(poses, before);
    poses[1].buttons = ToolTouch::kHolds;
    touch.step(poses, wrenches);
    // What is held moves as the nodes do; points inside triangles yielded by kSpread besides.
    EXPECT_LE((wrenches[1].force - before[1].force).norm(), 1e-3 * before[1].force.norm());
    poses[1].position += Eigen::Vector3d(0, 0, 0.2);
    poses[1].orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ())) * poses[1].orientation;
    touch.step(poses, wrenches);
    if (!holds) {
      EXPECT_EQ(wrenches[1].force, Eigen::Vector3d::Zero());
      continue;
    }
    EXPECT_LT(wrenches[1].force.z(), 0);
    EXPECT_LT(wrenches[1].torque.z(), 0) << "against the twist";
    EXPECT_GT(wrenches[0].force.norm(), 0) << "the other one presses still";
    ContactSnapshot snapshot = touch.makeSnapshot();
    touch.fill(snapshot);
    EXPECT_TRUE(snapshot.tools[1].touching);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < snapshot.loadedCount; ++i) sum += snapshot.loads[i];
    EXPECT_LE((sum + wrenches[0].force + wrenches[1].force).norm(), 1e-12);
    poses[1].buttons = 0;
    touch.step(poses, wrenches);
    EXPECT_EQ(wrenches[1].force, Eigen::Vector3d::Zero());
    EXPECT_EQ(wrenches[1].torque, Eigen::Vector3d::Zero());
  }
}

TEST(ToolTouch, TicksDoNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  const TouchedBody body = touchedSphere(2, true);
  UnilateralContactSettings settings;
  settings.solver.largestUpdates = 8;
  ToolTouch touch(body.greens, body.mesh, {ballTool(0.3), std::make_shared<Pair>()}, 0.3, settings);
  touch.setHolds(true);
  ContactSnapshot snapshot = touch.makeSnapshot();
  Wrench wrenches[2];
  const long before = allocationCount();
  for (int tick = 0; tick < 50; ++tick) {
    ToolPose poses[2] = {at(0.01 * tick, 0, 1.25), at(0, 0.01 * tick, 1.15)};
    poses[0].buttons = tick % 20 > 15 ? ToolTouch::kHolds : 0;
    touch.step(poses, wrenches);
    touch.fill(snapshot);
  }
  touch.reset();
  EXPECT_EQ(allocationCount(), before);
}

/// A plane, too, wherever it would be; and the tools that are there feel what they feel alone.
TEST(ToolTouch, AToolThatIsNotThereTouchesNothing) {
  const TouchedBody body = touchedSphere(2, true);
  const auto plane = std::make_shared<RigidTouchTool>(std::make_shared<PlaneShape>());
  ToolTouch all(body.greens, body.mesh, {ballTool(0.3), ballTool(0.3), plane}, 0.3);
  ToolTouch alone(body.greens, body.mesh, {ballTool(0.3)}, 0.3);
  for (int tick = 0; tick < 40; ++tick) {
    ToolPose poses[3] = {at(0, 0, 1.35 - 0.005 * tick), at(0.5, 0, 0), at(0, 0, 0)};
    poses[1].isThere = poses[2].isThere = false;
    Wrench wrenches[3], wrench;
    all.step(poses, wrenches);
    alone.step(poses, &wrench);
    EXPECT_EQ(wrenches[0].force, wrench.force);
    for (int tool : {1, 2}) EXPECT_EQ(wrenches[tool].force, Eigen::Vector3d::Zero());
  }
  ContactSnapshot snapshot = all.makeSnapshot();
  all.fill(snapshot);
  EXPECT_TRUE(snapshot.tools[0].touching);
  EXPECT_FALSE(snapshot.tools[1].touching || snapshot.tools[2].touching);
}

TEST(ToolTouch, RefusesASceneWithoutTools) {
  const TouchedBody body = touchedSphere(2, true);
  EXPECT_THROW(ToolTouch(body.greens, body.mesh, {}, 0), std::invalid_argument);
  EXPECT_THROW(ToolTouch(body.greens, body.mesh, {nullptr}, 0), std::invalid_argument);
  EXPECT_THROW(RigidTouchTool(nullptr), std::invalid_argument);
  EXPECT_THROW(SnapshotDeformation(nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
