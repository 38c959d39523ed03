// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch_view.h"

#include "conversion.h"

#include "vtkActor.h"
#include "vtkArrowSource.h"
#include "vtkCapsuleSource.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <cmath>

namespace palpate
{
namespace
{
constexpr double BodyColour[3] = { 0.85, 0.78, 0.7 };
constexpr double HeldColour[3] = { 0.35, 0.45, 0.7 };
constexpr double ToolColour[3] = { 0.25, 0.6, 0.3 };
constexpr double GodObjectColour[3] = { 0.95, 0.75, 0.1 };
constexpr double ForceColour[3] = { 0.8, 0.15, 0.15 };
constexpr double ArrowShare = 0.25; ///< of the body's diagonal, at the largest force
constexpr double BallShare = 0.012; ///< a point's ball

void setMapper(vtkActor* actor, vtkAlgorithmOutput* output)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(output);
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
}

void place(vtkTransform* transform, const Eigen::Vector3d& at, const Eigen::Quaterniond& orientation)
{
  const Eigen::AngleAxisd turn(orientation);
  transform->Identity();
  transform->Translate(at.data());
  transform->RotateWXYZ(
    turn.angle() * 180 / EIGEN_PI, turn.axis().x(), turn.axis().y(), turn.axis().z());
}

void setColour(vtkActor* actor, const double colour[3])
{
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
}
} // namespace

/// VTK's own lies along y around its middle.
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

ToolLook lookOf(const HandModel& model)
{
  ToolLook look;
  for (const Capsule& bone : model.capsules({}))
  {
    look.Parts.push_back(capsuleSurface(bone.radius, (bone.end - bone.begin).norm()));
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

struct TouchView::DrawnTool
{
  struct Part
  {
    vtkNew<vtkActor> Actor;
    vtkNew<vtkTransform> Transform;
  };
  std::vector<std::unique_ptr<Part>> Parts;
  std::function<void(const ToolPose&, RigidPose*)> Place;
  std::vector<RigidPose> Poses;
  vtkNew<vtkActor> GodObject, Force;
  vtkNew<vtkTransform> GodObjectPlace, ForcePlace;

  std::vector<vtkActor*> Actors() const
  {
    std::vector<vtkActor*> actors{ this->GodObject, this->Force };
    for (const auto& part : this->Parts)
    {
      actors.push_back(part->Actor);
    }
    return actors;
  }
};

TouchView::TouchView()
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->Loads);
  this->LoadsActor->SetMapper(mapper);
  this->LoadsActor->GetProperty()->SetPointSize(5);
  this->LoadsActor->GetProperty()->LightingOff();
  this->LoadsActor->PickableOff();
  setColour(this->LoadsActor, ForceColour);
  this->Status->SetPosition(10, 8);
  this->Status->GetTextProperty()->SetFontSize(14);
  this->Status->GetTextProperty()->SetFontFamilyToCourier();
  this->Status->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
}

TouchView::~TouchView()
{
  this->SetRenderer(nullptr);
}

double TouchView::Diagonal() const
{
  return this->Bodies.empty() ? 1 : this->Bodies[0]->Mesh->diagonal();
}

void TouchView::AddBody(std::shared_ptr<const SurfaceMesh> mesh, const RigidPose& pose)
{
  auto body = std::make_unique<DrawnBody>();
  body->Mesh = std::move(mesh);
  const Eigen::Matrix3d turn = pose.orientation.toRotationMatrix();
  body->Rest = (turn * body->Mesh->points()).colwise() + pose.position;
  body->Normals = turn * body->Mesh->vertexNormals();
  convert::setSurface(body->Surface, body->Rest, body->Mesh->triangles());
  body->Points->SetDataTypeToDouble();
  body->Points->DeepCopy(body->Surface->GetPoints());
  body->Surface->SetPoints(body->Points);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(body->Surface);
  normals->SplittingOff();
  normals->ConsistencyOff();
  setMapper(body->Actor, normals->GetOutputPort());
  setColour(body->Actor, this->Bodies.empty() ? BodyColour : HeldColour);
  this->Bodies.push_back(std::move(body));
}

