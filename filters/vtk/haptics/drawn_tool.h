// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_drawn_tool_h
#define palpate_drawn_tool_h

#include "haptics/touch_model.h"
#include "placed_actor.h"
#include "tool_look.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkBillboardTextActor3D;
class vtkProp;

namespace palpate
{
/// A force on a hand as it is drawn.
struct DrawnForce
{
  Eigen::Vector3d Place = Eigen::Vector3d::Zero(); ///< m
  Eigen::Vector3d Force = Eigen::Vector3d::Zero(); ///< N
};

/// A tool as it is drawn: its parts and the forces on the hand, a finger each; of a point the places of
/// [JP01] fig. 8.
class DrawnTool
{
public:
  /// @param diagonal  of the body that it touches, m, which tells how large marks are.
  DrawnTool(const ToolLook& look, double diagonal);

  /// @param godObject  x^E, where a point's contact is on the deformed surface, m.
  void Show(const ToolContact& contact, const Eigen::Vector3d& godObject);
  /// @param forces        one for each of ForceCount().
  /// @param largestForce  N, of the longest arrow.
  void ShowForces(const std::vector<DrawnForce>& forces, double largestForce);
  /// For a picture, from the next forces on: a tool of glass, forces with their names. It costs frames.
  void Explain();

  bool IsPoint() const { return this->IsOfPoint; }
  /// To which of the forces a part's belongs.
  const std::vector<int>& Felt() const { return this->FeltBy; }
  int ForceCount() const { return static_cast<int>(this->Arrows.size()); }

  /// What lies in the scene.
  std::vector<vtkActor*> Actors() const;
  /// What is seen through the surface.
  std::vector<vtkProp*> Marks() const;

private:
  double Diagonal;
  bool IsOfPoint, Explained = false;
  std::vector<std::unique_ptr<PlacedActor>> Parts, Arrows;
  std::function<void(const ToolPose&, RigidPose*)> Place;
  std::vector<RigidPose> Poses;
  std::vector<int> FeltBy;
  std::vector<std::string> Names;
  std::vector<vtkSmartPointer<vtkBillboardTextActor3D>> Labels; ///< as many
  PlacedActor Static, GodObject, Way;
};
} // namespace palpate

#endif
