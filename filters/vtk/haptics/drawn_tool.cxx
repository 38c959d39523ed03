// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "drawn_tool.h"

#include "vtkActor.h"
#include "vtkArrowSource.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <algorithm>

namespace palpate
{
namespace
{
constexpr double ToolColour[3] = { 0.25, 0.6, 0.3 };
constexpr double GodObjectColour[3] = { 0.95, 0.75, 0.1 };
constexpr double ForceColour[3] = { 0.8, 0.15, 0.15 };
constexpr double ArrowShare = 0.25; ///< of the body's diagonal, at the largest force
constexpr double BallShare = 0.012; ///< a point's ball

vtkSmartPointer<vtkPolyData> ball(double radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(16);
  source->SetPhiResolution(12);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> arrow()
{
  vtkNew<vtkArrowSource> source;
  source->SetTipResolution(16);
  source->SetShaftResolution(12);
  source->Update();
  return source->GetOutput();
}
} // namespace

DrawnTool::DrawnTool(const ToolLook& look, double diagonal)
  : Diagonal(diagonal)
  , Place(look.Place)
  , GodObject(GodObjectColour)
  , Force(ForceColour)
{
  const auto point = ball(BallShare * diagonal);
  for (const auto& surface : look.Parts)
  {
    this->Parts.push_back(std::make_unique<PlacedActor>(ToolColour));
    this->Parts.back()->SetSurface(surface);
    // Many layers cost frames.
    this->Parts.back()->Actor()->GetProperty()->SetOpacity(look.Parts.size() > 1 ? 1 : 0.6);
  }
  if (look.Parts.empty())
  {
    this->Parts.push_back(std::make_unique<PlacedActor>(ToolColour));
    this->Parts[0]->SetSurface(point);
    this->Place = [](const ToolPose& pose, RigidPose* poses)
    { poses[0] = { pose.position, pose.orientation }; };
  }
  this->Poses.resize(this->Parts.size());
  this->GodObject.SetSurface(point);
  this->Force.SetSurface(arrow());
  this->GodObject.Actor()->VisibilityOff();
  this->Force.Actor()->VisibilityOff();
}

std::vector<vtkActor*> DrawnTool::Actors() const
{
  std::vector<vtkActor*> actors{ this->GodObject.Actor(), this->Force.Actor() };
  for (const auto& part : this->Parts)
  {
    actors.push_back(part->Actor());
  }
  return actors;
}

void DrawnTool::Show(
  const ToolContact& contact, const Eigen::Vector3d& place, double largestForce)
{
  this->Place(contact.pose, this->Poses.data());
  for (std::size_t k = 0; k < this->Parts.size(); ++k)
  {
    this->Parts[k]->MoveTo(this->Poses[k].position, this->Poses[k].orientation);
  }
  this->GodObject.MoveTo(place);
  this->GodObject.Actor()->SetVisibility(contact.touching && contact.triangle >= 0);
  const double force = contact.wrench.force.norm();
  const bool felt = contact.touching && force > 1e-6 * largestForce;
  this->Force.Actor()->SetVisibility(felt);
  if (felt)
  {
    this->Force.MoveTo(place,
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), contact.wrench.force / force),
      ArrowShare * this->Diagonal * std::min(1.0, force / largestForce));
  }
}
} // namespace palpate
