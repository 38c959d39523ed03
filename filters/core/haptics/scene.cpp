// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "haptics/json_reader.h"
#include "haptics/scene_settings.h"

namespace palpate {
namespace {

constexpr double kFarthest = 1e6;  ///< m, and as large as other numbers get
constexpr double kLargestFriction = 100;
constexpr std::size_t kMostEntries = 1000;
constexpr double kHandLength = 0.19;

Eigen::Vector3d readVector(const Json& value, const std::string& path) {
  return readNumberList(value, path, 3, kFarthest);
}

/// [w, x, y, z], or an axis and an angle.
Eigen::Quaterniond readRotation(const Json& value, const std::string& path) {
  constexpr double shortest = 1e-6;
  if (value.is_array()) {
    const Eigen::VectorXd q = readNumberList(value, path, 4, kFarthest);
    if (q.norm() < shortest) refuseKey(path, "must not be zero");
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  }
  if (!value.is_object())
    refuseKey(path,
              "must be a quaternion [w, x, y, z] or {\"axis\", \"angle\"}, not " + shown(value));
  JsonSection section(value, path);
  const Eigen::Vector3d axis = readVector(section.need("axis"), section.path("axis"));
  const double angle = readNumber(section.need("angle"), section.path("angle"), kFarthest);
  section.requireNothingElse();
  if (axis.norm() < shortest) refuseKey(section.path("axis"), "must not be zero");
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

double readFriction(const Json& value, const std::string& path) {
  return readNotNegative(value, path, kLargestFriction);
}

WorkspaceMapping readMapping(const Json& value, const std::string& path) {
  JsonSection section(value, path);
  WorkspaceMapping mapping;
  readIf(section, "scale", mapping.scale, readPositive, kFarthest);
  readIf(section, "origin", mapping.origin, readVector);
  readIf(section, "rotation", mapping.rotation, readRotation);
  readIf(section, "force_scale", mapping.forceScale, readNotNegative, kFarthest);
  section.requireNothingElse();
  return mapping;
}

void readHid(JsonSection& section, SceneDevice& device) {
  readIf(section, "description", device.description, readText);
  const bool isDescribed = !device.description.empty();
  for (const char* key : {"vendor_id", "product_id"}) {
    const Json* found = section.find(key);
    if (isDescribed && found)
      refuseKey(section.path(key), "is in the device's description already");
    if (isDescribed) continue;
    if (!found)
      refuseKey(section.path(key),
                "is missing: a hid device is found by vendor_id and product_id, "
                "or by a description");
    (key[0] == 'v' ? device.vendor : device.product) = readUsbId(*found, section.path(key));
  }
}

SceneDevice readDevice(const Json& value, const std::string& path) {
  JsonSection section(value, path);
  SceneDevice device;
  device.name = readText(section.need("name"), section.path("name"));
  device.type = readNamed<DeviceType>(section.need("type"), section.path("type"),
                                      {{"mouse", DeviceType::Mouse},
                                       {"scripted", DeviceType::Scripted},
                                       {"simulated", DeviceType::Simulated},
                                       {"hid", DeviceType::Hid}});
  if (device.type == DeviceType::Scripted)
    device.file = readText(section.need("file"), section.path("file"));
  if (device.type == DeviceType::Hid) readHid(section, device);
  readIf(section, "mapping", device.mapping, readMapping);
  section.requireNothingElse();
  return device;
}

std::vector<SceneDevice> readDevices(const Json& value) {
  std::vector<SceneDevice> devices;
  for (const Json& entry : readList(value, "devices", kMostEntries)) {
    const std::string path = entryPath("devices", devices.size());
    SceneDevice device = readDevice(entry, path);
    for (const SceneDevice& other : devices)
      if (other.name == device.name)
        refuseKey(path + ".name", "must be its own: there is another " + shown(Json(device.name)));
    devices.push_back(std::move(device));
  }
  return devices;
}

/// Its number among the devices.
int readToolDevice(const Json& value, const std::string& path,
                   const std::vector<SceneDevice>& devices) {
  const std::string name = readText(value, path);
  std::string names;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].name == name) return static_cast<int>(i);
    names += (i ? ", " : "") + shown(Json(devices[i].name));
  }
  refuseKey(path, "names no device of the scene: there " +
                      (names.empty() ? std::string("is none") : "are " + names));
}

SceneTool readTool(const Json& value, const std::string& path,
                   const std::vector<SceneDevice>& devices) {
  JsonSection section(value, path);
  SceneTool tool;
  tool.shape = readNamed<ToolShape>(section.need("shape"), section.path("shape"),
                                    {{"point", ToolShape::Point},
                                     {"sphere", ToolShape::Sphere},
                                     {"capsule", ToolShape::Capsule},
                                     {"plane", ToolShape::Plane},
                                     {"mesh", ToolShape::Mesh},
                                     {"hand", ToolShape::Hand}});
  if (tool.shape == ToolShape::Sphere || tool.shape == ToolShape::Capsule)
    tool.radius = readPositive(section.need("radius"), section.path("radius"), kFarthest);
  if (tool.shape == ToolShape::Capsule)
    tool.length = readPositive(section.need("length"), section.path("length"), kFarthest);
  if (tool.shape == ToolShape::Mesh)
    tool.file = readText(section.need("file"), section.path("file"));
  if (tool.shape == ToolShape::Hand) {
    tool.length = kHandLength;
    readIf(section, "length", tool.length, readPositive, kFarthest);
    readIf(section, "side", [&](const Json& found, const std::string& at) {
      tool.side =
          readNamed<HandSide>(found, at, {{"left", HandSide::Left}, {"right", HandSide::Right}});
    });
  }
  tool.device = readToolDevice(section.need("device"), section.path("device"), devices);
  section.requireNothingElse();
  return tool;
}

