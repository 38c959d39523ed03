// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "haptics/evaluation_plan.h"

namespace palpate {

/// What one tool of a radius touches, on average over places.
struct TouchedNodes {
  double loaded = 0;         ///< nodes under forces
  double watched = 0;        ///< vertices
  double rim = 0;            ///< vertices that a metre of travel brings in
  double looks = 0;          ///< at vertices that it has pressed away, in a metre of travel
  double inside = 0;         ///< triangles whose deepest points are watched
  double pressedInside = 0;  ///< of those, under forces
};

/// As planEvaluation states.
/// @param depth   m, of the tool in the surface.
/// @param margin  m, UnilateralContactSettings::margin.
/// @param rigid   whether it is a tool and not an elastic body.
/// @param isPart  whether of several of one tool.
TouchedNodes touchedNodes(double radius, const BodySizes& body, double depth, double margin,
                          bool rigid, bool isPart = false);

}  // namespace palpate
