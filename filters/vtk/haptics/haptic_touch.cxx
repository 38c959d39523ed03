// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include "contact/unilateral_contact_settings.h"
#include "haptics/evaluation_plan.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace palpate
{
namespace
{
constexpr double Day = 86400; ///< s
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

std::string HapticTouch::EvaluationPlan(const ProgressCallback& progress)
{
  if (this->Loaded.Bodies.empty())
  {
    throw std::invalid_argument("there is no model to plan for");
  }
  this->RequireRunnable();
  std::vector<std::shared_ptr<const SurfaceMesh>> tools;
  for (const SceneTool& tool : this->Described().tools)
  {
    tools.push_back(loadTool(tool, this->Loaded.Bodies[0].mesh->diagonal()).Mesh);
  }
  return toText(planEvaluation(this->Described(), this->Loaded.Bodies, {}, tools, Progress(progress)));
}

void HapticTouch::SetTool(double radius)
{
  const bool isPoint = radius == 0;
  std::vector<SceneTool>& tools = this->Described().tools;
  if (isPoint != this->Described().isOfPoints())
  {
    if (tools.size() > 1)
    {
      throw std::invalid_argument("points and tools with a shape do not touch a surface together: the "
                                  "scene has further tools");
    }
    if (this->Described().models.size() > 1)
    {
      throw std::invalid_argument("a point touches one model, and the scene has several");
    }
    this->Described().effects.unilateral = !isPoint;
  }
  this->Change();
  SceneTool tool;
  tool.shape = isPoint ? ToolShape::Point : ToolShape::Sphere;
  tool.radius = radius;
  tool.device = tools[0].device;
  tools[0] = tool;
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

void HapticTouch::SetContactCapacity(int capacity)
{
  constexpr int most = UnilateralContactSettings::kMostContacts;
  if (capacity < 0 || capacity > most)
  {
    throw std::invalid_argument("there may be from 1 to " + std::to_string(most) +
      " contacts, or 0 to choose their number by the model, not " + std::to_string(capacity));
  }
  this->Change();
  this->Described().solver.capacity = capacity;
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

void HapticTouch::SetSafety(const SafetySettings& safety)
{
  ForceSafety(safety, 1 / this->Described().servo.rate); // refuses what makes no sense
  this->Change();
  this->Described().safety = safety;
}

void HapticTouch::SetRecordFile(const std::string& fileName)
{
  const std::filesystem::path file(fileName), folder = file.parent_path();
  if (std::filesystem::is_directory(file))
  {
    throw std::invalid_argument("cannot record to '" + fileName + "': it is a folder");
  }
  if (!folder.empty() && !std::filesystem::is_directory(folder))
  {
    throw std::invalid_argument(
      "cannot record to '" + fileName + "': there is no folder '" + folder.string() + "'");
  }
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

std::vector<std::string> HapticTouch::Warnings() const
{
  if (!this->Session)
  {
    return {};
  }
  std::vector<std::string> warnings = this->Cautions;
  if (this->Recorder && !this->IsRunning() && this->Recorder->leftOut() > 0)
  {
    char line[128];
    std::snprintf(line, sizeof line,
      "the recording holds the first %g s: the %g s after them are left out", RecordedSeconds,
      static_cast<double>(this->Recorder->leftOut()) / this->Described().servo.rate);
    warnings.emplace_back(line);
  }
  return warnings;
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

const Eigen::Matrix3Xd& HapticTouch::ProbeDisplacements() const
{
  return this->Session ? this->Session->probeDisplacements() : this->NoProbes;
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