/// Each device moves one tool, and points do not go together with shapes.
std::vector<SceneTool> readTools(const Json& value, const std::vector<SceneDevice>& devices) {
  std::vector<SceneTool> tools;
  std::vector<bool> isHeld(devices.size());
  for (const Json& entry : readList(value, "tools", kMostEntries)) {
    const std::string path = entryPath("tools", tools.size());
    const SceneTool tool = readTool(entry, path, devices);
    if (isHeld[tool.device]) refuseKey(path + ".device", "moves another tool already");
    isHeld[tool.device] = true;
    if (tool.shape == ToolShape::Hand && devices[tool.device].type == DeviceType::Mouse)
      refuseKey(path + ".device", "must have joints to move a hand with, which a mouse has not");
    if (!tools.empty() &&
        (tool.shape == ToolShape::Point) != (tools.front().shape == ToolShape::Point))
      refuseKey(path + ".shape", "must be a point as the other tools are, or none of them");
    tools.push_back(tool);
  }
  if (tools.empty()) refuseKey("tools", "must have an entry: what the surface is touched with");
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (!isHeld[i]) refuseKey(entryPath("devices", i), "moves no tool");
  return tools;
}

SceneProbe readProbe(const Json& value, const std::string& path) {
  JsonSection section(value, path);
  SceneProbe probe;
  probe.name = readText(section.need("name"), section.path("name"));
  const Json *node = section.find("node"), *position = section.find("position"),
             *inside = section.find("inside");
  if (!!node + !!position + !!inside != 1)
    refuseKey(path, "must have one of node, position and inside");
  if (node) probe.node = readInteger(*node, section.path("node"), 0, 1 << 30);
  if (position) probe.position = readVector(*position, section.path("position"));
  probe.isInside = inside != nullptr;
  if (inside) {
    probe.position = readVector(*inside, section.path("inside"));
    readIf(section, "von_mises_limit", probe.limits.vonMises, readPositive, 1e15);
    readIf(section, "gradient_limit", probe.limits.gradient, readPositive, kFarthest);
  }
  section.requireNothingElse();
  return probe;
}

std::vector<SceneProbe> readProbes(const Json& value, const std::string& path) {
  std::vector<SceneProbe> probes;
  for (const Json& entry : readList(value, path, kMostEntries)) {
    probes.push_back(readProbe(entry, entryPath(path, probes.size())));
    for (std::size_t i = 0; i + 1 < probes.size(); ++i)
      if (probes[i].name == probes.back().name)
        refuseKey(entryPath(path, probes.size() - 1) + ".name",
                  "must be its own: there is another " + shown(Json(probes[i].name)));
  }
  return probes;
}

void readMasks(const Json& value, const std::string& path, SceneEffects& effects) {
  JsonSection section(value, path);
  readIf(section, "shape", [&](const Json& found, const std::string& at) {
    effects.maskShape = readNamed<MaskShape>(found, at,
                                             {{"linear", MaskShape::Linear},
                                              {"uniform", MaskShape::Uniform},
                                              {"gaussian", MaskShape::Gaussian},
                                              {"hertzian", MaskShape::Hertzian}});
  });
  const Json *radius = section.find("radius"), *edges = section.find("radius_edges");
  if (radius && edges) refuseKey(path, "must have a radius or radius_edges, and not both");
  if (radius) effects.maskRadius = readNotNegative(*radius, section.path("radius"), kFarthest);
  if (edges)
    effects.maskRadiusEdges = readNotNegative(*edges, section.path("radius_edges"), kFarthest);
  section.requireNothingElse();
}

/// What goes with points only, or with shapes only.
void readContact(JsonSection& section, bool ofPoints, SceneEffects& effects) {
  effects.unilateral = !ofPoints;
  readIf(section, "unilateral", [&](const Json& found, const std::string& at) {
    effects.unilateral = readFlag(found, at);
    if (effects.unilateral && ofPoints)
      refuseKey(at, "must be false for points, which let go of the surface by themselves");
  });
  readIf(section, "torque", [&](const Json& found, const std::string& at) {
    effects.torque = readFlag(found, at);
    if (effects.torque && ofPoints) refuseKey(at, "must be false for points, which feel none");
  });
  readIf(section, "masks", [&](const Json& found, const std::string& at) {
    if (!ofPoints) refuseKey(at, "are of points, not of tools with a shape");
    readMasks(found, at, effects);
  });
  readIf(section, "elastic_elastic", [&](const Json& found, const std::string& at) {
    effects.elasticElastic = readFlag(found, at);
    if (effects.elasticElastic && ofPoints)
      refuseKey(at, "must be false with points: bodies meet each other as tools with a shape do");
  });
}

