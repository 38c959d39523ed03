// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "placed_actor.h"

#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkShaderProperty.h"
#include "vtkTransform.h"

namespace palpate
{
namespace
{
/// VTK's shader raises to the power of a gloss that there is none of; drawn by the CPU, that is a sixth of a
/// frame.
void leaveOutGloss(vtkActor* actor)
{
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
    "pow(df, specularPower)", false, "0.0", true);
}
} // namespace

void setSurface(vtkActor* actor, vtkAlgorithmOutput* surface)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface);
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
  leaveOutGloss(actor);
}

void setColour(vtkActor* actor, const double colour[3])
{
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
}

PlacedActor::PlacedActor(const double colour[3])
{
  setColour(this->Drawn, colour);
  this->Drawn->SetUserTransform(this->Transform);
  this->Drawn->PickableOff();
}

PlacedActor::~PlacedActor() = default;

void PlacedActor::SetSurface(vtkPolyData* surface)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  this->Drawn->SetMapper(mapper);
  leaveOutGloss(this->Drawn);
}

void PlacedActor::MoveTo(const Eigen::Vector3d& place, const Eigen::Quaterniond& orientation,
  const Eigen::Vector3d& scale)
{
  const Eigen::AngleAxisd turn(orientation);
  this->Transform->Identity();
  this->Transform->Translate(place.data());
  this->Transform->RotateWXYZ(
    turn.angle() * 180 / EIGEN_PI, turn.axis().x(), turn.axis().y(), turn.axis().z());
  this->Transform->Scale(scale.data());
}
} // namespace palpate
