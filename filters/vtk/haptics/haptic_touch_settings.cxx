// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptic_touch.h"

#include "haptics/point_touch.h"
#include "haptics/tool_touch.h"

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

void HapticTouch::SetMaskRadius(double radius)
{
  requireRange(radius >= 0 && radius <= LargestRadius,
    "the radius of a mask must be from 0 to 1e6 m", radius);
  this->Described().effects.maskRadius = radius;
  this->Described().effects.maskRadiusEdges = 0;
  if (auto* points = this->Session ? dynamic_cast<PointTouch*>(&this->Session->contact()) : nullptr)
  {
    points->setStiffness(this->NewStiffness());
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
  this->Session->setStiffnessScale(scale);
  if (auto* points = dynamic_cast<PointTouch*>(&this->Session->contact()))
  {
    const double modulus = this->Loaded.Bodies[0].greens->info().material.youngsModulus();
    points->setStiffness(points->stiffness()->withYoungsModulus(modulus * scale));
  }
  else
  {
    static_cast<ToolTouch&>(this->Session->contact()).setStiffnessScale(scale);
  }
}

void HapticTouch::SetRigidStiffness(double stiffness)
{
  requireRange(stiffness >= 0 && stiffness <= LargestStiffness,
    "the rigid stiffness must be from 0 to 1e15 N/m", stiffness);
  this->Described().effects.stiffnessLimit = stiffness;
  if (auto* points = this->Session ? dynamic_cast<PointTouch*>(&this->Session->contact()) : nullptr)
  {
    points->setStiffness(points->stiffness()->withRigidStiffness(stiffness));
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
