// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_style_touch.h"

#include "contact/mask_kernel.h"

#include <stdexcept>
#include <string>

// The settings of the style.

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

bool vtkInteractorStyleHaptic::SetMaskShape(const char* name)
{
  return this->Try([&] { this->Internals->Session.SetMaskShape(palpate::maskShapeFromName(name ? name : "")); });
}

std::string vtkInteractorStyleHaptic::GetMaskShape()
{
  return palpate::nameOf(this->Internals->Session.Scene().effects.maskShape);
}

bool vtkInteractorStyleHaptic::SetRigidStiffness(double stiffness)
{
  return this->Try([&] { this->Internals->Session.SetRigidStiffness(stiffness); });
}

double vtkInteractorStyleHaptic::GetRigidStiffness()
{
  return this->Internals->Session.Scene().effects.stiffnessLimit;
}

bool vtkInteractorStyleHaptic::SetContactCapacity(int capacity)
{
  return this->Try([&] { this->Internals->Session.SetContactCapacity(capacity); });
}

int vtkInteractorStyleHaptic::GetContactCapacity()
{
  return this->Internals->Session.Scene().solver.capacity;
}

bool vtkInteractorStyleHaptic::SetDeformation(int mode)
{
  return this->Try(
    [&]
    {
      if (mode < DEFORM_ALL || mode > DEFORM_NONE)
      {
        throw std::invalid_argument(
          "the deformation must be from 0 (all) to 3 (none), not " + std::to_string(mode));
      }
      this->Internals->Session.SetDeformation(static_cast<palpate::DeformationRows>(mode));
      this->Modified();
    });
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

bool vtkInteractorStyleHaptic::SetLargestForce(double force)
{
  palpate::SafetySettings safety = this->Internals->Session.Scene().safety;
  safety.largestForce = force;
  return this->Try([&] { this->Internals->Session.SetSafety(safety); });
}

double vtkInteractorStyleHaptic::GetLargestForce()
{
  return this->Internals->Session.Scene().safety.largestForce;
}

bool vtkInteractorStyleHaptic::SetForceSlew(double slew)
{
  palpate::SafetySettings safety = this->Internals->Session.Scene().safety;
  safety.forceSlew = slew;
  return this->Try([&] { this->Internals->Session.SetSafety(safety); });
}

double vtkInteractorStyleHaptic::GetForceSlew()
{
  return this->Internals->Session.Scene().safety.forceSlew;
}

bool vtkInteractorStyleHaptic::SetForceRamp(double seconds)
{
  palpate::SafetySettings safety = this->Internals->Session.Scene().safety;
  safety.rampSeconds = seconds;
  return this->Try([&] { this->Internals->Session.SetSafety(safety); });
}

double vtkInteractorStyleHaptic::GetForceRamp()
{
  return this->Internals->Session.Scene().safety.rampSeconds;
}

bool vtkInteractorStyleHaptic::SetRecordFileName(const char* fileName)
{
  return this->Try([&] { this->Internals->Session.SetRecordFile(fileName ? fileName : ""); });
}
