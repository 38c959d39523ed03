// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/workspace_mapping.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

WorkspaceMapping turnedAndScaled() {
  WorkspaceMapping mapping;
  mapping.rotation = Quaterniond(0.4, -0.3, 0.5, 0.2).normalized();
  mapping.scale = 3;
  mapping.origin = {0.1, -0.2, 0.7};
  mapping.forceScale = 0.25;
  return mapping;
}

TEST(WorkspaceMapping, ByDefaultTheSceneIsTheDevicesRoom) {
  ToolPose pose;
  pose.position = {1, 2, 3};
  pose.buttons = 5;
  pose.jointCount = 2;
  pose.joints[1] = 0.3;
  const ToolPose scene = WorkspaceMapping().toScene(pose);
  EXPECT_EQ(scene.position, pose.position);
  EXPECT_EQ(scene.buttons, 5u);
  EXPECT_EQ(scene.jointCount, 2);
  EXPECT_EQ(scene.joints[1], 0.3);
  const Wrench wrench = WorkspaceMapping().toDevice({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(wrench.force, Vector3d(1, 2, 3));
  EXPECT_EQ(wrench.torque, Vector3d(4, 5, 6));
}

TEST(WorkspaceMapping, PointsOfARigidToolStayInPlaceOnIt) {
  const WorkspaceMapping mapping = turnedAndScaled();
  ToolPose pose;
  pose.position = {0.01, 0.02, -0.03};
  pose.orientation = Quaterniond(0.1, 0.7, 0.2, -0.4).normalized();
  const ToolPose scene = mapping.toScene(pose);
  const Vector3d onTool(0.3, -0.1, 0.2);
  const Vector3d expected =
      mapping.origin +
      mapping.scale * (mapping.rotation * (pose.position + pose.orientation * onTool));
  EXPECT_LE((scene.position + scene.orientation * (mapping.scale * onTool) - expected).norm(),
            1e-15);
}

TEST(WorkspaceMapping, WorkFeltIsTheSceneWorkTimesForceScaleOverScale) {
  const WorkspaceMapping mapping = turnedAndScaled();
  const Wrench wrench{{1, -2, 0.5}, {0.3, 0.1, -0.7}};
  const Wrench felt = mapping.toDevice(wrench);
  const Vector3d step(1e-3, 2e-3, -1e-3), turn(0.01, -0.02, 0.03);
  const double ratio = mapping.forceScale / mapping.scale;
  EXPECT_NEAR(felt.force.dot(step),
              ratio * wrench.force.dot(mapping.scale * (mapping.rotation * step)), 1e-17);
  EXPECT_NEAR(felt.torque.dot(turn), ratio * wrench.torque.dot(mapping.rotation * turn), 1e-16);
}

}  // namespace
}  // namespace palpate::test
