// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkInteractorStyleHaptic.h"

#include "haptic_style_touch.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkInteractorStyleHaptic);

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
     << indent << "ContactCapacity: " << this->GetContactCapacity() << "\n"
     << indent << "Deformation: " << this->GetDeformation() << "\n"
     << indent << "ServoRate: " << this->GetServoRate() << "\n"
     << indent << "PressDepth: " << this->PressDepth << "\n"
     << indent << "FrameRate: " << this->FrameRate << "\n"
     << indent << "Status: " << this->GetStatus() << "\n"
     << indent << "FailureMessage: " << this->FailureMessage << "\n";
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
  this->Try(
    [&]
    {
      plan = this->Internals->Session.EvaluationPlan(
        [this](double fraction, const char*)
        {
          this->InvokeEvent(vtkCommand::ProgressEvent, &fraction);
          return true;
        });
    });
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
      if (std::min(vendor, product) < 0 || std::max(vendor, product) > 0xffff)
      {
        throw std::invalid_argument("a HID device's numbers are from 0 to 65535");
      }
      palpate::SceneDevice device;
      device.type = palpate::DeviceType::Hid;
      device.vendor = static_cast<std::uint16_t>(vendor);
      device.product = static_cast<std::uint16_t>(product);
      this->Internals->Session.SetDevice(device);
    });
}

void vtkInteractorStyleHaptic::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  if (!interactor)
  {
    this->ShowIn(nullptr);
    this->Internals->Dragging = false;
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
  if (!touch.Shown)
  {
    touch.Warnings.clear(); // they were of another model or tool
  }
  this->Warn();
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
  touch.Exceeded.assign(touch.Session.Scene().effects.probes.size(), false);
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
      this->Warn();
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
  touch.View.Show(touch.Session.Snapshot());
  touch.View.SetStatus(touch.Session.Status());
  this->Announce();
}

/// Invokes events for what has changed since the last update.
void vtkInteractorStyleHaptic::Announce()
{
  Touch& touch = *this->Internals;
  // An observer may load another scene.
  for (std::size_t tool = 0; tool < std::min(touch.Touched.size(),
         touch.Session.Snapshot().contact.tools.size()); ++tool)
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
  for (std::size_t probe = 0; probe < touch.Exceeded.size(); ++probe)
  {
    const palpate::ProbeReading* reading = touch.Session.ProbeInside(static_cast<int>(probe));
    const bool isExceeded = reading && reading->exceededTick >= 0;
    const bool isNew = isExceeded && !touch.Exceeded[probe];
    touch.Exceeded[probe] = isExceeded;
    int number = static_cast<int>(probe);
    if (isNew)
    {
      this->InvokeEvent(ThresholdEvent, &number);
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

