// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "drawn_tool.h"

#include "mark_colours.h"

#include "vtkActor.h"
#include "vtkArrowSource.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCylinderSource.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cstdio>

namespace palpate
{
namespace
{
constexpr double GlassOpacity = 0.55;
// Shares of the body's diagonal.
constexpr double ArrowLength = 0.3; ///< at the largest force
constexpr double ArrowWidth = 0.15; ///< a shaft is 0.06 of this thick: thinner than the marks that it pierces
constexpr double LeastArrow = 0.02;
constexpr double ProbeRadius = 0.012, StaticRadius = 0.014, GodObjectRadius = 0.019;

vtkSmartPointer<vtkPolyData> ball(double radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(20);
  source->SetPhiResolution(16);
  source->Update();
  return source->GetOutput();
}

/// Of unit length along x.
vtkSmartPointer<vtkPolyData> arrow()
{
  vtkNew<vtkArrowSource> source;
  source->SetTipResolution(16);
  source->SetShaftResolution(12);
  source->Update();
  return source->GetOutput();
}

/// Of unit length along y around the middle, and unit radius.
vtkSmartPointer<vtkPolyData> rod()
{
  vtkNew<vtkCylinderSource> source;
  source->SetRadius(1);
  source->Update();
  return source->GetOutput();
}
} // namespace

DrawnTool::DrawnTool(const ToolLook& look, double diagonal)
  : Diagonal(diagonal)
  , IsOfPoint(look.Parts.empty())
  , Place(look.Place)
  , FeltBy(look.Felt)
  , Names(look.Names)
  , Static(StaticColour)
  , GodObject(GodObjectColour)
  , Way(StaticColour)
{
  for (const auto& surface : look.Parts)
  {
    this->Parts.push_back(std::make_unique<PlacedActor>(ToolColour));
    this->Parts.back()->SetSurface(surface);
    this->Parts.back()->Actor()->GetProperty()->BackfaceCullingOn();
    // Many layers cost frames.
    this->Parts.back()->Actor()->GetProperty()->SetOpacity(look.Parts.size() > 1 ? 1 : GlassOpacity);
  }
  if (this->IsOfPoint)
  {
    this->Parts.push_back(std::make_unique<PlacedActor>(ProbeColour));
    this->Parts[0]->SetSurface(ball(ProbeRadius * diagonal));
    this->Place = [](const ToolPose& pose, RigidPose* poses)
    { poses[0] = { pose.position, pose.orientation }; };
  }
  this->Poses.resize(this->Parts.size());
  const auto arrows = arrow();
  const int felt = look.Felt.empty() ? 0 : *std::max_element(look.Felt.begin(), look.Felt.end());
  for (int i = 0; i <= felt; ++i)
  {
    this->Arrows.push_back(std::make_unique<PlacedActor>(ForceColour));
    this->Arrows.back()->SetSurface(arrows);
    this->Arrows.back()->Actor()->VisibilityOff();
  }
  for (std::size_t i = 0; i < look.Names.size(); ++i)
  {
    this->Labels.push_back(vtkSmartPointer<vtkBillboardTextActor3D>::New());
    this->Labels[i]->PickableOff();
    this->Labels[i]->VisibilityOff();
    this->Labels[i]->SetDisplayOffset(6, 4);
    vtkTextProperty* text = this->Labels[i]->GetTextProperty();
    text->SetFontSize(16);
    text->SetColor(0.45, 0, 0);
    text->SetBold(true);
  }
  this->Static.SetSurface(ball(StaticRadius * diagonal));
  this->GodObject.SetSurface(ball(GodObjectRadius * diagonal));
  this->GodObject.Actor()->GetProperty()->SetOpacity(0.5); // the probe may be inside
  this->Way.SetSurface(rod());
  for (PlacedActor* mark : { &this->Static, &this->GodObject, &this->Way })
  {
    mark->Actor()->VisibilityOff();
  }
}

void DrawnTool::Explain()
{
  this->Explained = true;
  for (const auto& part : this->Parts)
  {
    part->Actor()->GetProperty()->SetOpacity(GlassOpacity);
  }
}

std::vector<vtkActor*> DrawnTool::Actors() const
{
  std::vector<vtkActor*> actors;
  for (const auto& part : this->Parts)
  {
    actors.push_back(part->Actor());
  }
  return this->IsOfPoint ? std::vector<vtkActor*>() : actors;
}

std::vector<vtkProp*> DrawnTool::Marks() const
{
  std::vector<vtkProp*> marks(this->Labels.begin(), this->Labels.end());
  for (const auto& arrow : this->Arrows)
  {
    marks.push_back(arrow->Actor());
  }
  if (this->IsOfPoint)
  {
    marks.insert(marks.end(), { this->Parts[0]->Actor(), this->Static.Actor(),
                                this->Way.Actor(), this->GodObject.Actor() });
  }
  return marks;
}

void DrawnTool::Show(const ToolContact& contact, const Eigen::Vector3d& godObject)
{
  this->Place(contact.pose, this->Poses.data());
  for (std::size_t k = 0; k < this->Parts.size(); ++k)
  {
    this->Parts[k]->MoveTo(this->Poses[k].position, this->Poses[k].orientation);
  }
  const bool onSurface = contact.touching && contact.triangle >= 0;
  for (PlacedActor* mark : { &this->Static, &this->GodObject, &this->Way })
  {
    mark->Actor()->SetVisibility(onSurface);
  }
  this->GodObject.MoveTo(godObject);
  this->Static.MoveTo(contact.staticPoint);
  const Eigen::Vector3d way = contact.hapticPoint - contact.staticPoint; // u^H
  const double radius = 0.15 * ProbeRadius * this->Diagonal;
  this->Way.MoveTo(contact.staticPoint + way / 2,
    Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), way),
    { radius, std::max(way.norm(), radius), radius });
}

void DrawnTool::ShowForces(const std::vector<DrawnForce>& forces, double largestForce)
{
  for (std::size_t i = 0; i < this->Arrows.size(); ++i)
  {
    const double share = forces[i].Force.norm() / largestForce;
    const bool shown = share > LeastArrow;
    this->Arrows[i]->Actor()->SetVisibility(shown);
    if (this->Explained && i < this->Labels.size())
    {
      char text[64];
      std::snprintf(text, sizeof text, "%s %.1f N", this->Names[i].c_str(), forces[i].Force.norm());
      const Eigen::Vector3d tip =
        forces[i].Place + ArrowLength * this->Diagonal / largestForce * forces[i].Force;
      this->Labels[i]->SetVisibility(shown);
      this->Labels[i]->SetInput(text);
      this->Labels[i]->SetPosition(tip.x(), tip.y(), tip.z());
    }
    if (shown)
    {
      const double width = ArrowWidth * this->Diagonal;
      this->Arrows[i]->MoveTo(forces[i].Place,
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), forces[i].Force),
        { ArrowLength * share * this->Diagonal, width, width });
    }
  }
}
} // namespace palpate
