// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_tool_look_h
#define palpate_tool_look_h

#include "contact/rigid_shape.h"
#include "haptics/hand_model.h"
#include "haptics/scene.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkPolyData;

namespace palpate
{
/// How a tool is drawn: parts, each in its own frame, and where they are at a pose.
struct ToolLook
{
  std::vector<vtkSmartPointer<vtkPolyData>> Parts; ///< none for a point
  std::function<void(const ToolPose&, RigidPose*)> Place;
  std::vector<int> Felt; ///< a part: which of the tool's arrows its force belongs to
  std::vector<std::string> Names; ///< of those forces; none if there is but one
};

/// A capsule for each bone of a hand.
ToolLook lookOf(const HandModel& hand);
/// @param surface  of a tool that is a mesh.
/// @param reach    half the side of the square that stands for a plane, m.
ToolLook lookOf(const SceneTool& tool, vtkPolyData* surface, double reach);
} // namespace palpate

#endif
