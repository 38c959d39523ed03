// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include "conversion.h"
#include "haptics/evaluation_plan.h"
#include "haptics/hid_bus.h"
#include "haptics/point_touch.h"
#include "haptics/simulated_device.h"
#include "haptics/tool_touch.h"
#include "model_arrays.h"

#include "vtkCallbackCommand.h"
#include "vtkElasticSurfaceReader.h"
#include "vtkExecutive.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace palpate
{
namespace
{
constexpr double DefaultFriction = 0.3, DefaultMaskEdges = 2;
constexpr double MouseSpeed = 3;           ///< diagonals of the body a second
constexpr double RecordedSeconds = 120;    ///< at most
constexpr double Unlimited = 1e9;          ///< a mouse hurts nobody

Scene mouseScene()
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
  return scene;
}

vtkSmartPointer<vtkPolyData> readSurface(const std::string& path)
{
  vtkNew<vtkElasticSurfaceReader> reader;
  vtkNew<vtkCallbackCommand> nothing;
  nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  reader->AddObserver(vtkCommand::ErrorEvent, nothing);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, nothing);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (*reader->GetFailureMessage())
  {
    throw std::runtime_error(reader->GetFailureMessage());
  }
  return reader->GetOutput();
}

SceneBody bodyOf(vtkPolyData* surface)
{
  const convert::ServedModel served = convert::servedModelOf(surface);
  return { served.greens, served.mesh, served.smoothPatches };
}

vtkSmartPointer<vtkPolyData> ball(double radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(32);
  source->SetPhiResolution(24);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> square(double half)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-half, -half, 0);
  source->SetPoint1(half, -half, 0);
  source->SetPoint2(-half, half, 0);
  source->Update();
  return source->GetOutput();
}

std::string text(const char* format, double value)
{
  char line[64];
  std::snprintf(line, sizeof line, format, value);
  return line;
}

/// With the prefix of thousands that leaves one to three digits before the point.
std::string engineering(double value, const char* unit)
{
  static const char* const prefixes[] = { "p", "n", "u", "m", "", "k", "M", "G" };
  int exponent = value > 0 ? static_cast<int>(std::floor(std::log10(value) / 3)) : 0;
  exponent = std::clamp(exponent, -4, 3);
  return text("%.3g ", value * std::pow(1000.0, -exponent)) + prefixes[exponent + 4] + unit;
}
} // namespace

HapticTouch::HapticTouch()
  : Described(mouseScene())
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
  this->Latest = {};
  this->Largest = 1e-12;
}

void HapticTouch::SetModel(vtkPolyData* model)
{
  if (!model)
  {
    throw std::invalid_argument("there is no model to touch");
  }
  std::vector<SceneBody> loaded{ bodyOf(model) };
  this->Change();
  this->FirstModel = model;
  this->Loaded = std::move(loaded);
  this->Described.models.resize(1);
  this->Described.models[0].file.clear();
}

void HapticTouch::LoadScene(const std::string& fileName)
{
  palpate::Scene scene = readScene(fileName);
  std::vector<SceneBody> loaded;
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  for (const SceneModel& model : scene.models)
  {
    surfaces.push_back(readSurface(model.file));
    loaded.push_back(bodyOf(surfaces.back()));
  }
  this->Change();
  this->FirstModel = surfaces[0];
  this->Described = std::move(scene);
  this->Loaded = std::move(loaded);
}

std::string HapticTouch::EvaluationPlan()
{
  if (this->Loaded.empty())
  {
    throw std::invalid_argument("there is no model to plan for");
  }
  std::vector<BodySizes> sizes;
  for (const SceneBody& body : this->Loaded)
  {
    sizes.push_back(sizesOf(body, this->Described));
  }
  return toText(planEvaluation(this->Described, sizes));
}

void HapticTouch::SetTool(double radius)
{
  this->Change();
  this->Described.tools.resize(1);
  SceneTool& tool = this->Described.tools[0];
  tool.shape = radius > 0 ? ToolShape::Sphere : ToolShape::Point;
  tool.radius = radius;
  this->Described.effects.unilateral = radius > 0;
}

void HapticTouch::SetDevice(const SceneDevice& device)
{
  this->Change();
  SceneDevice& first = this->Described.devices[this->Described.tools[0].device];
  const std::string name = first.name;
  first = device;
  first.name = name;
}

