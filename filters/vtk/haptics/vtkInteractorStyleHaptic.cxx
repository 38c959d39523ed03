// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkInteractorStyleHaptic.h"

#include "haptic_touch.h"
#include "mouse_device.h"
#include "touch_view.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellPicker.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <exception>

vtkStandardNewMacro(vtkInteractorStyleHaptic);

namespace
{
constexpr double WheelStep = 0.004;   ///< diagonals of the body, a notch
constexpr double StartAbove = 0.01;   ///< diagonals, where the mouse's probe begins
constexpr double LiftedAbove = 0.05;  ///< diagonals, where it ends
constexpr double KeyFactor = 1.25;    ///< by which a key changes a setting
constexpr double FrictionStep = 0.05;
}

/// What touches, what draws it, and what the mouse is doing.
struct vtkInteractorStyleHaptic::Touch
{
  palpate::HapticTouch Session;
  palpate::TouchView View;
  bool Shown = false; ///< whether the view has this session's bodies
  bool ShowsStiffness = false;
  int Timer = -1;
  bool Dragging = false;
  Eigen::Vector3d Anchor; ///< on the surface, where the drag began
  Eigen::Vector3d Offset; ///< of the tool's position, from its place that is nearest to the surface
  double Depth = 0;       ///< along the view
  std::vector<char> Touched;
  std::vector<std::string> Faults;
};

vtkInteractorStyleHaptic::vtkInteractorStyleHaptic()
  : Internals(new Touch)
{
  this->AutoAdjustCameraClippingRange = 1;
}

vtkInteractorStyleHaptic::~vtkInteractorStyleHaptic()
{
  this->Internals->Session.Stop();
}

void vtkInteractorStyleHaptic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Running: " << this->IsRunning() << "\n"
     << indent << "Friction: " << this->GetFriction() << "\n"
     << indent << "MaskRadius: " << this->GetMaskRadius() << "\n"
     << indent << "StiffnessScale: " << this->GetStiffnessScale() << "\n"
     << indent << "RigidStiffness: " << this->GetRigidStiffness() << "\n"
     << indent << "Deformation: " << this->GetDeformation() << "\n"
     << indent << "ServoRate: " << this->GetServoRate() << "\n"
     << indent << "PressDepth: " << this->PressDepth << "\n"
     << indent << "FrameRate: " << this->FrameRate << "\n"
     << indent << "Status: " << this->GetStatus() << "\n"
     << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

/// Runs what may throw; false and a sentence if it did.
template <class Action>
bool vtkInteractorStyleHaptic::Try(const Action& action)
{
  this->FailureMessage.clear();
  try
  {
    action();
    return true;
  }
  catch (const std::exception& failure)
  {
    this->FailureMessage = failure.what();
    vtkErrorMacro(<< this->FailureMessage);
    return false;
  }
}

bool vtkInteractorStyleHaptic::SetModel(vtkPolyData* model)
{
  return this->Try(
    [&]
    {
      this->Internals->Session.SetModel(model);
      this->Internals->Shown = false;
    });
}

bool vtkInteractorStyleHaptic::LoadScene(const char* fileName)
{
  return this->Try(
    [&]
    {
      this->Internals->Session.LoadScene(fileName ? fileName : "");
      this->Internals->Shown = false;
    });
}

std::string vtkInteractorStyleHaptic::GetEvaluationPlan()
{
  std::string plan;
  this->Try([&] { plan = this->Internals->Session.EvaluationPlan(); });
  return plan;
}

bool vtkInteractorStyleHaptic::SetToolToPoint()
{
  return this->Try(
    [&]
    {
      this->Internals->Session.SetTool(0);
      this->Internals->Shown = false;
    });
}

bool vtkInteractorStyleHaptic::SetToolToSphere(double radius)
{
  return this->Try(
    [&]
    {
      if (!(radius > 0))
      {
        throw std::invalid_argument("the radius of a ball must be positive");
      }
      this->Internals->Session.SetTool(radius);
      this->Internals->Shown = false;
    });
}

bool vtkInteractorStyleHaptic::SetDeviceToMouse()
{
  return this->Try([&] { this->Internals->Session.SetDevice({}); });
}