SceneEffects readEffects(const Json& value, bool ofPoints) {
  JsonSection section(value, "effects");
  SceneEffects effects;
  readIf(section, "deformation", [&](const Json& found, const std::string& at) {
    effects.deformation = readNamed<DeformationRows>(found, at,
                                                     {{"all", DeformationRows::All},
                                                      {"visible", DeformationRows::Visible},
                                                      {"contact", DeformationRows::Contact},
                                                      {"none", DeformationRows::None}});
  });
  readIf(section, "friction", [&](const Json& found, const std::string& at) {
    JsonSection friction(found, at);
    effects.friction = readFriction(friction.need("mu"), friction.path("mu"));
    friction.requireNothingElse();
  });
  readContact(section, ofPoints, effects);
  readIf(section, "gravity", effects.gravity, readVector);
  readIf(section, "probes", effects.probes, readProbes);
  readIf(section, "stiffness_limit", effects.stiffnessLimit, readNotNegative, 1e15);
  readIf(section, "stiffness_scale", effects.stiffnessScale, readPositive, 1e9);
  section.requireNothingElse();
  return effects;
}

SceneModel readModel(const Json& value, const std::string& path, bool isFirst,
                     const SceneEffects& effects) {
  JsonSection section(value, path);
  SceneModel model;
  model.file = readText(section.need("file"), section.path("file"));
  readIf(section, "position", [&](const Json& found, const std::string& at) {
    model.pose.position = readVector(found, at);
    if (isFirst && !model.pose.position.isZero(0))
      refuseKey(at, "must be zero: the first model's frame is the scene's");
  });
  readIf(section, "orientation", [&](const Json& found, const std::string& at) {
    model.pose.orientation = readRotation(found, at);
    if (isFirst && !model.pose.orientation.vec().isZero(0))
      refuseKey(at, "must be none: the first model's frame is the scene's");
  });
  model.friction = effects.friction;
  readIf(section, "friction", [&](const Json& found, const std::string& at) {
    if (isFirst) refuseKey(at, "is between a further model and the first: see effects.friction");
    model.friction = readFriction(found, at);
  });
  readIf(section, "density", model.density, readPositive, 1e6);
  section.requireNothingElse();
  if (!effects.gravity.isZero(0) && model.density == 0)
    refuseKey(path + ".density", "is missing: with gravity, each model has one");
  return model;
}

std::vector<SceneModel> readModels(const Json& value, const SceneEffects& effects) {
  std::vector<SceneModel> models;
  for (const Json& entry : readList(value, "models", kMostEntries))
    models.push_back(readModel(entry, entryPath("models", models.size()), models.empty(), effects));
  if (models.empty()) refuseKey("models", "must have an entry: the surface that is touched");
  if (models.size() > 1 && !effects.elasticElastic)
    refuseKey("models[1]", "meets the first only if effects.elastic_elastic is true");
  if (models.size() == 1 && effects.elasticElastic)
    refuseKey("effects.elastic_elastic", "is true, but there is one model only");
  return models;
}

Scene readWholeScene(const std::string& text) {
  const Json value = parseJson(text, "the text");
  JsonSection section(value, "", "it");
  Scene scene;
  readIf(section, "devices",
         [&](const Json& found, const std::string&) { scene.devices = readDevices(found); });
  scene.tools = readTools(section.need("tools"), scene.devices);
  const Json* effects = section.find("effects");
  scene.effects = readEffects(effects ? *effects : Json::object(), scene.isOfPoints());
  scene.models = readModels(section.need("models"), scene.effects);
  readIf(section, "servo", [&](const Json& found, const std::string&) {
    JsonSection servo(found, "servo");
    scene.servo = readServo(servo);
  });
  readIf(section, "safety", [&](const Json& found, const std::string&) {
    JsonSection safety(found, "safety");
    scene.safety = readSafety(safety);
  });
  readIf(section, "solver", [&](const Json& found, const std::string& at) {
    if (scene.isOfPoints()) refuseKey(at, "is of tools with a shape, not of points");
    JsonSection solver(found, "solver");
    scene.solver = readSolver(solver);
  });
  section.requireNothingElse();
  return scene;
}

}  // namespace

Scene parseScene(const std::string& json) {
  try {
    return readWholeScene(json);
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument(std::string("scene: ") + wrong.what());
  }
}

Scene readScene(const std::string& path) {
  const std::string text = readTextFile(path, "the scene");
  Scene scene;
  try {
    scene = parseScene(text);
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument("'" + path + "': " + wrong.what());
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const auto resolve = [&](std::string& file) {
    if (!file.empty()) file = (folder / file).lexically_normal().string();
  };
  for (SceneModel& model : scene.models) resolve(model.file);
  for (SceneTool& tool : scene.tools) resolve(tool.file);
  for (SceneDevice& device : scene.devices) {
    resolve(device.file);
    resolve(device.description);
  }
  return scene;
}

}  // namespace palpate