void HapticTouch::SetRate(double rate)
{
  if (!(rate >= 250 && rate <= 10000))
  {
    throw std::invalid_argument(
      "the servo rate must be between 250 and 10000 Hz, not " + std::to_string(rate));
  }
  this->Change();
  this->Described.servo.rate = rate;
}

void HapticTouch::SetDeformation(DeformationRows rows)
{
  if (rows == this->Described.effects.deformation)
  {
    return;
  }
  this->Change();
  this->Described.effects.deformation = rows;
}

void HapticTouch::SetRecordFile(const std::string& fileName)
{
  this->Change(); // a device that is open already is not recorded
  this->RecordFile = fileName;
}

void HapticTouch::SetFriction(double mu)
{
  if (!(mu >= 0) || !std::isfinite(mu))
  {
    throw std::invalid_argument("friction must not be negative, as " + std::to_string(mu) + " is");
  }
  this->Described.effects.friction = mu;
  if (!this->Session)
  {
    return;
  }
  if (auto* points = dynamic_cast<PointTouch*>(this->Session->model().get()))
  {
    points->setFriction(mu);
  }
  else
  {
    this->Loop->post(
      [mu](TouchModel& model) noexcept { static_cast<ToolTouch&>(model).setFriction(mu); });
  }
}

std::shared_ptr<const SurfaceStiffness> HapticTouch::NewStiffness() const
{
  const SceneEffects& effects = this->Described.effects;
  const double modulus = this->Loaded[0].greens->info().material.youngsModulus();
  return std::make_shared<const SurfaceStiffness>(
    this->Loaded[0].greens->withYoungsModulus(modulus * effects.stiffnessScale),
    this->Loaded[0].mesh, effects.maskShape, this->MaskRadius(), effects.stiffnessLimit);
}

void HapticTouch::SetMaskRadius(double radius)
{
  if (!(radius >= 0) || !std::isfinite(radius))
  {
    throw std::invalid_argument(
      "the radius of a mask must not be negative, as " + std::to_string(radius) + " is");
  }
  this->Described.effects.maskRadius = radius;
  this->Described.effects.maskRadiusEdges = 0;
  if (auto* points = this->Session ? dynamic_cast<PointTouch*>(this->Session->model().get()) : nullptr)
  {
    points->setStiffness(this->NewStiffness());
  }
}

void HapticTouch::SetStiffnessScale(double scale)
{
  if (!(scale > 0) || !std::isfinite(scale))
  {
    throw std::invalid_argument("a stiffness scale must be positive, not " + std::to_string(scale));
  }
  this->Described.effects.stiffnessScale = scale;
  if (!this->Session)
  {
    return;
  }
  this->Session->setStiffnessScale(scale);
  if (auto* points = dynamic_cast<PointTouch*>(this->Session->model().get()))
  {
    const double modulus = this->Loaded[0].greens->info().material.youngsModulus();
    points->setStiffness(points->stiffness()->withYoungsModulus(modulus * scale));
  }
  else
  {
    this->Loop->post([scale](TouchModel& model) noexcept
      { static_cast<ToolTouch&>(model).setStiffnessScale(scale); });
  }
}

void HapticTouch::SetRigidStiffness(double stiffness)
{
  if (!(stiffness >= 0) || !std::isfinite(stiffness))
  {
    throw std::invalid_argument(
      "the rigid stiffness must not be negative, as " + std::to_string(stiffness) + " is");
  }
  this->Described.effects.stiffnessLimit = stiffness;
  if (auto* points = this->Session ? dynamic_cast<PointTouch*>(this->Session->model().get()) : nullptr)
  {
    points->setStiffness(points->stiffness()->withRigidStiffness(stiffness));
  }
}

void HapticTouch::Reset()
{
  if (this->Loop)
  {
    this->Loop->reset();
  }
}

double HapticTouch::MeanEdge() const
{
  return this->Loaded.empty() ? 0 : this->Loaded[0].mesh->meanEdgeLength();
}

double HapticTouch::MaskRadius() const
{
  const SceneEffects& effects = this->Described.effects;
  return effects.maskRadiusEdges > 0 ? effects.maskRadiusEdges * this->MeanEdge()
                                     : effects.maskRadius;
}

