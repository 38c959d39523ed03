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

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkCamera;
class vtkPolyData;
class vtkPoints;
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

/// What a window shows of a touch: bodies, the tools, their god-objects, the forces on the hand as arrows,
/// the nodes under a force as dots, a status line.
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
  /// @param largestForce  N, of an arrow as long as a quarter of the body.
  void Show(const ServoSnapshot& snapshot, double largestForce);
  void SetStatus(const std::string& text);

  /// Colours a body by a number a vertex; none for an empty vector.
  void ColourBy(int body, const Eigen::VectorXd& values);
  void SetWireframe(bool wireframe);

  /// Vertices whose normals face the camera.
  std::vector<int> FacingNodes(int body, vtkCamera* camera) const;
  /// Where a point of the first body is as it is drawn.
  Eigen::Vector3d DeformedPlace(int triangle, const Eigen::Vector3d& barycentric) const;
  vtkPolyData* Surface(int body) const { return this->Bodies[body]->Surface; }
  int NumberOfBodies() const { return static_cast<int>(this->Bodies.size()); }
  double Diagonal() const;

private:
  void AddProps(vtkRenderer* renderer);
  void ShowLoads(const ContactSnapshot& contact);

  std::vector<std::unique_ptr<DrawnBody>> Bodies;
  std::vector<std::unique_ptr<DrawnTool>> Tools;
  vtkNew<vtkPolyData> Loads;
  vtkNew<vtkActor> LoadsActor;
  vtkNew<vtkTextActor> Status;
  vtkSmartPointer<vtkRenderer> Renderer;
};
} // namespace palpate

#endif
