// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "haptics/touch_session.h"

namespace palpate {

/// The stiffness of a body to a scene's tools with a shape.
struct ToolStiffness {
  double stiffness = 0;  ///< N/m; 0 where no tool found anything to press
  double depth = 0;      ///< m, at which the stiffest tool has it
};

/// StabilityLab's |K| of each tool by itself, pressed in by a hundredth of the body's diagonal or
/// its radius, where that is less, and the largest of them (deeper, a contact grows stiffer still):
/// of balls, capsules along their axis and hands (taken as balls with the thumb's radius) at up to
/// two dozen vertices all over the body, of planes and meshes where planPress presses. At a
/// stiffness scale of one.
/// @throws std::invalid_argument as TouchSession.
ToolStiffness toolStiffness(const Scene& scene, const std::vector<SceneBody>& bodies,
                            const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes);

}  // namespace palpate
