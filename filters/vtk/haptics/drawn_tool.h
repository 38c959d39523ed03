// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_drawn_tool_h
#define palpate_drawn_tool_h

#include "haptics/touch_model.h"
#include "placed_actor.h"
#include "tool_look.h"

#include <functional>
#include <memory>
#include <vector>

namespace palpate
{
/// A tool as it is drawn: its parts, the god-object of a point, the force on the hand.
class DrawnTool
{
public:
  /// @param diagonal  of the body that it touches, m, which tells how large marks are.
  DrawnTool(const ToolLook& look, double diagonal);

  /// @param place         where the contact is as it is drawn, m.
  /// @param largestForce  N, of an arrow as long as a quarter of the diagonal.
  void Show(const ToolContact& contact, const Eigen::Vector3d& place, double largestForce);

  std::vector<vtkActor*> Actors() const;

private:
  double Diagonal;
  std::vector<std::unique_ptr<PlacedActor>> Parts;
  std::function<void(const ToolPose&, RigidPose*)> Place;
  std::vector<RigidPose> Poses;
  PlacedActor GodObject, Force;
};
} // namespace palpate

#endif