bool vtkInteractorStyleHaptic::SetDeviceToScript(const char* fileName)
{
  return this->Try(
    [&]
    {
      palpate::SceneDevice device;
      device.type = palpate::DeviceType::Scripted;
      device.file = fileName ? fileName : "";
      this->Internals->Session.SetDevice(device);
    });
}

bool vtkInteractorStyleHaptic::SetDeviceToSimulated()
{
  return this->Try(
    [&]
    {
      palpate::SceneDevice device;
      device.type = palpate::DeviceType::Simulated;
      this->Internals->Session.SetDevice(device);
    });
}

bool vtkInteractorStyleHaptic::SetDeviceToHid(int vendor, int product)
{
  return this->Try(
    [&]
    {
      palpate::SceneDevice device;
      device.type = palpate::DeviceType::Hid;
      device.vendor = static_cast<std::uint16_t>(vendor);
      device.product = static_cast<std::uint16_t>(product);
      this->Internals->Session.SetDevice(device);
    });
}

bool vtkInteractorStyleHaptic::SetFriction(double mu)
{
  return this->Try([&] { this->Internals->Session.SetFriction(mu); });
}

double vtkInteractorStyleHaptic::GetFriction()
{
  return this->Internals->Session.Scene().effects.friction;
}

bool vtkInteractorStyleHaptic::SetMaskRadius(double radius)
{
  return this->Try([&] { this->Internals->Session.SetMaskRadius(radius); });
}

double vtkInteractorStyleHaptic::GetMaskRadius()
{
  return this->Internals->Session.MaskRadius();
}

bool vtkInteractorStyleHaptic::SetStiffnessScale(double scale)
{
  return this->Try([&] { this->Internals->Session.SetStiffnessScale(scale); });
}

double vtkInteractorStyleHaptic::GetStiffnessScale()
{
  return this->Internals->Session.Scene().effects.stiffnessScale;
}

bool vtkInteractorStyleHaptic::SetRigidStiffness(double stiffness)
{
  return this->Try([&] { this->Internals->Session.SetRigidStiffness(stiffness); });
}

double vtkInteractorStyleHaptic::GetRigidStiffness()
{
  return this->Internals->Session.Scene().effects.stiffnessLimit;
}

void vtkInteractorStyleHaptic::SetDeformation(int mode)
{
  this->Internals->Session.SetDeformation(static_cast<palpate::DeformationRows>(
    std::clamp(mode, static_cast<int>(DEFORM_ALL), static_cast<int>(DEFORM_NONE))));
  this->Modified();
}

int vtkInteractorStyleHaptic::GetDeformation()
{
  return static_cast<int>(this->Internals->Session.Scene().effects.deformation);
}

bool vtkInteractorStyleHaptic::SetServoRate(double rate)
{
  return this->Try([&] { this->Internals->Session.SetRate(rate); });
}

double vtkInteractorStyleHaptic::GetServoRate()
{
  return this->Internals->Session.Scene().servo.rate;
}

bool vtkInteractorStyleHaptic::SetRecordFileName(const char* fileName)
{
  return this->Try([&] { this->Internals->Session.SetRecordFile(fileName ? fileName : ""); });
}

void vtkInteractorStyleHaptic::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  if (!interactor)
  {
    this->ShowIn(nullptr);
  }
  this->Superclass::SetInteractor(interactor);
}

void vtkInteractorStyleHaptic::ShowIn(vtkRenderer* renderer)
{
  this->Internals->View.SetRenderer(renderer);
}

/// Devices, model and loop, and what draws them.
void vtkInteractorStyleHaptic::Prepare()
{
  Touch& touch = *this->Internals;
  touch.Session.Prepare();
  if (touch.Shown)
  {
    return;
  }
  touch.View.Clear();
  for (std::size_t body = 0; body < touch.Session.Bodies().size(); ++body)
  {
    touch.View.AddBody(
      touch.Session.Mesh(static_cast<int>(body)), touch.Session.Scene().models[body].pose);
  }
  for (std::size_t tool = 0; tool < touch.Session.Scene().tools.size(); ++tool)
  {
    touch.View.AddTool(touch.Session.Look(static_cast<int>(tool)));
  }
  touch.Touched.assign(touch.Session.Scene().tools.size(), false);
  touch.Faults.assign(touch.Session.Scene().tools.size(), "");
  touch.Shown = true;
  if (!this->Interactor)
  {
    return;
  }
  this->FindPokedRenderer(0, 0);
  this->ShowIn(this->CurrentRenderer);
  if (this->CurrentRenderer)
  {
    this->CurrentRenderer->ResetCamera(touch.View.Surface(0)->GetBounds());
  }
}

