// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "haptics/touch_session.h"

namespace palpate {

/// What the work on a body depends on.
struct BodySizes {
  int nodes = 0, freeNodes = 0, columns = 0, triangles = 0;
  double nodeArea = 0;  ///< m^2, mean
  double edge = 0;      ///< m, mean
  double radius = 0;    ///< m, of the ball with the same diagonal of its bounding box
  bool reciprocal = false;
  bool knowsWeight = false;  ///< what it does comes with the Green's functions
  std::vector<double> longestEdges;  ///< m, of each triangle, ascending
  // Of pressure masks, if points touch it:
  double maskNodes = 0;         ///< mean number of nodes
  double maskNodesSquared = 0;  ///< mean of its square
  double pointNodes = 0;        ///< under the masks of all corners of a triangle, by area
};

/// Measures a body, masks at a few hundred vertices and triangles.
/// @throws std::invalid_argument as PressureMasks.
BodySizes sizesOf(const SceneBody& body, const Scene& scene);

/// What is assumed of hands and eyes.
struct ExpectedTouch {
  double depth = 0;       ///< m, of each tool, and of a partner, in the surface; 0 for an edge
  double speed = 0.1;     ///< m/s, of tools along the surface
  double visible = 0.5;   ///< share of a body's nodes in view
  double iterations = 8;  ///< of a tick's solve; 4 to 9 in strokes of balls
  double sweeps = 8;      ///< of a tick over points that feel each other; 6 to 9 in strokes
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
/// A ball of radius R pressed into a body of radius R_b by a depth d touches it within a circle
/// (H. Hertz, 1881; see K. L. Johnson, "Contact Mechanics", 1985, section 4.2),
///     a^2 = R_e d,  1 / R_e = 1 / R + 1 / R_b,
/// so that s = pi a^2 / (mean vertex area) vertices bear forces; vertices are watched where the gap
/// (his, outside the circle; of partners that of the undeformed bodies, r^2 / (2 R_e) - d) is less
/// than the solver's margin, and behind a tool that moves to twice that. A mesh is taken as flat, a
/// hand as five fingertips. Depths below half an edge touch more vertices than this says: at least
/// one. Tools smaller than two thirds of an edge touch the insides of triangles: as many as lie
/// within reach of their foot, and those that their dent brings near, by a fit to strokes of balls.
///
/// What is asked of Green's functions, and the memory, are within a fifth of what tests count. The
/// contact solver's own flops and bytes follow from the numbers of vertices, iterations and updates
/// and are estimates: nothing counts them. Surfaces of tools are not among the memory.
struct EvaluationPlan {
  double rate = 1000;              ///< ticks a second
  double loaded = 0, watched = 0;  ///< nodes of the first body under forces; looked after
  std::vector<PlannedWork> setup;  ///< once
  std::vector<PlannedWork> tick, frame;
  std::vector<PlannedMemory> memory;  ///< reserved besides the models
};

/// @param bodies  one for each of the scene's models.
/// @throws std::invalid_argument for another number of bodies.
EvaluationPlan planEvaluation(const Scene& scene, const std::vector<BodySizes>& bodies,
                              const ExpectedTouch& touch = {});

/// The sum of a list.
PlannedWork total(const std::vector<PlannedWork>& list);
double totalBytes(const std::vector<PlannedMemory>& list);

/// As tables to print.
std::string toText(const EvaluationPlan& plan);

}  // namespace palpate
