// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptics/touch_rehearsal.h"
#include "haptics/touch_session.h"
#include "progress.h"

namespace palpate {

/// What is assumed of hands and eyes.
struct ExpectedTouch {
  double depth = 0;      ///< m, of each tool with a shape: RehearsalSettings::depth
  double speed = 0;      ///< m/s, of tools along the surface; 0 for RehearsalSettings' choice
  double visible = 0.5;  ///< share of a body's nodes in view
  double sweeps = 8;     ///< of a tick over points that feel each other; 6 to 9 in strokes
};

/// One thing that is computed. Rows and columns of Green's functions are nodes of three each.
struct PlannedWork {
  std::string what;
  double rows = 0, columns = 0;
  double flops = 0;
  double bytes = 0;  ///< read of Green's functions, or of the contact's own matrices
};

struct PlannedMemory {
  std::string what;
  double bytes = 0;
};

/// What a scene will compute, before it does: nothing is listed that its effects do not ask for.
///
/// What tools with a shape compute depends on where they go over the mesh, and how they are held:
/// it is rehearsed (rehearse), with the scene's tools and solver on its bodies, and counted. Other
/// strokes of the same depth and speed are within a fifth of it, in the mean over as many. What
/// points compute, frames and the memory follow from the scene and the sizes of its bodies, and are
/// within a fifth of what tests count. Surfaces of tools are not among the memory.
struct EvaluationPlan {
  double rate = 1000;              ///< ticks a second
  double loaded = 0, watched = 0;  ///< nodes of the first body under forces; looked after
  std::vector<PlannedWork> setup;  ///< once
  std::vector<PlannedWork> tick, frame;
  std::vector<PlannedMemory> memory;  ///< reserved besides the models
  RehearsedTouch rehearsed;           ///< without strokes for points
};

/// @param bodies      one for each of the scene's models.
/// @param toolMeshes  as TouchSession.
/// @throws std::invalid_argument for another number of bodies, as PressureMasks and rehearse;
///         Aborted if `progress` asks for it.
EvaluationPlan planEvaluation(
    const Scene& scene, const std::vector<SceneBody>& bodies, const ExpectedTouch& touch = {},
    const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes = {},
    const Progress& progress = {});

/// The sum of a list.
PlannedWork total(const std::vector<PlannedWork>& list);
double totalBytes(const std::vector<PlannedMemory>& list);

/// As tables to print.
std::string toText(const EvaluationPlan& plan);

}  // namespace palpate