bool vtkInteractorStyleHaptic::Start()
{
  return this->Try(
    [&]
    {
      this->Prepare();
      this->Internals->Session.Start();
      if (this->Interactor && this->Interactor->GetInitialized() && this->Internals->Timer < 0)
      {
        this->Internals->Timer = this->Interactor->CreateRepeatingTimer(
          static_cast<unsigned long>(std::max(1.0, 1000 / this->FrameRate)));
      }
    });
}

bool vtkInteractorStyleHaptic::Stop()
{
  if (this->Internals->Timer >= 0 && this->Interactor)
  {
    this->Interactor->DestroyTimer(this->Internals->Timer);
  }
  this->Internals->Timer = -1;
  return this->Try(
    [&]
    {
      this->Internals->Session.Stop();
      this->Internals->Session.WriteRecording();
    });
}

bool vtkInteractorStyleHaptic::IsRunning()
{
  return this->Internals->Session.IsRunning();
}

bool vtkInteractorStyleHaptic::RunHeadless(double seconds)
{
  return this->Try(
    [&]
    {
      this->Prepare();
      this->Internals->Session.RunHeadless(seconds);
      this->Update();
    });
}

void vtkInteractorStyleHaptic::Update()
{
  Touch& touch = *this->Internals;
  if (!touch.Shown || !touch.Session.Update())
  {
    return;
  }
  std::vector<std::vector<int>> visible;
  if (this->GetDeformation() == DEFORM_VISIBLE && this->CurrentRenderer)
  {
    for (int body = 0; body < touch.View.NumberOfBodies(); ++body)
    {
      visible.push_back(
        touch.View.FacingNodes(body, this->CurrentRenderer->GetActiveCamera()));
    }
  }
  touch.Session.ComputeFrame(visible);
  for (int body = 0; body < touch.View.NumberOfBodies(); ++body)
  {
    touch.View.Deform(body, touch.Session.Displacement(body));
  }
  touch.View.Show(touch.Session.Snapshot(), touch.Session.LargestForce());
  touch.View.SetStatus(touch.Session.Status());
  this->Announce();
}

/// Invokes events for what has changed since the last update.
void vtkInteractorStyleHaptic::Announce()
{
  Touch& touch = *this->Internals;
  for (std::size_t tool = 0; tool < touch.Touched.size(); ++tool)
  {
    const bool touches = touch.Session.Snapshot().contact.tools[tool].touching;
    const std::string fault = touch.Session.Fault(static_cast<int>(tool));
    const bool began = touches && !touch.Touched[tool], ended = !touches && touch.Touched[tool];
    const bool failed = !fault.empty() && fault != touch.Faults[tool];
    touch.Touched[tool] = touches;
    touch.Faults[tool] = fault;
    int number = static_cast<int>(tool);
    if (began || ended)
    {
      this->InvokeEvent(began ? ContactBeginEvent : ContactEndEvent, &number);
    }
    if (failed)
    {
      this->InvokeEvent(FaultEvent, &number);
    }
  }
}

void vtkInteractorStyleHaptic::Render()
{
  if (this->Interactor && this->Interactor->GetRenderWindow())
  {
    this->Interactor->GetRenderWindow()->Render();
  }
}

void vtkInteractorStyleHaptic::OnTimer()
{
  this->Superclass::OnTimer();
  if (this->IsRunning())
  {
    this->Update();
    this->Render();
  }
}

bool vtkInteractorStyleHaptic::MoveProbe(double x, double y, double z, bool adheres)
{
  return this->Try(
    [&]
    {
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      {
        throw std::invalid_argument("the probe's place must be three finite numbers");
      }
      this->Prepare();
      palpate::ToolPose pose;
      pose.position = { x, y, z };
      pose.buttons = adheres ? 1 : 0;
      this->Internals->Session.Mouse().Put(pose);
    });
}

