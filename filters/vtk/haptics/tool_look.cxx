// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tool_look.h"

#include "vtkCapsuleSource.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <iterator>

namespace palpate
{
namespace
{
vtkSmartPointer<vtkPolyData> ball(double radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(32);
  source->SetPhiResolution(24);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> square(double half)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-half, -half, 0);
  source->SetPoint1(half, -half, 0);
  source->SetPoint2(-half, half, 0);
  source->Update();
  return source->GetOutput();
}

/// Along z from the origin; VTK's own lies along y around its middle.
vtkSmartPointer<vtkPolyData> capsuleSurface(double radius, double length)
{
  vtkNew<vtkCapsuleSource> source;
  source->SetRadius(radius);
  source->SetCylinderLength(length);
  source->SetThetaResolution(16);
  source->SetPhiResolution(8);
  vtkNew<vtkTransform> place;
  place->Translate(0, 0, length / 2);
  place->RotateX(90);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetInputConnection(source->GetOutputPort());
  moved->SetTransform(place);
  moved->Update();
  return moved->GetOutput();
}

ToolLook rigid(vtkSmartPointer<vtkPolyData> surface)
{
  return { { std::move(surface) },
    [](const ToolPose& pose, RigidPose* poses) { poses[0] = { pose.position, pose.orientation }; },
    { 0 }, {} };
}
} // namespace

ToolLook lookOf(const HandModel& model)
{
  ToolLook look;
  for (const Capsule& bone : model.capsules({}))
  {
    look.Parts.push_back(capsuleSurface(bone.radius, (bone.end - bone.begin).norm()));
  }
  for (int finger = 0; finger < static_cast<int>(std::size(kHandFingers)); ++finger)
  {
    look.Names.push_back(kHandFingers[finger].name);
    look.Felt.insert(look.Felt.end(), kHandFingers[finger].boneCount, finger);
  }
  look.Place = [model](const ToolPose& pose, RigidPose* poses)
  {
    const HandCapsules bones = model.capsules(pose);
    for (int k = 0; k < kHandCapsuleCount; ++k)
    {
      poses[k] = { bones[k].begin,
        Eigen::Quaterniond::FromTwoVectors(
          Eigen::Vector3d::UnitZ(), bones[k].end - bones[k].begin) };
    }
  };
  return look;
}

ToolLook lookOf(const SceneTool& tool, vtkPolyData* surface, double reach)
{
  switch (tool.shape)
  {
    case ToolShape::Sphere:
      return rigid(ball(tool.radius));
    case ToolShape::Capsule:
      return rigid(capsuleSurface(tool.radius, tool.length));
    case ToolShape::Plane:
      return rigid(square(reach));
    case ToolShape::Mesh:
      return rigid(surface);
    case ToolShape::Hand:
      return lookOf(HandModel(tool.length, tool.side));
    case ToolShape::Point:
      break;
  }
  return {};
}
} // namespace palpate
