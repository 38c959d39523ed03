// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch_checks.h"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "haptics/scene.h"
#include "touch/touch_window.h"

namespace palpate::app {
namespace {

const std::string kScripted = "scripted:";

/// A file and what it is to the run.
struct Role {
  std::string what, path;
};

bool isSame(const std::string& a, const std::string& b) {
  std::error_code unknown;
  return std::filesystem::equivalent(a, b, unknown) ||
         std::filesystem::weakly_canonical(a, unknown) ==
             std::filesystem::weakly_canonical(b, unknown);
}

bool isScripted(const TouchOptions& options) {
  return options.device.rfind(kScripted, 0) == 0;
}

std::vector<Role> filesRead(const TouchOptions& options, const std::optional<Scene>& scene) {
  std::vector<Role> files{{"the model", options.model}, {"--scene", options.scene}};
  if (isScripted(options))
    files.push_back({"the recording of --device", options.device.substr(kScripted.size())});
  if (!scene) return files;
  for (const SceneModel& model : scene->models) files.push_back({"a model of --scene", model.file});
  for (const SceneTool& tool : scene->tools) files.push_back({"a tool of --scene", tool.file});
  for (const SceneDevice& device : scene->devices) {
    files.push_back({"a recording of --scene", device.file});
    files.push_back({"a description of --scene", device.description});
  }
  return files;
}

void requireDistinctFiles(const TouchOptions& options, const std::optional<Scene>& scene) {
  std::vector<Role> files = filesRead(options, scene);
  for (const Role& written : {Role{"--record", options.record}, Role{"--forces", options.forces},
                              Role{"--image", options.image}}) {
    if (written.path.empty()) continue;
    for (const Role& file : files)
      if (!file.path.empty() && isSame(file.path, written.path))
        throw std::invalid_argument(written.what + " would write over " + file.what + ", " +
                                    file.path + ": choose another name");
    files.push_back(written);
  }
}

/// Whether there is a recording whose forces can be told.
bool hasScript(const TouchOptions& options, const std::optional<Scene>& scene) {
  if (isScripted(options)) return true;
  if (!scene) return false;
  return std::any_of(scene->tools.begin(), scene->tools.end(), [&](const SceneTool& tool) {
    const bool isReplaced = options.deviceGiven && tool.device == scene->tools[0].device;
    return !isReplaced && scene->devices[tool.device].type == DeviceType::Scripted;
  });
}

}  // namespace

void requireSensible(const TouchOptions& options) {
  if (options.model.empty() == options.scene.empty())
    throw CLI::RequiredError("a model or a --scene, one of the two,");
  if (options.lab && options.model.empty())
    throw std::invalid_argument("the lab presses one model: give its file instead of a scene");
  if (options.headless && options.seconds <= 0)
    throw CLI::RequiredError("--headless needs --seconds, which");
  if (!options.image.empty() && !options.headless && !options.lab)
    throw CLI::RequiredError("--image needs --headless or --lab, one of which");
  if (!options.record.empty() && options.seconds > kMostRecordedSeconds)
    throw std::invalid_argument("--record holds at most 120 seconds: choose a shorter --seconds");
  std::optional<Scene> scene;
  if (!options.scene.empty()) scene = readScene(options.scene);
  if (!options.forces.empty() && !hasScript(options, scene))
    throw std::invalid_argument(
        "--forces tells the forces on a recording that is replayed: add --device scripted:FILE, "
        "which --record writes");
  const bool isOfPoint = options.maskRadius >= 0 || options.stiffnessLimit >= 0;
  if (isOfPoint && scene && !scene->isOfPoints())
    throw std::invalid_argument(
        "--radius and --rigid-stiffness are of points, but the scene's tools have a shape");
  const bool isOfShapes = options.toolRadius > 0 || (scene && !scene->isOfPoints());
  if (options.contacts != 0 && !isOfShapes)
    throw std::invalid_argument("--contacts is of tools with a shape: add --tool-radius");
  requireDistinctFiles(options, scene);
}

bool waitsForMouse(const TouchOptions& options) {
  if (options.scene.empty()) return options.device == "mouse";
  const Scene scene = readScene(options.scene);
  return std::any_of(scene.tools.begin(), scene.tools.end(), [&](const SceneTool& tool) {
    const bool isReplaced = options.deviceGiven && tool.device == scene.tools[0].device;
    return isReplaced ? options.device == "mouse"
                      : scene.devices[tool.device].type == DeviceType::Mouse;
  });
}

}  // namespace palpate::app