void TouchView::AddTool(const ToolLook& look)
{
  auto tool = std::make_unique<DrawnTool>();
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(BallShare * this->Diagonal());
  ball->SetThetaResolution(16);
  ball->SetPhiResolution(12);
  for (const auto& surface : look.Parts)
  {
    auto part = std::make_unique<DrawnTool::Part>();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    mapper->ScalarVisibilityOff();
    part->Actor->SetMapper(mapper);
    part->Actor->GetProperty()->SetOpacity(look.Parts.size() > 1 ? 1 : 0.6); // many layers cost frames
    tool->Parts.push_back(std::move(part));
  }
  tool->Place = look.Place;
  if (look.Parts.empty())
  {
    tool->Parts.push_back(std::make_unique<DrawnTool::Part>());
    setMapper(tool->Parts[0]->Actor, ball->GetOutputPort());
    tool->Place = [](const ToolPose& pose, RigidPose* poses)
    { poses[0] = { pose.position, pose.orientation }; };
  }
  tool->Poses.resize(tool->Parts.size());
  for (const auto& part : tool->Parts)
  {
    setColour(part->Actor, ToolColour);
    part->Actor->SetUserTransform(part->Transform);
  }
  setMapper(tool->GodObject, ball->GetOutputPort());
  vtkNew<vtkArrowSource> arrow;
  arrow->SetTipResolution(16);
  arrow->SetShaftResolution(12);
  setMapper(tool->Force, arrow->GetOutputPort());
  setColour(tool->GodObject, GodObjectColour);
  setColour(tool->Force, ForceColour);
  tool->GodObject->SetUserTransform(tool->GodObjectPlace);
  tool->Force->SetUserTransform(tool->ForcePlace);
  tool->GodObject->VisibilityOff();
  tool->Force->VisibilityOff();
  for (vtkActor* actor : tool->Actors())
  {
    actor->PickableOff();
  }
  this->Tools.push_back(std::move(tool));
}

void TouchView::Clear()
{
  vtkSmartPointer<vtkRenderer> renderer = this->Renderer;
  this->SetRenderer(nullptr);
  this->Bodies.clear();
  this->Tools.clear();
  this->Loads->Initialize();
  this->Renderer = renderer;
}

void TouchView::SetRenderer(vtkRenderer* renderer)
{
  if (this->Renderer)
  {
    for (const auto& body : this->Bodies)
    {
      this->Renderer->RemoveActor(body->Actor);
    }
    for (const auto& tool : this->Tools)
    {
      for (vtkActor* actor : tool->Actors())
      {
        this->Renderer->RemoveActor(actor);
      }
    }
    this->Renderer->RemoveActor(this->LoadsActor);
    this->Renderer->RemoveActor2D(this->Status);
  }
  this->Renderer = renderer;
  if (renderer)
  {
    this->AddProps(renderer);
  }
}

void TouchView::AddProps(vtkRenderer* renderer)
{
  for (const auto& body : this->Bodies)
  {
    renderer->AddActor(body->Actor);
  }
  for (const auto& tool : this->Tools)
  {
    for (vtkActor* actor : tool->Actors())
    {
      renderer->AddActor(actor);
    }
  }
  renderer->AddActor(this->LoadsActor);
  renderer->AddActor2D(this->Status);
}

void TouchView::Deform(int body, const Eigen::Matrix3Xd& displacement)
{
  DrawnBody& drawn = *this->Bodies[body];
  auto* points = vtkDoubleArray::SafeDownCast(drawn.Points->GetData());
  Eigen::Map<Eigen::Matrix3Xd>(points->GetPointer(0), 3, displacement.cols()) =
    drawn.Rest + displacement;
  drawn.Points->Modified();
}

Eigen::Vector3d TouchView::DeformedPlace(int triangle, const Eigen::Vector3d& barycentric) const
{
  const DrawnBody& body = *this->Bodies[0];
  Eigen::Vector3d place = Eigen::Vector3d::Zero(), corner;
  for (int k = 0; k < 3; ++k)
  {
    body.Points->GetPoint(body.Mesh->triangles()(k, triangle), corner.data());
    place += barycentric[k] * corner;
  }
  return place;
}

