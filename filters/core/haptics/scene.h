// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "contact/pressure_mask.h"
#include "contact/rigid_shape.h"
#include "contact/unilateral_contact.h"
#include "haptics/hand_model.h"
#include "haptics/probed_touch.h"
#include "haptics/servo_loop.h"
#include "haptics/workspace_mapping.h"

namespace palpate {

/// An elastic body.
struct SceneModel {
  std::string file;
  RigidPose pose;       ///< of a partner; the first model's frame is the scene's
  double friction = 0;  ///< Coulomb's mu between a partner and the first model
  double density = 0;   ///< kg/m^3, for gravity
};

enum class ToolShape {
  Point,    ///< the tip of a probe
  Sphere,   ///< around the tool's position
  Capsule,  ///< from the tool's position along its z axis: the rounded tip of a rod
  Plane,    ///< the half space below z = 0 of the tool's frame
  Mesh,     ///< a closed surface in the tool's frame
  Hand,     ///< HandModel, moved by a glove's joints
};

struct SceneTool {
  ToolShape shape = ToolShape::Point;
  double radius = 0;  ///< m, of spheres and capsules
  double length = 0;  ///< m, of a capsule's axis, or of a hand from wrist to fingertip
  HandSide side = HandSide::Right;
  std::string file;  ///< a mesh's
  int device = 0;    ///< what moves it, among the scene's
};

enum class DeviceType {
  Mouse,      ///< of whoever shows the scene
  Scripted,   ///< replays a recording
  Simulated,  ///< a hand that presses and lifts (pressingDevice)
  Hid,        ///< by its description, or a known one by its numbers
};

struct SceneDevice {
  std::string name;
  DeviceType type = DeviceType::Mouse;
  std::string file;         ///< a scripted device's recording
  std::string description;  ///< of a HID device, a file of HidDescription
  std::uint16_t vendor = 0, product = 0;
  WorkspaceMapping mapping;
};

/// A place on the first model, whose displacement is reported, or inside it, whose stress is, too.
struct SceneProbe {
  std::string name;
  int node = -1;                                       ///< or, if negative:
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, the surface's point nearest to it
  bool isInside = false;                               ///< at that position itself
  ProbeLimits limits;                                  ///< if it is inside
};

/// Whose displacements are computed, a frame.
enum class DeformationRows { All, Visible, Contact, None };

/// What is simulated. What is not asked for costs nothing.
struct SceneEffects {
  DeformationRows deformation = DeformationRows::All;
  double friction = 0;  ///< Coulomb's mu between the first model and the tools
  /// Whether tools with a shape only ever press (UnilateralContact); otherwise their first button
  /// holds what they touch, as that of points does always.
  bool unilateral = false;
  bool torque = false;                                ///< whether torques are computed and sent
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s^2
  std::vector<SceneProbe> probes;
  MaskShape maskShape = MaskShape::Linear;
  double maskRadius = 0;        ///< m
  double maskRadiusEdges = 0;   ///< mean edge lengths, instead
  double stiffnessLimit = 0;    ///< k_Rigid, N/m, of points and of fixed vertices
  double stiffnessScale = 1;    ///< of all forces
  bool elasticElastic = false;  ///< whether further models meet the first
};

/// What to touch, with what, and what of it to simulate, as a user writes it down in JSON:
///
///     {
///       "models": [{"file": "kidney.vtp"}],
///       "tools": [{"shape": "sphere", "radius": 0.008, "device": "stylus"}],
///       "devices": [{"name": "stylus", "type": "hid", "vendor_id": "0x046d",
///                    "product_id": "0xc626", "mapping": {"scale": 0.5, "origin": [0, 0, 0.08]}}],
///       "effects": {"deformation": "visible", "friction": {"mu": 0.3}, "torque": true},
///       "servo": {"rate": 1000}
///     }
///
/// Lengths are metres, forces newtons. All keys, with what holds where one is left out:
/// - "models": one or more {"file"; "position" [x, y, z] (0), "orientation" (none) as a quaternion
///   [w, x, y, z] or {"axis": [x, y, z], "angle": radians}, "friction" (that of the effects),
///   "density" in kg/m^3}. The first is touched, and its frame is the scene's; others are partners,
///   for which "elastic_elastic" must be true.
/// - "tools": one or more {"shape": point, sphere, capsule, plane, mesh or hand; "device": a
///   device's name; "radius" of a sphere or capsule, "length" of a capsule or a hand (0.19),
///   "side" of a hand: left or right (right), "file" of a mesh}. Points do not go together with
///   shapes.
/// - "devices": {"name"; "type": mouse, scripted, simulated or hid; "file" of a scripted one;
///   "description" or "vendor_id" and "product_id" of a hid one; "mapping": {"scale" (1), "origin"
///   (0), "rotation" (none), "force_scale" (1)}}. Each moves one tool. A scripted one replays a
///   recording at the servo rate that this states, a simulated one presses and lifts its tool.
/// - "effects": {"deformation": all, visible, contact or none (all), "friction": {"mu"} (0),
///   "unilateral" (true with shapes: they only press; false, as always with points: what they touch
///   is held, and pulled, while the first button of their device is pressed), "torque" (false),
///   "gravity" in m/s^2 (0), "probes": a list of {"name", and "node", "position" on the surface or
///   "inside" of the body, with "von_mises_limit" in Pa and "gradient_limit" from which on it is
///   reported (none)} (none), "masks" of points: {"shape": linear, uniform, gaussian or hertzian
///   (linear), "radius" or "radius_edges" (the vertex alone)}, "stiffness_limit" in N/m, of what
///   points feel and of fixed vertices (the model's own), "stiffness_scale" (1), "elastic_elastic"
///   (false)}.
/// - "servo": {"rate" in Hz (1000), "budget" (0.7), "snapshot_ticks" (1), "passivity_damping" in N
///   s/m (0), "real_time" (true), "processor" (any)}: ServoSettings.
/// - "safety": {"largest_force" in N (3), "largest_torque" in N m (0.1), "force_slew" (1000) in
///   N/s, "torque_slew" in N m/s (30), "ramp_seconds" from nothing to the whole force (0.5)}:
///   SafetySettings, of all devices but mice, which render nothing. No device is asked for more
///   than it says it renders.
/// - "solver", of tools with a shape: {"capacity" (as many contacts as the model has vertices, from
///   128 to 500), "margin" in m (half an edge), "linearisations" (1), "tolerance" (1e-9),
///   "largest_iterations" (100), "largest_updates", at least 1 (12), "largest_work" in flops
///   (2e7)}: UnilateralContactSettings.
struct Scene {
  std::vector<SceneModel> models;
  std::vector<SceneTool> tools;
  std::vector<SceneDevice> devices;
  SceneEffects effects;
  ServoSettings servo;
  SafetySettings safety;             ///< of every device that renders forces
  UnilateralContactSettings solver;  ///< but for its rigid stiffness: the stiffness limit

  /// Whether all tools are points; otherwise none is.
  bool isOfPoints() const { return tools.front().shape == ToolShape::Point; }
};

/// @throws std::invalid_argument, one sentence with the key that is missing, unknown or wrong.
Scene parseScene(const std::string& json);
/// The same from a file, with the names of files as seen from its folder.
/// @throws as above, with the file's name; std::runtime_error if it cannot be opened.
Scene readScene(const std::string& path);

}  // namespace palpate
