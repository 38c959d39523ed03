// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "loaded_scene.h"

#include "conversion.h"
#include "haptics/hid_bus.h"
#include "haptics/scripted_device.h"
#include "haptics/simulated_device.h"
#include "model_arrays.h"
#include "read_surface.h"

#include "vtkPolyData.h"

#include <filesystem>
#include <stdexcept>

namespace palpate
{
namespace
{
constexpr double DefaultFriction = 0.3, DefaultMaskEdges = 2;

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
  throw std::runtime_error("the HID device is not there: `palpate devices` lists those that are");
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
  scene.solver.solver.largestUpdates = 12;
  return { std::move(scene), {}, nullptr };
}

SceneBody bodyOf(vtkPolyData* model)
{
  const convert::ServedModel served = convert::servedModelOf(model);
  SceneBody body{ served.greens, served.mesh, served.smoothPatches };
  requireTouchable(body);
  return body;
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
  return { lookOf(tool, surface, reach), convert::soundMeshOf(surface) };
}

std::shared_ptr<HapticDevice> openDevice(const SceneDevice& device)
{
  switch (device.type)
  {
    case DeviceType::Scripted:
      return std::make_shared<ScriptedDevice>(readDeviceRecording(device.file));
    case DeviceType::Simulated:
      return std::make_shared<SimulatedDevice>(SimulatedDeviceSettings{});
    case DeviceType::Hid:
      return openHid(device);
    case DeviceType::Mouse:
      break;
  }
  throw std::logic_error("the mouse is not opened as a device");
}
} // namespace palpate
