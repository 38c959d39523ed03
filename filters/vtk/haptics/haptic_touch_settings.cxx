// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include "haptics/point_touch.h"
#include "haptics/tool_stiffness.h"
#include "haptics/tool_touch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

// What takes effect at once.
namespace palpate
{
namespace
{
constexpr double LargestFriction = 100, LargestRadius = 1e6, LargestScale = 1e9;
constexpr double LargestStiffness = 1e15;

/// @param range  what the number must be.
void requireRange(bool isInRange, const std::string& range, double value)
{
  char number[32];
  std::snprintf(number, sizeof number, "%g", value);
  if (!isInRange)
  {
    throw std::invalid_argument(range + ", not " + number);
  }
}
/// |K|_2 of the stiffest free vertex as it is felt, N/m.
double stiffest(const SurfaceStiffness& stiffness)
{
  double largest = 0;
  for (int v : stiffness.greens().info().conditions.freeNodes())
  {
    const Eigen::Matrix3d felt = stiffness.haptic(v);
    largest = felt.hasNaN() ? largest : std::max(largest, felt.operatorNorm());
  }
  return largest;
}
} // namespace

void HapticTouch::SetFriction(double mu)
{
  requireRange(mu >= 0 && mu <= LargestFriction, "friction must be from 0 to 100", mu);
  this->Described().effects.friction = mu;
  if (!this->Session)
  {
    return;
  }
  if (auto* points = dynamic_cast<PointTouch*>(&this->Session->contact()))
  {
    points->setFriction(mu);
  }
  else
  {
    static_cast<ToolTouch&>(this->Session->contact()).setFriction(mu);
  }
}

std::shared_ptr<const SurfaceStiffness> HapticTouch::NewStiffness() const
{
  const SceneEffects& effects = this->Described().effects;
  const double modulus = this->Loaded.Bodies[0].greens->info().material.youngsModulus();
  return std::make_shared<const SurfaceStiffness>(
    this->Loaded.Bodies[0].greens->withYoungsModulus(modulus * effects.stiffnessScale),
    this->Loaded.Bodies[0].mesh, effects.maskShape, this->MaskRadius(), effects.stiffnessLimit);
}

/// The same, nowhere stiffer in any direction than all devices render stably: |K|_2 <= |K|_F, which k_Rigid
/// bounds by sqrt(3) k_Rigid.
std::shared_ptr<const SurfaceStiffness> HapticTouch::Bounded(
  std::shared_ptr<const SurfaceStiffness> stiffness) const
{
  const double rigid = this->DeviceStiffness / std::sqrt(3.0);
  return rigid > 0 && stiffness->rigidStiffness() > rigid ? stiffness->withRigidStiffness(rigid)
                                                          : stiffness;
}

/// Bounds what tools show by what their devices render stably, and tells it: the stiffness of points place by
/// place, all forces of tools with a shape by one factor, with which they stay those of an elastic body.
void HapticTouch::BoundStiffness(const std::vector<ServoTool>& hands,
  const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes)
{
  this->DeviceStiffness = this->ToolStiffness = 0;
  for (const ServoTool& hand : hands)
  {
    const double stated = hand.device->info().largestStiffness;
    const double served = stated / (hand.mapping.forceScale * hand.mapping.scale);
    if (served > 0 && (this->DeviceStiffness == 0 || served < this->DeviceStiffness))
    {
      this->DeviceStiffness = served;
    }
  }
  if (this->DeviceStiffness == 0)
  {
    return;
  }
  char line[256];
  if (auto* points = dynamic_cast<PointTouch*>(&this->Session->contact()))
  {
    const auto own = points->stiffness();
    if (const auto bounded = this->Bounded(own); bounded != own)
    {
      points->setStiffness(bounded);
      std::snprintf(line, sizeof line,
        "the model's stiffness, up to %.4g N/m, is limited to the %.4g N/m that the device states to "
        "render stably",
        stiffest(*own), this->DeviceStiffness);
      this->Cautions.emplace_back(line);
    }
    return;
  }
  const palpate::ToolStiffness tools = toolStiffness(this->Described(), this->Loaded.Bodies, meshes);
  this->ToolStiffness = tools.stiffness;
  const double scale = this->Described().effects.stiffnessScale;
  if (const double bounded = this->BoundedScale(); bounded < scale)
  {
    this->ScaleTools(bounded);
    std::snprintf(line, sizeof line,
      "the tools' stiffness on the model, up to %.4g N/m where they are %.4g m deep, is limited to the %.4g "
      "N/m that the device states to render stably: all forces are %.3g times the model's",
      scale * tools.stiffness, tools.depth, this->DeviceStiffness, bounded / scale);
    this->Cautions.emplace_back(line);
  }
}

/// Of tools with a shape: no larger than that the stiffest of them is as stiff as all devices render stably.
double HapticTouch::BoundedScale() const
{
  const double scale = this->Described().effects.stiffnessScale;
  return this->DeviceStiffness > 0 && this->ToolStiffness > 0
    ? std::min(scale, this->DeviceStiffness / this->ToolStiffness)
    : scale;
}

void HapticTouch::ScaleTools(double scale)
{
  this->Session->setStiffnessScale(scale);
  static_cast<ToolTouch&>(this->Session->contact()).setStiffnessScale(scale);
}

void HapticTouch::SetMaskRadius(double radius)
{
  requireRange(radius >= 0 && radius <= LargestRadius,
    "the radius of a mask must be from 0 to 1e6 m", radius);
  this->Described().effects.maskRadius = radius;
  this->Described().effects.maskRadiusEdges = 0;
  if (auto* points = this->Session ? dynamic_cast<PointTouch*>(&this->Session->contact()) : nullptr)
  {
    points->setStiffness(this->Bounded(this->NewStiffness()));
  }
}

void HapticTouch::SetMaskShape(MaskShape shape)
{
  if (shape == this->Described().effects.maskShape)
  {
    return;
  }
  this->Described().effects.maskShape = shape;
  if (auto* points = this->Session ? dynamic_cast<PointTouch*>(&this->Session->contact()) : nullptr)
  {
    points->setStiffness(this->Bounded(this->NewStiffness()));
  }
}

void HapticTouch::SetStiffnessScale(double scale)
{
  requireRange(scale > 0 && scale <= LargestScale,
    "a stiffness scale must be positive and at most 1e9", scale);
  this->Described().effects.stiffnessScale = scale;
  if (!this->Session)
  {
    return;
  }
  if (auto* points = dynamic_cast<PointTouch*>(&this->Session->contact()))
  {
    this->Session->setStiffnessScale(scale);
    const double modulus = this->Loaded.Bodies[0].greens->info().material.youngsModulus();
    const auto whole =
      points->stiffness()->withRigidStiffness(this->Described().effects.stiffnessLimit);
    points->setStiffness(this->Bounded(whole->withYoungsModulus(modulus * scale)));
  }
  else
  {
    this->ScaleTools(this->BoundedScale());
  }
}

void HapticTouch::SetRigidStiffness(double stiffness)
{
  requireRange(stiffness >= 0 && stiffness <= LargestStiffness,
    "the rigid stiffness must be from 0 to 1e15 N/m", stiffness);
  this->Described().effects.stiffnessLimit = stiffness;
  if (!this->Session)
  {
    return;
  }
  if (auto* points = dynamic_cast<PointTouch*>(&this->Session->contact()))
  {
    points->setStiffness(this->Bounded(points->stiffness()->withRigidStiffness(stiffness)));
  }
  else
  {
    static_cast<ToolTouch&>(this->Session->contact()).setRigidStiffness(stiffness);
  }
}

double HapticTouch::MeanEdge() const
{
  return this->Loaded.Bodies.empty() ? 0 : this->Loaded.Bodies[0].mesh->meanEdgeLength();
}

double HapticTouch::MaskRadius() const
{
  const SceneEffects& effects = this->Described().effects;
  return effects.maskRadiusEdges > 0 ? effects.maskRadiusEdges * this->MeanEdge()
                                     : effects.maskRadius;
}

Eigen::VectorXd HapticTouch::StiffnessNorms() const
{
  const SurfaceStiffness stiffness(this->Loaded.Bodies[0].greens, this->Loaded.Bodies[0].mesh,
    this->Described().effects.maskShape, this->MaskRadius(), this->Described().effects.stiffnessLimit);
  Eigen::VectorXd norms(this->Loaded.Bodies[0].mesh->vertexCount());
  for (int v = 0; v < norms.size(); ++v)
  {
    norms[v] = this->Loaded.Bodies[0].greens->isFixed(v) ? NAN : stiffness.haptic(v).norm();
  }
  return norms;
}
} // namespace palpate