void vtkInteractorStyleHaptic::OnLeftButtonDown()
{
  Touch& touch = *this->Internals;
  const int* at = this->Interactor->GetEventPosition();
  this->FindPokedRenderer(at[0], at[1]);
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0.001);
  const bool onBody = touch.Shown && touch.Session.HasMouse() && this->CurrentRenderer &&
    picker->Pick(at[0], at[1], 0, this->CurrentRenderer);
  if (!onBody)
  {
    this->Superclass::OnLeftButtonDown(); // beside the surface the left button turns the camera
    return;
  }
  touch.Anchor = Eigen::Vector3d(picker->GetPickPosition());
  touch.Offset = touch.Session.PointerReach() * Eigen::Vector3d(picker->GetPickNormal());
  touch.Dragging = true;
  touch.Depth = -StartAbove * touch.View.Diagonal();
  this->Drag();
  touch.Session.Mouse().PutAtOnce(touch.Session.MousePose());
  touch.Session.Reset(); // or the jump would be a way through the body
  touch.Depth = this->PressDepth * touch.View.Diagonal();
  this->Drag();
  this->GrabFocus(this->EventCallbackCommand);
}

/// Puts the probe below the pointer, at the drag's depth behind the plane through its beginning.
void vtkInteractorStyleHaptic::Drag()
{
  Touch& touch = *this->Internals;
  const int* at = this->Interactor->GetEventPosition();
  double display[3], world[4];
  this->ComputeWorldToDisplay(touch.Anchor.x(), touch.Anchor.y(), touch.Anchor.z(), display);
  this->ComputeDisplayToWorld(at[0], at[1], display[2], world);
  Eigen::Vector3d away;
  this->CurrentRenderer->GetActiveCamera()->GetDirectionOfProjection(away.data());
  palpate::ToolPose pose;
  pose.position = Eigen::Vector3d(world) + touch.Offset + touch.Depth * away;
  pose.buttons = this->Interactor->GetControlKey() ? 1 : 0;
  touch.Session.Mouse().Put(pose);
  touch.Session.SetMousePose(pose);
}

void vtkInteractorStyleHaptic::OnMouseMove()
{
  if (this->Internals->Dragging)
  {
    this->Drag();
    return;
  }
  this->Superclass::OnMouseMove();
}

void vtkInteractorStyleHaptic::OnLeftButtonUp()
{
  Touch& touch = *this->Internals;
  if (!touch.Dragging)
  {
    this->Superclass::OnLeftButtonUp();
    return;
  }
  touch.Depth = -LiftedAbove * touch.View.Diagonal();
  this->Drag();
  touch.Dragging = false;
  this->ReleaseFocus();
}

void vtkInteractorStyleHaptic::OnRightButtonDown()
{
  this->FindPokedRenderer(
    this->Interactor->GetEventPosition()[0], this->Interactor->GetEventPosition()[1]);
  if (this->CurrentRenderer)
  {
    this->GrabFocus(this->EventCallbackCommand);
    this->StartRotate();
  }
}

void vtkInteractorStyleHaptic::OnRightButtonUp()
{
  if (this->State == VTKIS_ROTATE)
  {
    this->EndRotate();
    this->ReleaseFocus();
  }
}

void vtkInteractorStyleHaptic::TurnWheel(double notches)
{
  this->Internals->Depth += notches * WheelStep * this->Internals->View.Diagonal();
  this->Drag();
}

void vtkInteractorStyleHaptic::OnMouseWheelForward()
{
  this->Internals->Dragging ? this->TurnWheel(1) : this->Superclass::OnMouseWheelForward();
}

void vtkInteractorStyleHaptic::OnMouseWheelBackward()
{
  this->Internals->Dragging ? this->TurnWheel(-1) : this->Superclass::OnMouseWheelBackward();
}

