// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "haptics/scene.h"
#include "haptics/simulated_device.h"
#include "haptics/touch_session.h"

namespace palpate {

/// The free vertex, among those with Green's functions, that is farthest from the middle of the
/// support (of the body, if nothing is fixed; from the rim of a half-space's surface) and from
/// places that are taken.
/// @param taken  m, in the body's frame.
/// @throws std::invalid_argument if there is none.
int farthestFreeVertex(const SceneBody& body, const std::vector<Eigen::Vector3d>& taken = {});

/// Where a hand presses a tool on a body, and how far.
struct PressPlan {
  Eigen::Vector3d contact;               ///< of the tool's position when it just touches, m
  Eigen::Vector3d outwards;              ///< unit, off the surface
  double clearance, depth;               ///< m, of the farthest and the deepest position from there
  static constexpr double kSeconds = 2;  ///< from one lift to the next
};

/// Along the surface's normal at a free vertex. A capsule comes along its own axis, on the vertex
/// that lies highest that way; a plane from below.
/// @param toolMesh  of a mesh, as in TouchSession; otherwise null.
/// @param taken     where other hands press; this one's place is added. m.
/// @throws std::invalid_argument for a hand, which needs a glove's joints; as farthestFreeVertex.
PressPlan planPress(const SceneBody& body, const SceneTool& tool, const SurfaceMesh* toolMesh,
                    std::vector<Eigen::Vector3d>& taken);

/// A simulated device in a hand that presses and lifts, over and over, as a cosine from `clearance`
/// down to `depth`. It begins lifted, at rest.
/// @param mapping  of the device into the scene, whose frame is the body's.
/// @param period   s, of the servo loop.
std::shared_ptr<SimulatedDevice> pressingDevice(const PressPlan& plan,
                                                const WorkspaceMapping& mapping, double period);

}  // namespace palpate
