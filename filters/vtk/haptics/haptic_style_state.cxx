// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_style_touch.h"

#include "vtkDoubleArray.h"

#include <algorithm>

// What the style tells of its touch.

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

bool vtkInteractorStyleHaptic::HasTorques()
{
  const palpate::Scene& scene = this->Internals->Session.Scene();
  return scene.effects.torque && !scene.isOfPoints();
}

int vtkInteractorStyleHaptic::GetNumberOfPartners()
{
  return std::max(0, static_cast<int>(this->Internals->Session.Scene().models.size()) - 1);
}

void vtkInteractorStyleHaptic::GetPartnerForce(int partner, double force[3])
{
  const Eigen::Vector3d sum = this->Internals->Session.PartnerForce(partner);
  std::copy_n(sum.data(), 3, force);
}

int vtkInteractorStyleHaptic::GetNumberOfProbes()
{
  return static_cast<int>(this->Internals->Session.Scene().effects.probes.size());
}

std::string vtkInteractorStyleHaptic::GetProbeName(int probe)
{
  const auto& probes = this->Internals->Session.Scene().effects.probes;
  return probe >= 0 && probe < static_cast<int>(probes.size()) ? probes[probe].name : "";
}

double vtkInteractorStyleHaptic::GetProbeVonMisesStress(int probe)
{
  const palpate::ProbeReading* reading = this->Internals->Session.ProbeInside(probe);
  return reading ? reading->vonMises : 0;
}

double vtkInteractorStyleHaptic::GetProbeDisplacementGradient(int probe)
{
  const palpate::ProbeReading* reading = this->Internals->Session.ProbeInside(probe);
  return reading ? reading->gradient : 0;
}

double vtkInteractorStyleHaptic::GetLargestProbeVonMisesStress(int probe)
{
  const palpate::ProbeReading* reading = this->Internals->Session.ProbeInside(probe);
  return reading ? reading->largestVonMises : 0;
}

double vtkInteractorStyleHaptic::GetLargestProbeDisplacementGradient(int probe)
{
  const palpate::ProbeReading* reading = this->Internals->Session.ProbeInside(probe);
  return reading ? reading->largestGradient : 0;
}

double vtkInteractorStyleHaptic::GetProbeLimitTime(int probe)
{
  const palpate::ProbeReading* reading = this->Internals->Session.ProbeInside(probe);
  return reading && reading->exceededTick >= 0
    ? reading->exceededTick / this->Internals->Session.Scene().servo.rate
    : -1;
}

void vtkInteractorStyleHaptic::GetProbeDisplacement(int probe, double displacement[3])
{
  const Eigen::Matrix3Xd& all = this->Internals->Session.ProbeDisplacements();
  const bool there = probe >= 0 && probe < all.cols();
  for (int c = 0; c < 3; ++c)
  {
    displacement[c] = there ? all(c, probe) : 0;
  }
}

std::string vtkInteractorStyleHaptic::GetFaultTable()
{
  return this->Internals->Session.FaultTable();
}

/// Tells what has not been told yet.
void vtkInteractorStyleHaptic::Warn()
{
  std::vector<std::string>& told = this->Internals->Warnings;
  for (const std::string& warning : this->Internals->Session.Warnings())
  {
    if (std::find(told.begin(), told.end(), warning) == told.end())
    {
      told.push_back(warning);
      vtkWarningMacro(<< warning);
    }
  }
}

std::string vtkInteractorStyleHaptic::GetWarnings()
{
  std::string lines;
  for (const std::string& warning : this->Internals->Warnings)
  {
    lines += warning + "\n";
  }
  return lines;
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

vtkIdType vtkInteractorStyleHaptic::GetNumberOfTruncatedTicks()
{
  return this->Internals->Session.TruncatedTicks();
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
  if (!trace)
  {
    return;
  }
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