void TouchView::ShowTool(DrawnTool& tool, const ToolContact& contact, double largestForce)
{
  tool.Place(contact.pose, tool.Poses.data());
  for (std::size_t k = 0; k < tool.Parts.size(); ++k)
  {
    place(tool.Parts[k]->Transform, tool.Poses[k].position, tool.Poses[k].orientation);
  }
  const bool onSurface = contact.touching && contact.triangle >= 0;
  Eigen::Vector3d from = contact.staticPoint;
  if (onSurface)
  {
    from = this->DeformedPlace(contact.triangle, contact.barycentric);
    place(tool.GodObjectPlace, from, Eigen::Quaterniond::Identity());
  }
  tool.GodObject->SetVisibility(onSurface);
  const double force = contact.wrench.force.norm();
  const bool felt = contact.touching && force > 1e-6 * largestForce;
  tool.Force->SetVisibility(felt);
  if (!felt)
  {
    return;
  }
  const Eigen::Vector3d direction = contact.wrench.force / force;
  const double length = ArrowShare * this->Diagonal() * std::min(1.0, force / largestForce);
  place(tool.ForcePlace, from, Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), direction));
  tool.ForcePlace->Scale(length, length, length);
}

/// Dots where nodes of the first body bear a force.
void TouchView::ShowLoads(const ContactSnapshot& contact)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> dots;
  const DrawnBody& body = *this->Bodies[0];
  for (int i = 0; i < contact.loadedCount; ++i)
  {
    if (contact.loadedBodies[i] != 0)
    {
      continue;
    }
    const int node = contact.loadedNodes[i];
    Eigen::Vector3d place;
    body.Points->GetPoint(node, place.data());
    place += 2e-3 * this->Diagonal() * body.Normals.col(node); // above the surface
    const vtkIdType dot = points->InsertNextPoint(place.data());
    dots->InsertNextCell(1, &dot);
  }
  this->Loads->SetPoints(points);
  this->Loads->SetVerts(dots);
}

void TouchView::Show(const ServoSnapshot& snapshot, double largestForce)
{
  for (std::size_t t = 0; t < this->Tools.size() && t < snapshot.contact.tools.size(); ++t)
  {
    this->ShowTool(*this->Tools[t], snapshot.contact.tools[t], largestForce);
  }
  this->ShowLoads(snapshot.contact);
}

void TouchView::SetStatus(const std::string& text)
{
  this->Status->SetInput(text.c_str());
}

void TouchView::ColourBy(int body, const Eigen::VectorXd& values)
{
  DrawnBody& drawn = *this->Bodies[body];
  auto* mapper = vtkPolyDataMapper::SafeDownCast(drawn.Actor->GetMapper());
  mapper->SetScalarVisibility(values.size() > 0);
  if (values.size() == 0)
  {
    return;
  }
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetNumberOfValues(values.size());
  std::vector<double> sorted;
  for (Eigen::Index i = 0; i < values.size(); ++i)
  {
    numbers->SetValue(i, values[i]);
    if (std::isfinite(values[i]))
    {
      sorted.push_back(values[i]);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  drawn.Surface->GetPointData()->SetScalars(numbers);
  vtkNew<vtkLookupTable> colours;
  colours->SetHueRange(0.67, 0.0); // soft blue, stiff red
  colours->SetNanColor(0.6, 0.6, 0.6, 1);
  mapper->SetLookupTable(colours);
  if (!sorted.empty()) // without the extremes of a few vertices
  {
    mapper->SetScalarRange(sorted[sorted.size() / 50], sorted[sorted.size() - 1 - sorted.size() / 50]);
  }
}

void TouchView::SetWireframe(bool wireframe)
{
  for (const auto& body : this->Bodies)
  {
    wireframe ? body->Actor->GetProperty()->SetRepresentationToWireframe()
              : body->Actor->GetProperty()->SetRepresentationToSurface();
  }
}

std::vector<int> TouchView::FacingNodes(int body, vtkCamera* camera) const
{
  const DrawnBody& drawn = *this->Bodies[body];
  Eigen::Vector3d eye, towards;
  camera->GetPosition(eye.data());
  camera->GetDirectionOfProjection(towards.data());
  std::vector<int> nodes;
  for (int v = 0; v < drawn.Mesh->vertexCount(); ++v)
  {
    const Eigen::Vector3d way = camera->GetParallelProjection()
      ? Eigen::Vector3d(-towards)
      : Eigen::Vector3d(eye - drawn.Rest.col(v));
    // A fifth of a right angle beyond the horizon: deformation turns normals.
    if (drawn.Normals.col(v).dot(way.normalized()) > -0.3)
    {
      nodes.push_back(v);
    }
  }
  return nodes;
}
} // namespace palpate
