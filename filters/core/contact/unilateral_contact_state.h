// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/unilateral_contact_settings.h"

namespace palpate {

/// One obstacle as it moves.
struct MovingObstacle {
  Obstacle obstacle;
  int body = 0;  ///< number of an elastic obstacle among the bodies
  RigidPose pose;
  bool placed = false;
  /// m, to where it is taken to be while it is brought into a body in which it began.
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
  bool isHeld = false;             ///< whether it holds what it touches
  bool isMany = false;             ///< of facets, or one of a tool's several parts
  std::vector<double> lookAt;      ///< a vertex: travelled_ at which to look again
  std::vector<char> isWatched;     ///< a vertex
  std::vector<int> large;          ///< triangles to be touched inside
  std::vector<double> lookInside;  ///< one of them: travelled_ at which to look again
};

/// What is known of a watched point beyond the solver.
struct ContactAnchor {
  int obstacle;
  int vertex;             ///< -1 for a point inside a triangle
  int slot;               ///< of that among the obstacle's large ones
  Eigen::Vector3d place;  ///< in the obstacle's frame, where it is or sticks
  double gap;
  double slack = 0;  ///< m, <= 0: of the gap, what is not asked to be closed yet
  Eigen::Vector3d faceNormal = Eigen::Vector3d::Zero();  ///< of that triangle
  bool isHeld = false;
  Eigen::Vector3d placeBefore = Eigen::Vector3d::Zero();  ///< the step's solves, in the surface's
};

}  // namespace palpate
