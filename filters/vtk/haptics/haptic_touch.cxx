// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include "haptics/evaluation_plan.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate
{
namespace
{
constexpr double MouseSpeed = 3;           ///< diagonals of the body a second
constexpr double RecordedSeconds = 120;    ///< at most
constexpr double Unlimited = 1e9;          ///< a mouse hurts nobody
constexpr double Day = 86400;              ///< s
} // namespace

HapticTouch::HapticTouch()
  : Loaded(mouseScene())
{
}

HapticTouch::~HapticTouch()
{
  this->Stop();
}

/// The scene is another from now on.
void HapticTouch::Change()
{
  this->Stop();
  this->Loop.reset();
  this->Session.reset();
  this->Pointer.reset();
  this->FirstScript.reset();
  this->Recorder.reset();
  this->Latest = nullptr;
}

void HapticTouch::SetModel(vtkPolyData* model)
{
  if (!model)
  {
    throw std::invalid_argument("there is no model to touch");
  }
  std::vector<SceneBody> loaded{ bodyOf(model) };
  this->Change();
  this->Loaded.FirstModel = model;
  this->Loaded.Bodies = std::move(loaded);
  this->Described().models.resize(1);
  this->Described().models[0].file.clear();
}

void HapticTouch::LoadScene(const std::string& fileName)
{
  LoadedScene loaded = loadScene(fileName);
  this->Change();
  this->Loaded = std::move(loaded);
}

std::string HapticTouch::EvaluationPlan()
{
  if (this->Loaded.Bodies.empty())
  {
    throw std::invalid_argument("there is no model to plan for");
  }
  std::vector<BodySizes> sizes;
  for (const SceneBody& body : this->Loaded.Bodies)
  {
    sizes.push_back(sizesOf(body, this->Described()));
  }
  return toText(planEvaluation(this->Described(), sizes));
}

void HapticTouch::SetTool(double radius)
{
  this->Change();
  this->Described().tools.resize(1);
  SceneTool& tool = this->Described().tools[0];
  tool.shape = radius > 0 ? ToolShape::Sphere : ToolShape::Point;
  tool.radius = radius;
  this->Described().effects.unilateral = radius > 0;
}

void HapticTouch::SetDevice(const SceneDevice& device)
{
  this->Change();
  SceneDevice& first = this->Described().devices[this->Described().tools[0].device];
  const SceneDevice before = first;
  first = device;
  first.name = before.name;
  if (device.type == DeviceType::Scripted)
  {
    first.mapping = before.mapping; // recordings are in their device's frame
  }
}

void HapticTouch::SetRate(double rate)
{
  if (!(rate >= 250 && rate <= 10000))
  {
    throw std::invalid_argument(
      "the servo rate must be between 250 and 10000 Hz, not " + std::to_string(rate));
  }
  this->Change();
  this->Described().servo.rate = rate;
}

void HapticTouch::SetDeformation(DeformationRows rows)
{
  if (rows == this->Described().effects.deformation)
  {
    return;
  }
  this->Change();
  this->Described().effects.deformation = rows;
}

void HapticTouch::SetRecordFile(const std::string& fileName)
{
  this->Change(); // a device that is open already is not recorded
  this->RecordFile = fileName;
}

void HapticTouch::Reset()
{
  if (this->Loop)
  {
    this->Loop->reset();
  }
}

vtkPolyData* HapticTouch::Touched() const
{
  return this->Loaded.FirstModel;
}

/// The mouse, or a device that must be opened.
std::shared_ptr<HapticDevice> HapticTouch::Open(const SceneDevice& device)
{
  if (device.type != DeviceType::Mouse)
  {
    auto opened = openDevice(device);
    const auto script = std::dynamic_pointer_cast<ScriptedDevice>(opened);
    if (script && !this->FirstScript)
    {
      this->FirstScript = script;
    }
    return opened;
  }
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
  std::vector<std::shared_ptr<const SurfaceMesh>> meshes(this->Described().tools.size());
  this->Change(); // what is left of an attempt that failed
  this->Looks.clear();
  this->Silent.clear();
  std::vector<ServoTool> hands;
  for (std::size_t t = 0; t < this->Described().tools.size(); ++t)
  {
    LoadedTool tool =
      loadTool(this->Described().tools[t], this->Loaded.Bodies[0].mesh->diagonal());
    this->Looks.push_back(std::move(tool.Look));
    meshes[t] = std::move(tool.Mesh);
    const SceneDevice& described = this->Described().devices[this->Described().tools[t].device];
    ServoTool hand;
    hand.device = this->Open(described);
    hand.mapping = described.mapping;
    this->Silent.push_back(
      described.type != DeviceType::Mouse && hand.device->info().largestForce == 0);
    if (described.type == DeviceType::Mouse)
    {
      hand.safety.largestForce = hand.safety.largestTorque = hand.safety.forceSlew =
        hand.safety.torqueSlew = hand.safety.largestSpeed = hand.safety.largestTurning =
          hand.safety.largestReach = Unlimited;
    }
    if (t == 0 && !this->RecordFile.empty())
    {
      this->Recorder = std::make_shared<RecordingDevice>(hand.device,
        static_cast<std::size_t>(RecordedSeconds * this->Described().servo.rate));
      hand.device = this->Recorder;
    }
    hands.push_back(std::move(hand));
  }
  this->Session = std::make_unique<TouchSession>(this->Described(), this->Loaded.Bodies, meshes);
  this->None.setZero(3, this->Loaded.Bodies[0].mesh->vertexCount());
  this->Loop =
    std::make_unique<ServoLoop>(this->Session->model(), hands, this->Described().servo);
}

void HapticTouch::Start()
{
  this->Prepare();
  this->Loop->start();
}

void HapticTouch::Stop()
{
  if (this->Loop)
  {
    this->Loop->stop();
  }
}

void HapticTouch::RunHeadless(double seconds)
{
  if (!(seconds >= 0 && seconds <= Day))
  {
    throw std::invalid_argument(
      "the time to run must be from 0 to 86400 s, not " + std::to_string(seconds));
  }
  this->Prepare();
  this->Loop->runHeadless(std::llround(seconds * this->Described().servo.rate));
}

void HapticTouch::WriteRecording()
{
  if (this->Recorder && !this->RecordFile.empty())
  {
    writeDeviceRecording(this->Recorder->recording(), this->RecordFile);
  }
}

bool HapticTouch::Update()
{
  if (!this->Loop)
  {
    return false;
  }
  this->Loop->update();
  this->Latest = &this->Loop->latest();
  return !this->Latest->contact.tools.empty();
}

void HapticTouch::ComputeFrame(const std::vector<std::vector<int>>& visible)
{
  this->Session->computeFrame(this->Latest->contact, visible);
}

const Eigen::Matrix3Xd& HapticTouch::Displacement(int body) const
{
  return this->Session->deforms() ? this->Session->displacement(body) : this->None;
}

MouseDevice& HapticTouch::Mouse()
{
  if (!this->Pointer)
  {
    throw std::logic_error("no tool of this scene is moved by the mouse");
  }
  return *this->Pointer;
}

double HapticTouch::PointerReach() const
{
  for (const SceneTool& tool : this->Described().tools)
  {
    if (this->Described().devices[tool.device].type == DeviceType::Mouse)
    {
      return tool.radius;
    }
  }
  return 0;
}
} // namespace palpate