void vtkInteractorStyleHaptic::OnChar()
{
  Touch& touch = *this->Internals;
  if (!touch.Shown)
  {
    this->Superclass::OnChar();
    return;
  }
  switch (this->Interactor->GetKeyCode())
  {
    case '[':
      this->SetFriction(std::max(0.0, this->GetFriction() - FrictionStep));
      break;
    case ']':
      this->SetFriction(this->GetFriction() + FrictionStep);
      break;
    case ',':
      this->SetMaskRadius(this->GetMaskRadius() / KeyFactor);
      break;
    case '.':
      this->SetMaskRadius(this->GetMaskRadius() * KeyFactor);
      break;
    case '-':
      this->SetStiffnessScale(this->GetStiffnessScale() / KeyFactor);
      break;
    case '+':
    case '=':
      this->SetStiffnessScale(this->GetStiffnessScale() * KeyFactor);
      break;
    case 'w':
    case 's':
      touch.View.SetWireframe(this->Interactor->GetKeyCode() == 'w');
      break;
    case 'v':
      touch.ShowsStiffness = !touch.ShowsStiffness;
      touch.View.ColourBy(
        0, touch.ShowsStiffness ? touch.Session.StiffnessNorms() : Eigen::VectorXd());
      break;
    case 'n':
      touch.Session.Reset();
      break;
    case 'r':
      touch.Session.Reset();
      this->FindPokedRenderer(0, 0);
      if (this->CurrentRenderer)
      {
        this->CurrentRenderer->ResetCamera(touch.View.Surface(0)->GetBounds());
      }
      break;
    default:
      this->Superclass::OnChar();
      return;
  }
  this->Render();
}

int vtkInteractorStyleHaptic::GetNumberOfTools()
{
  return static_cast<int>(this->Internals->Session.Scene().tools.size());
}

bool vtkInteractorStyleHaptic::IsTouching(int tool)
{
  return this->Internals->Session.Contact(tool).touching;
}

bool vtkInteractorStyleHaptic::IsSliding(int tool)
{
  return this->Internals->Session.Contact(tool).sliding;
}

void vtkInteractorStyleHaptic::GetForce(int tool, double force[3])
{
  std::copy_n(this->Internals->Session.Contact(tool).wrench.force.data(), 3, force);
}

void vtkInteractorStyleHaptic::GetTorque(int tool, double torque[3])
{
  std::copy_n(this->Internals->Session.Contact(tool).wrench.torque.data(), 3, torque);
}

void vtkInteractorStyleHaptic::GetRenderedForce(int tool, double force[3])
{
  std::copy_n(this->Internals->Session.Rendered(tool).force.data(), 3, force);
}

void vtkInteractorStyleHaptic::GetToolPosition(int tool, double position[3])
{
  std::copy_n(this->Internals->Session.Contact(tool).pose.position.data(), 3, position);
}

void vtkInteractorStyleHaptic::GetContactPoint(int tool, double point[3])
{
  std::copy_n(this->Internals->Session.Contact(tool).staticPoint.data(), 3, point);
}

std::string vtkInteractorStyleHaptic::GetFault(int tool)
{
  return this->Internals->Session.Fault(tool);
}

double vtkInteractorStyleHaptic::GetResidual()
{
  return this->Internals->Session.Snapshot().contact.certificate.residual;
}

int vtkInteractorStyleHaptic::GetNumberOfContacts()
{
  return this->Internals->Session.Snapshot().contact.certificate.contactCount;
}

vtkIdType vtkInteractorStyleHaptic::GetNumberOfTicks()
{
  return this->Internals->Session.Ticks();
}

vtkIdType vtkInteractorStyleHaptic::GetNumberOfMissedTicks()
{
  return this->Internals->Session.MissedTicks();
}

double vtkInteractorStyleHaptic::GetTickTime(double share)
{
  return this->Internals->Session.TickTime(share);
}

std::string vtkInteractorStyleHaptic::GetTimingTable()
{
  return this->Internals->Session.TimingTable();
}

vtkPolyData* vtkInteractorStyleHaptic::GetTouchedModel()
{
  return this->Internals->Session.Touched();
}

vtkPolyData* vtkInteractorStyleHaptic::GetDeformedSurface(int body)
{
  const bool there =
    this->Internals->Shown && body >= 0 && body < this->Internals->View.NumberOfBodies();
  return there ? this->Internals->View.Surface(body) : nullptr;
}

void vtkInteractorStyleHaptic::GetForceTrace(vtkDoubleArray* trace)
{
  const auto wrenches = this->Internals->Session.ForceTrace();
  trace->SetNumberOfComponents(6);
  trace->SetNumberOfTuples(static_cast<vtkIdType>(wrenches.size()));
  for (std::size_t i = 0; i < wrenches.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      trace->SetComponent(i, c, wrenches[i].force[c]);
      trace->SetComponent(i, 3 + c, wrenches[i].torque[c]);
    }
  }
}

std::string vtkInteractorStyleHaptic::GetStatus()
{
  return this->Internals->Session.Status();
}
