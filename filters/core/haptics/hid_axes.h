// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Geometry>

#include "haptics/haptic_device.h"

namespace palpate {

/// What the deflection of a puck or stick means in space. HID does not tell: these are choices.
struct AxisScale {
  double reach = 0.05;  ///< m, at full deflection
  double turn = 0.8;    ///< rad, at full deflection
  double force = 1;     ///< N, of a force-feedback axis at full magnitude
};

/// HID's axes (usage tables, section 4.2: X left to right, Y far to near, Z high to low) in
/// Palpate's frame of such devices: x right, y up, z towards the hand. Both are right-handed.
inline Eigen::Vector3d fromHidAxes(const Eigen::Vector3d& v) noexcept {
  return {v.x(), -v.z(), v.y()};
}
inline Eigen::Vector3d toHidAxes(const Eigen::Vector3d& v) noexcept {
  return {v.x(), v.z(), -v.y()};
}

/// Pose of a deflected puck: displaced, and turned about one axis by the length of the vector.
/// @param translation, rotation  per axis of HID, -1..1.
inline ToolPose deflectedPose(const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation,
                              const AxisScale& scale) noexcept {
  ToolPose pose;
  pose.position = scale.reach * fromHidAxes(translation);
  const Eigen::Vector3d turn = scale.turn * fromHidAxes(rotation);
  const double angle = turn.norm();
  if (angle > 0) pose.orientation = Eigen::AngleAxisd(angle, turn / angle);
  return pose;
}

}  // namespace palpate
