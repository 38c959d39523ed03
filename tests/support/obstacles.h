// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "contact/unilateral_contact.h"

namespace palpate::test {

/// For steps that each stand for themselves: gaps linearised until they are met.
inline UnilateralContactSettings still(int capacity, double margin = 0) {
  UnilateralContactSettings settings;
  settings.capacity = capacity;
  settings.margin = margin;
  settings.linearisations = 6;
  settings.solver = ContactSolverSettings::unhurried();
  return settings;
}

inline RigidPose at(double x, double y, double z) {
  RigidPose pose;
  pose.position = {x, y, z};
  return pose;
}

/// @param tool  its number, as those of ToolTouch have one; -1 for none.
inline std::vector<Obstacle> ball(double radius, double friction = 0, int tool = -1) {
  return {{std::make_shared<SphereShape>(radius), friction, nullptr, nullptr, tool}};
}

/// The half space above a height, as a tool that comes down on the pole.
inline RigidPose plate(double height, double x = 0) {
  RigidPose pose;
  pose.position = {x, 0, height};
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  return pose;
}

}  // namespace palpate::test
