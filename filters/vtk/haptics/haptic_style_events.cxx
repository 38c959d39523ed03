// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_style_touch.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellPicker.h"
#include "vtkPolyData.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

// The style's part in the interactor's events: frames, the mouse and the keys.

namespace
{
constexpr double WheelStep = 0.004;   ///< diagonals of the body, a notch
constexpr double StartAbove = 0.01;   ///< diagonals, where the mouse's probe begins
constexpr double LiftedAbove = 0.05;  ///< diagonals, where it ends
constexpr double KeyFactor = 1.25;    ///< by which a key changes a setting
constexpr double FrictionStep = 0.05;

double clamped(double value, double least, double most, const char* what)
{
  if (std::isnan(value))
  {
    throw std::invalid_argument(std::string(what) + " must be a number");
  }
  return std::clamp(value, least, most);
}
}

bool vtkInteractorStyleHaptic::SetPressDepth(double depth)
{
  return this->Try(
    [&]
    {
      this->PressDepth = clamped(depth, 0, 1, "the depth of a press");
      this->Modified();
    });
}

bool vtkInteractorStyleHaptic::SetFrameRate(double rate)
{
  return this->Try(
    [&]
    {
      this->FrameRate = clamped(rate, 1, 240, "the rate of frames");
      this->Modified();
    });
}

void vtkInteractorStyleHaptic::OnLeftButtonDown()
{
  if (!this->Interactor)
  {
    return;
  }
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

/// Puts the probe below the pointer, at the drag's depth behind the plane through its beginning. Nothing if
/// its mouse or its renderer is gone by now.
void vtkInteractorStyleHaptic::Drag()
{
  Touch& touch = *this->Internals;
  if (!touch.Session.HasMouse() || !this->CurrentRenderer)
  {
    return;
  }
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
  if (!this->Interactor)
  {
    return;
  }
  if (this->Internals->Dragging)
  {
    this->Drag();
    return;
  }
  this->Superclass::OnMouseMove();
}

void vtkInteractorStyleHaptic::OnLeftButtonUp()
{
  if (!this->Interactor)
  {
    return;
  }
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
  if (!this->Interactor)
  {
    return;
  }
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
  if (!this->Interactor)
  {
    return;
  }
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
  if (!this->Interactor)
  {
    return;
  }
  this->Internals->Dragging ? this->TurnWheel(1) : this->Superclass::OnMouseWheelForward();
}

void vtkInteractorStyleHaptic::OnMouseWheelBackward()
{
  if (!this->Interactor)
  {
    return;
  }
  this->Internals->Dragging ? this->TurnWheel(-1) : this->Superclass::OnMouseWheelBackward();
}

void vtkInteractorStyleHaptic::OnChar()
{
  if (!this->Interactor)
  {
    return;
  }
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
