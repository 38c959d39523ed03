// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_loaded_scene_h
#define palpate_loaded_scene_h

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

/// A tool to draw and, if it is a mesh, to touch with.
struct LoadedTool
{
  ToolLook Look;
  std::shared_ptr<const SurfaceMesh> Mesh;
};
LoadedTool loadTool(const SceneTool& tool, double reach);

/// Opens a recording, a simulated hand or a HID device; not the mouse, which is the window's.
std::shared_ptr<HapticDevice> openDevice(const SceneDevice& device);
} // namespace palpate

#endif
