// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

// What the newest snapshot and the loop's counts say.
namespace palpate
{
namespace
{
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

const ToolContact& HapticTouch::Contact(int tool) const
{
  static const ToolContact nothing;
  const auto& tools = this->Snapshot().contact.tools;
  return tool >= 0 && tool < static_cast<int>(tools.size()) ? tools[tool] : nothing;
}

Wrench HapticTouch::Rendered(int tool) const
{
  const auto& tools = this->Snapshot().tools;
  return tool >= 0 && tool < static_cast<int>(tools.size())
    ? tools[tool].rendered
    : kNoWrench;
}

/// Whether a device that can render a force gets less than the model's, in its own newtons.
bool HapticTouch::IsReduced(int tool) const
{
  const SceneDevice& device = this->Described().devices[this->Described().tools[tool].device];
  const double wanted = device.mapping.toDevice(this->Contact(tool).wrench).force.norm();
  return device.type != DeviceType::Mouse && !this->Silent[tool] &&
    this->Rendered(tool).force.norm() < 0.999 * wanted;
}

const ProbeReading* HapticTouch::ProbeInside(int probe) const
{
  const std::vector<SceneProbe>& probes = this->Described().effects.probes;
  const std::vector<ProbeReading>& readings = this->Snapshot().contact.probes;
  std::size_t number = 0;
  for (int i = 0; i < static_cast<int>(probes.size()); ++i)
  {
    if (i == probe)
    {
      return probes[i].isInside && number < readings.size() ? &readings[number] : nullptr;
    }
    number += probes[i].isInside;
  }
  return nullptr;
}

Eigen::Vector3d HapticTouch::PartnerForce(int partner) const
{
  const ContactSnapshot& contact = this->Snapshot().contact;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int i = 0; i < contact.loadedCount; ++i)
  {
    if (contact.loadedBodies[i] == partner + 1)
    {
      force += contact.loads[i];
    }
  }
  return force;
}

std::string HapticTouch::Fault(int tool) const
{
  const auto& tools = this->Snapshot().tools;
  const bool there = tool >= 0 && tool < static_cast<int>(tools.size());
  return there && tools[tool].safety.fault != palpate::Fault::None
    ? palpate::describe(tools[tool].safety.fault)
    : "";
}

std::string HapticTouch::FaultTable() const
{
  std::string table;
  const auto& tools = this->Snapshot().tools;
  for (std::size_t t = 0; t < tools.size(); ++t)
  {
    const SafetyReport& report = tools[t].safety;
    for (int fault = 1; fault < kFaultCount; ++fault)
    {
      if (report.faults[fault] > 0)
      {
        char line[160];
        std::snprintf(line, sizeof line, "tool %zu   fault: %s, in %lld ticks, first at %.6g s\n", t,
          palpate::describe(static_cast<palpate::Fault>(fault)),
          static_cast<long long>(report.faults[fault]), report.firstFaults[fault]);
        table += line;
      }
    }
  }
  return table;
}

std::string HapticTouch::Status() const
{
  if (this->Snapshot().contact.tools.empty())
  {
    return "";
  }
  const SceneEffects& effects = this->Described().effects;
  std::string line = text("%.0f Hz", this->Described().servo.rate) + "  p99 " +
    engineering(this->TickTime(0.99), "s");
  for (std::size_t t = 0; t < this->Snapshot().contact.tools.size(); ++t)
  {
    const ToolContact& contact = this->Snapshot().contact.tools[t];
    line += "  " + engineering(contact.wrench.force.norm(), "N");
    line += contact.touching ? contact.sliding ? " slides" : " sticks" : " free";
    const int tool = static_cast<int>(t);
    if (this->IsReduced(tool))
    {
      line += " (rendered " + engineering(this->Rendered(tool).force.norm(), "N") +
        ", limited or faded for safety)";
    }
    const std::string fault = this->Fault(tool);
    line += fault.empty() ? "" : " (" + fault + ")";
    line += this->Silent[t] ? " (not rendered: its device's limits allow no force)" : "";
  }
  const ContactCertificate& certificate = this->Snapshot().contact.certificate;
  line += "  residual " + text("%.0e", certificate.residual) + (certificate.budgetCut ? " cut" : "");
  line += certificate.truncated ? " (contacts left out: more than there is room for)" : "";
  line += "  mu " + text("%.2g", effects.friction);
  if (this->Described().isOfPoints())
  {
    line += "  mask " + engineering(this->MaskRadius(), "m");
  }
  return line + "  x" + text("%.2g", effects.stiffnessScale);
}

std::int64_t HapticTouch::Ticks() const
{
  return this->Loop ? this->Loop->statistics().ticks.load() : 0;
}

std::int64_t HapticTouch::MissedTicks() const
{
  return this->Loop ? this->Loop->statistics().missedTicks.load() : 0;
}

std::int64_t HapticTouch::TruncatedTicks() const
{
  return this->Loop ? this->Loop->statistics().truncated.load() : 0;
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
} // namespace palpate
