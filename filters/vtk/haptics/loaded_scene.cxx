// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "loaded_scene.h"

#include "bem/interior_probes.h"
#include "conversion.h"
#include "haptics/glove_device.h"
#include "haptics/hid_bus.h"
#include "model_arrays.h"
#include "read_files.h"

#include "vtkPolyData.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace palpate
{
namespace
{
constexpr double DefaultFriction = 0.3, DefaultMaskEdges = 2;
constexpr double RateError = 1e-6; ///< relative, of rounding

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// As `palpate devices` shows the numbers of one.
std::string hexadecimal(std::uint16_t value)
{
  char text[8];
  std::snprintf(text, sizeof text, "%04x", unsigned(value));
  return text;
}

/// A model of a scene, whose sentences begin with its file.
vtkSmartPointer<vtkPolyData> readModel(const std::string& path)
{
  if (!std::filesystem::exists(path))
  {
    throw std::runtime_error(path + ": there is no such file; `palpate precompute SURFACE " + path +
      "` makes a model of a surface, `python3 data/make_scenes.py` those of Palpate's own scenes");
  }
  return readSurface(path);
}
} // namespace

LoadedScene mouseScene()
{
  Scene scene;
  scene.models.emplace_back();
  scene.tools.emplace_back();
  scene.devices.emplace_back();
  scene.devices[0].name = "mouse";
  scene.effects.friction = DefaultFriction;
  scene.effects.maskRadiusEdges = DefaultMaskEdges;
  scene.effects.torque = true;
  return { std::move(scene), {}, nullptr };
}

SceneBody bodyOf(vtkPolyData* model)
{
  const convert::ServedModel served = convert::servedModelOf(model);
  SceneBody body{ served.greens, served.mesh, served.smoothPatches };
  requireTouchable(body);
  return body;
}

std::shared_ptr<const ProbeRows> rowsOfProbesInside(const Scene& scene, const SceneBody& body)
{
  const Eigen::Matrix3Xd points = placesInside(scene);
  if (points.cols() == 0)
  {
    return nullptr;
  }
  const GreensFunctionsInfo& info = body.greens->info();
  if (!info.homogeneous && info.probes)
  {
    constexpr double tolerance = 1e-6; // of the diagonal
    return std::make_shared<const ProbeRows>(
      info.probes->at(points, tolerance * body.mesh->diagonal()));
  }
  const ElasticModel model(
    body.mesh, info.material, info.conditions, body.smoothPatches, info.domain);
  return std::make_shared<const ProbeRows>(probeRows(*body.greens, model, points));
}

LoadedScene loadScene(const std::string& fileName)
{
  LoadedScene loaded;
  loaded.Described = readScene(fileName);
  for (const SceneModel& model : loaded.Described.models)
  {
    const vtkSmartPointer<vtkPolyData> surface = readModel(model.file);
    try
    {
      loaded.Bodies.push_back(bodyOf(surface));
    }
    catch (const std::exception& failure)
    {
      throw std::runtime_error(model.file + ": " + failure.what());
    }
    if (!loaded.FirstModel)
    {
      loaded.FirstModel = surface;
    }
  }
  return loaded;
}

LoadedTool loadTool(const SceneTool& tool, double reach)
{
  if (tool.shape != ToolShape::Mesh)
  {
    return { lookOf(tool, nullptr, reach), nullptr };
  }
  const vtkSmartPointer<vtkPolyData> surface = readSurface(tool.file);
  try
  {
    return { lookOf(tool, surface, reach), convert::soundMeshOf(surface) };
  }
  catch (const std::exception& failure)
  {
    throw std::runtime_error("the tool " + tool.file + ": " + failure.what());
  }
}

std::shared_ptr<ScriptedDevice> openScript(
  const SceneDevice& device, const SceneTool& tool, double rate)
{
  DeviceRecording recording = readDeviceRecording(device.file);
  const std::string name = "the recording '" + device.file + "'";
  if (recording.rate > 0 && std::abs(recording.rate - rate) > RateError * rate)
  {
    throw std::invalid_argument(name + " has " + number(recording.rate) +
      " moments a second, but the servo loop runs at " + number(rate) +
      " Hz, a moment a tick: choose the recording's rate");
  }
  if (tool.shape == ToolShape::Hand)
  {
    try
    {
      requireHandJoints(recording);
    }
    catch (const std::invalid_argument& failure)
    {
      throw std::invalid_argument(name + " moves no hand: " + failure.what());
    }
  }
  return std::make_shared<ScriptedDevice>(std::move(recording));
}

std::shared_ptr<HapticDevice> openHid(const SceneDevice& device)
{
  if (!device.description.empty())
  {
    return openHidDevice(readHidDescription(device.description));
  }
  for (const HidRecord& record : listHidDevices())
  {
    const bool wanted = record.vendor == device.vendor && record.product == device.product;
    if (wanted || (device.vendor == 0 && kindOf(record) != HidKind::Unknown))
    {
      return openHidDevice(record);
    }
  }
  const std::string which = device.vendor == 0
    ? "a HID device that is known without a description"
    : "the HID device " + hexadecimal(device.vendor) + ":" + hexadecimal(device.product);
  throw std::runtime_error(which + " is not there: `palpate devices` lists those that are");
}
} // namespace palpate
