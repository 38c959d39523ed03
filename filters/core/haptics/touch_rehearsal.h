// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "haptics/touch_session.h"
#include "progress.h"

namespace palpate {

/// How tools with a shape stroke a body to find out what a scene computes.
struct RehearsalSettings {
  /// m, of each tool in the surface; 0 for a mean edge, or the tool's radius where that is less.
  double depth = 0;
  double speed = 0;  ///< m/s along the surface; 0 for handSpeed
  unsigned seed = 1;
  /// Strokes go on, kLeastStrokes to kMostStrokes, until the standard errors of what a tick asks of
  /// Green's functions, and of its solver's work, are below this share of them.
  double error = 0.04;
  static constexpr int kLeastStrokes = 16, kMostStrokes = 600;
  static constexpr int kStrokeTicks = 140, kSinkingTicks = 40;  ///< the latter are not counted
};

/// At which a tool is stroked along a surface: 0.1 m/s of the hand, enlarged by its device's
/// mapping.
double handSpeed(const Scene& scene, const SceneTool& tool);

/// What was counted, in the mean over the ticks of all strokes.
struct RehearsedTouch {
  int strokes = 0;
  double error = 0;               ///< relative, of the mean: the larger of the two
  double depth = 0, speed = 0;    ///< of the first tool: m, in the mean; m/s
  double watched = 0;             ///< points
  double gatheredBlocks = 0;      ///< of Green's functions, for the compliance of contacts
  double displacementBlocks = 0;  ///< and for displacements of points that are not watched
  double solverMultiplications = 0, solverBytes = 0;  ///< ContactWork
  std::vector<double> loaded, loadedSquared;          ///< nodes under forces, a body
};

/// Steps the scene's tools and solver over its bodies: strokes from places chosen at random, all
/// parts of the first body's free surface alike, in directions chosen at random, from seeds of
/// their own. Balls and capsules (along their axis) follow the surface at the depth, other tools
/// are lifted until the part of the undeformed surface that lies deepest does where they begin.
/// None sinks in farther than to the force that its device's hand is given at most.
/// @throws std::invalid_argument as TouchSession, and for points; Aborted if `progress` asks for
///         it.
RehearsedTouch rehearse(const Scene& scene, const std::vector<SceneBody>& bodies,
                        const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes = {},
                        const RehearsalSettings& settings = {}, const Progress& progress = {});

}  // namespace palpate
