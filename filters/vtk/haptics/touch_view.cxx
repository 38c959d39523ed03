// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch_view.h"

#include "conversion.h"
#include "mark_colours.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>

namespace palpate
{
namespace
{
constexpr double BodyColour[3] = { 0.85, 0.78, 0.7 };
constexpr double ScaleFading = 0.98; ///< of the arrows' scale, a frame
constexpr double HeldColour[3] = { 0.35, 0.45, 0.7 };
} // namespace

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
  this->Above->InteractiveOff();
  const std::pair<const char*, const double*> legend[] = {
    { "x^C  the contact on the undeformed surface", StaticColour },
    { "x^E  the contact on the deformed surface", GodObjectColour },
    { "x^H  the probe", ProbeColour } };
  for (int i = 0; i < 3; ++i)
  {
    std::string above; // a line each, from the window's upper edge
    for (int line = 0; line < i; ++line)
    {
      above += " \n";
    }
    this->Legend[i]->SetInput((above + legend[i].first).c_str());
    this->Legend[i]->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    this->Legend[i]->SetPosition(0.01, 0.985);
    this->Legend[i]->VisibilityOff();
    this->Legend[i]->GetTextProperty()->SetVerticalJustificationToTop();
    this->Legend[i]->GetTextProperty()->SetFontSize(14);
    this->Legend[i]->GetTextProperty()->SetBold(true);
    this->Legend[i]->GetTextProperty()->SetColor(
      legend[i].second[0], legend[i].second[1], legend[i].second[2]);
  }
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
  setSurface(body->Actor, normals->GetOutputPort());
  setColour(body->Actor, this->Bodies.empty() ? BodyColour : HeldColour);
  this->Bodies.push_back(std::move(body));
}

void TouchView::AddTool(const ToolLook& look)
{
  this->Tools.push_back(std::make_unique<DrawnTool>(look, this->Diagonal()));
}

void TouchView::Clear()
{
  vtkSmartPointer<vtkRenderer> renderer = this->Renderer;
  this->SetRenderer(nullptr);
  this->Bodies.clear();
  this->Tools.clear();
  this->Loads->Initialize();
  this->Largest = 1e-12;
  this->Renderer = renderer;
}

void TouchView::SetRenderer(vtkRenderer* renderer)
{
  this->RemoveProps();
  this->Renderer = renderer;
  if (renderer)
  {
    this->AddProps();
    this->AddMarks();
  }
}

void TouchView::RemoveProps()
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
    this->Renderer->RemoveActor2D(this->Status);
  }
  this->Above->RemoveAllViewProps();
  if (this->Window)
  {
    this->Window->RemoveRenderer(this->Above);
  }
  this->Window = nullptr;
}

void TouchView::AddProps()
{
  for (const auto& body : this->Bodies)
  {
    this->Renderer->AddActor(body->Actor);
  }
  for (const auto& tool : this->Tools)
  {
    for (vtkActor* actor : tool->Actors())
    {
      this->Renderer->AddActor(actor);
    }
  }
  this->Renderer->AddActor2D(this->Status);
}

/// In a layer of the window of its own, with the same camera.
void TouchView::AddMarks()
{
  this->Above->AddActor(this->LoadsActor);
  for (const auto& tool : this->Tools)
  {
    for (vtkProp* mark : tool->Marks())
    {
      this->Above->AddViewProp(mark);
    }
  }
  for (vtkTextActor* line : this->Legend)
  {
    this->Above->AddActor2D(line);
  }
  this->Window = this->Renderer->GetRenderWindow();
  if (this->Window)
  {
    this->Window->SetNumberOfLayers(std::max(2, this->Window->GetNumberOfLayers()));
    this->Above->SetLayer(this->Window->GetNumberOfLayers() - 1);
    this->Above->SetViewport(this->Renderer->GetViewport());
    this->Above->SetActiveCamera(this->Renderer->GetActiveCamera());
    this->Window->AddRenderer(this->Above);
  }
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

/// What a point feels acts on its god-object; of a tool with a shape, what its loads tell.
void TouchView::ShowForces(const ContactSnapshot& contact)
{
  int firstPart = 0;
  this->Largest = std::max(1e-12, ScaleFading * this->Largest);
  for (std::size_t t = 0; t < this->Tools.size() && t < contact.tools.size(); ++t)
  {
    DrawnTool& tool = *this->Tools[t];
    const int parts = static_cast<int>(tool.Felt().size());
    this->Forces.assign(tool.ForceCount(), DrawnForce());
    std::vector<double> weights(tool.ForceCount(), 1e-300);
    if (tool.IsPoint() && contact.tools[t].touching)
    {
      const ToolContact& point = contact.tools[t];
      this->Forces[0] = { this->DeformedPlace(point.triangle, point.barycentric),
        point.wrench.force };
    }
    for (int i = 0; i < contact.loadedCount; ++i)
    {
      const int part = contact.loadedParts[i] - firstPart;
      if (part < 0 || part >= parts || contact.loadedBodies[i] != 0)
      {
        continue;
      }
      Eigen::Vector3d place;
      this->Bodies[0]->Points->GetPoint(contact.loadedNodes[i], place.data());
      const double weight = contact.loads[i].norm();
      DrawnForce& force = this->Forces[tool.Felt()[part]];
      double& sum = weights[tool.Felt()[part]];
      sum += weight;
      force.Place += weight / sum * (place - force.Place);
      force.Force -= contact.loads[i];
    }
    for (const DrawnForce& force : this->Forces)
    {
      this->Largest = std::max(this->Largest, force.Force.norm());
    }
    tool.ShowForces(this->Forces, this->Largest);
    firstPart += parts;
  }
}

void TouchView::Show(const ServoSnapshot& snapshot)
{
  bool points = false;
  for (std::size_t t = 0; t < this->Tools.size() && t < snapshot.contact.tools.size(); ++t)
  {
    const ToolContact& contact = snapshot.contact.tools[t];
    const bool onSurface = contact.touching && contact.triangle >= 0;
    points = points || onSurface;
    this->Tools[t]->Show(contact,
      onSurface ? this->DeformedPlace(contact.triangle, contact.barycentric) : contact.staticPoint);
  }
  for (vtkTextActor* line : this->Legend)
  {
    line->SetVisibility(points);
  }
  this->ShowForces(snapshot.contact);
  this->ShowLoads(snapshot.contact);
  if (this->Window && this->Above->GetActiveCamera() != this->Renderer->GetActiveCamera())
  {
    this->Above->SetActiveCamera(this->Renderer->GetActiveCamera());
  }
}

void TouchView::SetStatus(const std::string& text)
{
  this->Status->SetInput(text.c_str());
  if (this->Renderer)
  {
    // At the window's lower edge, where a gradient has the first colour.
    const double* ground = this->Renderer->GetBackground();
    const bool isDark = 0.299 * ground[0] + 0.587 * ground[1] + 0.114 * ground[2] < 0.5;
    const double shade = isDark ? 0.92 : 0.1;
    this->Status->GetTextProperty()->SetColor(shade, shade, shade);
  }
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

void TouchView::Explain(const ServoSnapshot& snapshot)
{
  for (const auto& tool : this->Tools)
  {
    tool->Explain();
  }
  this->Show(snapshot);
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
