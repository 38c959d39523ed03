// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_loaded_scene_h
#define palpate_loaded_scene_h

#include "haptics/scripted_device.h"
#include "haptics/touch_session.h"
#include "tool_look.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace palpate
{
/// A scene with what its files hold. Throws what a user can mend, with a sentence.
struct LoadedScene
{
  Scene Described;
  std::vector<SceneBody> Bodies;
  vtkSmartPointer<vtkPolyData> FirstModel; ///< as it was given or read
};

/// A point that the mouse moves on a model that is yet to come.
LoadedScene mouseScene();
LoadedScene loadScene(const std::string& fileName);
SceneBody bodyOf(vtkPolyData* model);

/// Those of the scene's probes inside its first model; null without any.
std::shared_ptr<const ProbeRows> rowsOfProbesInside(const Scene& scene, const SceneBody& body);

/// A tool to draw and, if it is a mesh, to touch with.
struct LoadedTool
{
  ToolLook Look;
  std::shared_ptr<const SurfaceMesh> Mesh;
};
LoadedTool loadTool(const SceneTool& tool, double reach);

/// A recording to replay with a tool, a moment a tick: one that states another rate is refused, as is one
/// without a glove's joints if the tool is a hand.
std::shared_ptr<ScriptedDevice> openScript(
  const SceneDevice& device, const SceneTool& tool, double rate);
std::shared_ptr<HapticDevice> openHid(const SceneDevice& device);
} // namespace palpate

#endif
