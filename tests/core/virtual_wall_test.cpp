// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/virtual_wall.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

TEST(VirtualWall, PushesBackWithItsStiffnessTimesTheDepthAndNeverPulls) {
  VirtualWall wall(200, {0, 0, 0.1}, {0, 0, 3}, 2);
  ToolPose poses[2];
  Wrench wrenches[2];
  poses[0].position = {1, 2, 0.08};
  poses[1].position = {5, 5, 0.11};
  EXPECT_EQ(wall.step(poses, wrenches).contactCount, 1);
  EXPECT_LE((wrenches[0].force - Vector3d(0, 0, 4)).norm(), 1e-13);
  EXPECT_EQ(wrenches[0].torque, Vector3d::Zero());
  EXPECT_EQ(wrenches[1].force, Vector3d::Zero());
}

TEST(VirtualWall, ItsSnapshotShowsWhereAndHowEachToolTouches) {
  VirtualWall wall(200, Vector3d::Zero(), Vector3d::UnitX());
  ContactSnapshot snapshot = wall.makeSnapshot();
  ASSERT_EQ(snapshot.tools.size(), 1u);
  ToolPose pose;
  pose.position = {-0.02, 0.5, 0};
  Wrench wrench;
  wall.step(&pose, &wrench);
  wall.fill(snapshot);
  EXPECT_TRUE(snapshot.tools[0].touching);
  EXPECT_EQ(snapshot.tools[0].hapticPoint, pose.position);
  EXPECT_LE((snapshot.tools[0].staticPoint - Vector3d(0, 0.5, 0)).norm(), 1e-16);
  EXPECT_EQ(snapshot.tools[0].wrench.force, wrench.force);
  wall.reset();
  wall.fill(snapshot);
  EXPECT_FALSE(snapshot.tools[0].touching);
}

TEST(VirtualWall, RefusesWhatIsNoWall) {
  const Vector3d zero = Vector3d::Zero(), up = Vector3d::UnitZ();
  EXPECT_TRUE(isRefused([&] { VirtualWall(-1, zero, up); }, "stiffness must not be negative: -1"));
  EXPECT_TRUE(isRefused([&] { VirtualWall(1, {NAN, 0, 0}, up); }, "point is not a finite number"));
  EXPECT_TRUE(isRefused([&] { VirtualWall(1, zero, zero); }, "normal has no direction"));
  EXPECT_TRUE(isRefused([&] { VirtualWall(1, zero, up, 0); }, "by one tool or more, not by 0"));
}

}  // namespace
}  // namespace palpate::test
