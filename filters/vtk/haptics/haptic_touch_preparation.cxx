// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include "haptics/hid_description.h"
#include "haptics/pressing_hand.h"

#include <stdexcept>

// Devices, tools, session and loop of a scene.
namespace palpate
{
namespace
{
constexpr double MouseSpeed = 3;   ///< diagonals of the body a second
constexpr double Unlimited = 1e9;  ///< a mouse hurts nobody
} // namespace

/// What moves a tool.
/// @param mesh  the tool's, if it is one.
std::shared_ptr<HapticDevice> HapticTouch::Open(const SceneTool& tool, const SurfaceMesh* mesh)
{
  const SceneDevice& device = this->Described().devices[tool.device];
  const double rate = this->Described().servo.rate;
  if (device.type == DeviceType::Mouse)
  {
    return this->OpenMouse();
  }
  if (device.type == DeviceType::Hid)
  {
    return openHid(device);
  }
  if (device.type == DeviceType::Simulated)
  {
    return pressingDevice(
      planPress(this->Loaded.Bodies[0], tool, mesh, this->Pressed), device.mapping, 1 / rate);
  }
  const auto script = openScript(device, tool, rate);
  if (!this->FirstScript)
  {
    this->FirstScript = script;
  }
  return script;
}

std::shared_ptr<HapticDevice> HapticTouch::OpenMouse()
{
  if (this->Pointer)
  {
    throw std::invalid_argument("there is one mouse: it can move one tool only");
  }
  const SurfaceMesh& mesh = *this->Loaded.Bodies[0].mesh;
  this->Pointer = std::make_shared<MouseDevice>(
    1 / this->Described().servo.rate, MouseSpeed * mesh.diagonal());
  this->PointerPose.position = mesh.points().rowwise().maxCoeff().array() + mesh.diagonal();
  this->Pointer->PutAtOnce(this->PointerPose);
  return this->Pointer;
}

/// Their looks are kept.
/// @return the meshes of those that are one.
std::vector<std::shared_ptr<const SurfaceMesh>> HapticTouch::LoadTools()
{
  std::vector<std::shared_ptr<const SurfaceMesh>> meshes;
  this->Looks.clear();
  for (const SceneTool& described : this->Described().tools)
  {
    LoadedTool tool = loadTool(described, this->Loaded.Bodies[0].mesh->diagonal());
    this->Looks.push_back(std::move(tool.Look));
    meshes.push_back(std::move(tool.Mesh));
  }
  return meshes;
}

/// A tool's device, and what may be done to the hand that holds it.
ServoTool HapticTouch::OpenHand(const SceneTool& tool, const SurfaceMesh* mesh)
{
  const SceneDevice& described = this->Described().devices[tool.device];
  ServoTool hand;
  hand.device = this->Open(tool, mesh);
  hand.mapping = described.mapping;
  hand.safety = this->Described().safety;
  if (described.type == DeviceType::Mouse)
  {
    hand.safety.largestForce = hand.safety.largestTorque = hand.safety.forceSlew =
      hand.safety.torqueSlew = hand.safety.largestSpeed = hand.safety.largestTurning =
        hand.safety.largestReach = Unlimited;
  }
  return hand;
}

void HapticTouch::BeginSession(const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes)
{
  this->Loaded.Bodies[0].probeRows = rowsOfProbesInside(this->Described(), this->Loaded.Bodies[0]);
  this->Session = std::make_unique<TouchSession>(this->Described(), this->Loaded.Bodies, meshes);
}

void HapticTouch::Prepare()
{
  if (this->Loop)
  {
    return;
  }
  if (this->Loaded.Bodies.empty())
  {
    throw std::invalid_argument("there is no model to touch: set one or load a scene");
  }
  this->Change(); // what is left of an attempt that failed
  this->Silent.clear();
  this->Pressed.clear();
  const auto meshes = this->LoadTools();
  std::vector<ServoTool> hands;
  for (std::size_t t = 0; t < meshes.size(); ++t)
  {
    const SceneTool& tool = this->Described().tools[t];
    ServoTool hand = this->OpenHand(tool, meshes[t].get());
    this->Silent.push_back(this->Described().devices[tool.device].type != DeviceType::Mouse &&
      hand.device->info().largestForce == 0);
    if (t == 0 && !this->RecordFile.empty())
    {
      this->Recorder = std::make_shared<RecordingDevice>(hand.device,
        static_cast<std::size_t>(RecordedSeconds * this->Described().servo.rate),
        this->Described().servo.rate);
      hand.device = this->Recorder;
    }
    hands.push_back(std::move(hand));
  }
  this->BeginSession(meshes);
  this->Cautions = warningsOf(this->Described(), this->Loaded.Bodies);
  this->BoundStiffness(hands, meshes);
  this->None.setZero(3, this->Loaded.Bodies[0].mesh->vertexCount());
  this->Loop =
    std::make_unique<ServoLoop>(this->Session->model(), hands, this->Described().servo);
}

/// Refuses what Prepare would, but for HID devices that are not there: a plan needs none.
void HapticTouch::RequireRunnable()
{
  if (this->Loop)
  {
    return;
  }
  this->Change();
  this->Pressed.clear();
  const auto meshes = this->LoadTools();
  for (std::size_t t = 0; t < meshes.size(); ++t)
  {
    const SceneTool& tool = this->Described().tools[t];
    const SceneDevice& device = this->Described().devices[tool.device];
    if (device.type != DeviceType::Hid)
    {
      this->Open(tool, meshes[t].get());
    }
    else if (!device.description.empty())
    {
      readHidDescription(device.description);
    }
  }
  this->BeginSession(meshes);
  this->Change(); // nothing of it is kept
}
} // namespace palpate
