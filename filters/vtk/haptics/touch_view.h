// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_touch_view_h
#define palpate_touch_view_h

#include "contact/rigid_shape.h"
#include "drawn_tool.h"
#include "haptics/servo_report.h"
#include "mesh/surface_mesh.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkCamera;
class vtkPolyData;
class vtkPoints;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextActor;

namespace palpate
{
/// A surface that is drawn as it is deformed.
struct DrawnBody
{
  std::shared_ptr<const SurfaceMesh> Mesh;
  Eigen::Matrix3Xd Rest, Normals; ///< of the vertices, in the scene's frame
  vtkNew<vtkPolyData> Surface;    ///< its points move
  vtkNew<vtkPoints> Points;
  vtkNew<vtkActor> Actor;
};

/// What a window shows of a touch: bodies, the tools, the nodes under a force as dots, a status line; and, seen
/// through the surface, a point's places and the forces on the hands as arrows, a finger each, all on one
/// scale.
class TouchView
{
public:
  TouchView();
  ~TouchView();

  void AddBody(std::shared_ptr<const SurfaceMesh> mesh, const RigidPose& pose);
  void AddTool(const ToolLook& look);
  void Clear();

  /// Puts all props into a renderer, or takes them out of the last one for a null one.
  void SetRenderer(vtkRenderer* renderer);

  /// @param displacement  3 by #nodes, in the scene's frame.
  void Deform(int body, const Eigen::Matrix3Xd& displacement);
  /// The largest force shown so far has the longest arrow.
  void Show(const ServoSnapshot& snapshot);
  double LargestForce() const { return this->Largest; }
  void SetStatus(const std::string& text);

  /// Colours a body by a number a vertex; none for an empty vector.
  void ColourBy(int body, const Eigen::VectorXd& values);
  void SetWireframe(bool wireframe);
  /// For a picture: tools of glass, forces with their names and sizes.
  void Explain(const ServoSnapshot& snapshot);

  /// Vertices whose normals face the camera.
  std::vector<int> FacingNodes(int body, vtkCamera* camera) const;
  /// Where a point of the first body is as it is drawn.
  Eigen::Vector3d DeformedPlace(int triangle, const Eigen::Vector3d& barycentric) const;
  vtkPolyData* Surface(int body) const { return this->Bodies[body]->Surface; }
  int NumberOfBodies() const { return static_cast<int>(this->Bodies.size()); }
  double Diagonal() const;

private:
  void AddProps();
  void AddMarks();
  void RemoveProps();
  void ShowForces(const ContactSnapshot& contact);
  void ShowLoads(const ContactSnapshot& contact);

  std::vector<std::unique_ptr<DrawnBody>> Bodies;
  std::vector<std::unique_ptr<DrawnTool>> Tools;
  vtkNew<vtkPolyData> Loads;
  vtkNew<vtkActor> LoadsActor;
  vtkNew<vtkTextActor> Status;
  std::array<vtkNew<vtkTextActor>, 3> Legend; ///< of a point's marks
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkNew<vtkRenderer> Above; ///< of the marks, which no surface hides
  vtkWeakPointer<vtkRenderWindow> Window;
  std::vector<DrawnForce> Forces; ///< for a tool at a time
  double Largest = 1e-12;
};
} // namespace palpate

#endif
