// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "haptics/haptic_device.h"

namespace palpate {

/// How a device's small room lies in the scene: x = origin + scale R x_device.
///
/// Work felt over work done in the scene is forceScale / scale, for forces and torques alike: a
/// torque shrinks with its lever.
struct WorkspaceMapping {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< R, device to scene, unit
  double scale = 1;                                  ///< metres in the scene per metre of device
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the device, in the scene, m
  double forceScale = 1;                             ///< newtons felt per newton in the scene

  ToolPose toScene(const ToolPose& device) const noexcept {
    ToolPose scene = device;
    scene.position = origin + scale * (rotation * device.position);
    scene.orientation = rotation * device.orientation;
    return scene;
  }

  Wrench toDevice(const Wrench& scene) const noexcept {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {forceScale * (back * scene.force), forceScale / scale * (back * scene.torque)};
  }
};

}  // namespace palpate