std::shared_ptr<HapticDevice> HapticTouch::Open(const SceneDevice& device)
{
  switch (device.type)
  {
    case DeviceType::Mouse:
      if (this->Pointer)
      {
        throw std::invalid_argument("there is one mouse: it can move one tool only");
      }
      this->Pointer = std::make_shared<MouseDevice>(
        1 / this->Described.servo.rate, MouseSpeed * this->Loaded[0].mesh->diagonal());
      this->PointerPose.position =
        this->Loaded[0].mesh->points().rowwise().maxCoeff().array() + this->Loaded[0].mesh->diagonal();
      this->Pointer->PutAtOnce(this->PointerPose);
      return this->Pointer;
    case DeviceType::Scripted:
    {
      auto script = std::make_shared<ScriptedDevice>(readDeviceRecording(device.file));
      if (!this->FirstScript)
      {
        this->FirstScript = script;
      }
      return script;
    }
    case DeviceType::Simulated:
      return std::make_shared<SimulatedDevice>(SimulatedDeviceSettings{});
    case DeviceType::Hid:
      break;
  }
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

ToolLook HapticTouch::LookOf(
  const SceneTool& tool, std::shared_ptr<const SurfaceMesh>& mesh) const
{
  const auto rigid = [](vtkSmartPointer<vtkPolyData> surface)
  {
    return ToolLook{ { std::move(surface) }, [](const ToolPose& pose, RigidPose* poses)
      { poses[0] = { pose.position, pose.orientation }; } };
  };
  switch (tool.shape)
  {
    case ToolShape::Sphere:
      return rigid(ball(tool.radius));
    case ToolShape::Capsule:
      return rigid(capsuleSurface(tool.radius, tool.length));
    case ToolShape::Plane:
      return rigid(square(this->Loaded[0].mesh->diagonal()));
    case ToolShape::Mesh:
    {
      vtkSmartPointer<vtkPolyData> surface = readSurface(tool.file);
      mesh = convert::soundMeshOf(surface);
      return rigid(surface);
    }
    case ToolShape::Hand:
      return lookOf(HandModel(tool.length, tool.side));
    case ToolShape::Point:
      break;
  }
  return {};
}

void HapticTouch::Prepare()
{
  if (this->Loop)
  {
    return;
  }
  if (this->Loaded.empty())
  {
    throw std::invalid_argument("there is no model to touch: set one or load a scene");
  }
  std::vector<std::shared_ptr<const SurfaceMesh>> meshes(this->Described.tools.size());
  this->Change(); // what is left of an attempt that failed
  this->Looks.clear();
  std::vector<ServoTool> hands;
  for (std::size_t t = 0; t < this->Described.tools.size(); ++t)
  {
    this->Looks.push_back(this->LookOf(this->Described.tools[t], meshes[t]));
    const SceneDevice& described = this->Described.devices[this->Described.tools[t].device];
    ServoTool hand;
    hand.device = this->Open(described);
    hand.mapping = described.mapping;
    if (described.type == DeviceType::Mouse)
    {
      hand.safety.largestForce = hand.safety.largestTorque = hand.safety.forceSlew =
        hand.safety.torqueSlew = hand.safety.largestSpeed = hand.safety.largestTurning =
          hand.safety.largestReach = Unlimited;
    }
    if (t == 0 && !this->RecordFile.empty())
    {
      this->Recorder = std::make_shared<RecordingDevice>(hand.device,
        static_cast<std::size_t>(RecordedSeconds * this->Described.servo.rate));
      hand.device = this->Recorder;
    }
    hands.push_back(std::move(hand));
  }
  this->Session = std::make_unique<TouchSession>(this->Described, this->Loaded, meshes);
  this->None.setZero(3, this->Loaded[0].mesh->vertexCount());
  this->Loop =
    std::make_unique<ServoLoop>(this->Session->model(), hands, this->Described.servo);
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
  if (!(seconds >= 0) || !std::isfinite(seconds))
  {
    throw std::invalid_argument("the time to run must not be negative");
  }
  this->Prepare();
  this->Loop->runHeadless(std::llround(seconds * this->Described.servo.rate));
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
  this->Latest = this->Loop->latest();
  for (const ToolContact& contact : this->Latest.contact.tools)
  {
    this->Largest = std::max(this->Largest, contact.wrench.force.norm());
  }
  return !this->Latest.contact.tools.empty();
}

void HapticTouch::ComputeFrame(const std::vector<std::vector<int>>& visible)
{
  this->Session->computeFrame(this->Latest.contact, visible);
}

const Eigen::Matrix3Xd& HapticTouch::Displacement(int body) const
{
  return this->Session->deforms() ? this->Session->displacement(body) : this->None;
}

const ToolContact& HapticTouch::Contact(int tool) const
{
  static const ToolContact nothing;
  const auto& tools = this->Latest.contact.tools;
  return tool >= 0 && tool < static_cast<int>(tools.size()) ? tools[tool] : nothing;
}

Wrench HapticTouch::Rendered(int tool) const
{
  const auto& tools = this->Latest.tools;
  return tool >= 0 && tool < static_cast<int>(tools.size())
    ? tools[tool].rendered
    : Wrench{ Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
}

std::string HapticTouch::Fault(int tool) const
{
  const auto& tools = this->Latest.tools;
  const bool there = tool >= 0 && tool < static_cast<int>(tools.size());
  return there && tools[tool].safety.fault != palpate::Fault::None
    ? palpate::describe(tools[tool].safety.fault)
    : "";
}

std::string HapticTouch::Status() const
{
  if (this->Latest.contact.tools.empty())
  {
    return "";
  }
  const SceneEffects& effects = this->Described.effects;
  std::string line = text("%.0f Hz", this->Described.servo.rate) + "  p99 " +
    engineering(this->TickTime(0.99), "s");
  for (std::size_t t = 0; t < this->Latest.contact.tools.size(); ++t)
  {
    const ToolContact& contact = this->Latest.contact.tools[t];
    line += "  " + engineering(contact.wrench.force.norm(), "N");
    line += contact.touching ? contact.sliding ? " slides" : " sticks" : " free";
    const std::string fault = this->Fault(static_cast<int>(t));
    line += fault.empty() ? "" : " (" + fault + ")";
  }
  const ContactCertificate& certificate = this->Latest.contact.certificate;
  line += "  residual " + text("%.0e", certificate.residual) + (certificate.budgetCut ? " cut" : "");
  line += "  mu " + text("%.2g", effects.friction);
  if (this->Described.isOfPoints())
  {
    line += "  mask " + engineering(this->MaskRadius(), "m");
  }
  return line + "  x" + text("%.2g", effects.stiffnessScale);
}

Eigen::VectorXd HapticTouch::StiffnessNorms() const
{
  const SurfaceStiffness stiffness(this->Loaded[0].greens, this->Loaded[0].mesh,
    this->Described.effects.maskShape, this->MaskRadius(), this->Described.effects.stiffnessLimit);
  Eigen::VectorXd norms(this->Loaded[0].mesh->vertexCount());
  for (int v = 0; v < norms.size(); ++v)
  {
    norms[v] = this->Loaded[0].greens->isFixed(v) ? NAN : stiffness.haptic(v).norm();
  }
  return norms;
}

std::int64_t HapticTouch::Ticks() const
{
  return this->Loop ? this->Loop->statistics().ticks.load() : 0;
}

std::int64_t HapticTouch::MissedTicks() const
{
  return this->Loop ? this->Loop->statistics().missedTicks.load() : 0;
}

double HapticTouch::TickTime(double share) const
{
  return this->Loop ? this->Loop->statistics().compute.quantile(share) : 0;
}

std::string HapticTouch::TimingTable() const
{
  return this->Loop ? this->Loop->statistics().table() : "";
}

std::vector<Wrench> HapticTouch::ForceTrace() const
{
  if (!this->FirstScript || this->IsRunning())
  {
    return {};
  }
  std::vector<Wrench> wrenches = this->FirstScript->wrenches();
  wrenches.resize(this->FirstScript->momentsRead());
  return wrenches;
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
  for (const SceneTool& tool : this->Described.tools)
  {
    if (this->Described.devices[tool.device].type == DeviceType::Mouse)
    {
      return tool.radius;
    }
  }
  return 0;
}
} // namespace palpate
