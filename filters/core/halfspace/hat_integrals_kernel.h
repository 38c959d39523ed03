// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Numbers of an edge of a hat: its ends, and an affine function psi on both sides of it by what it
/// rises a length to the left of the edge and by its values at the ends. Of a line load kSlope is
/// what its breadth grows by a length.
enum HatEdge { kStartX, kStartY, kEndX, kEndY, kSlope, kAtStart, kAtEnd, kHatEdgeSize };

/// Edges, lines and point loads are stored in groups of this many, filled up with ones that bear
/// nothing.
constexpr int kHatGroup = 8;

/// Adds HatMoments' integrals over hat edges, in closed form (hat_integrals.h).
/// @param edges       groupCount groups of kHatEdgeSize times kHatGroup numbers.
/// @param x, y        where.
/// @param moments     5 numbers, in the order of HatMoments.
void addHatEdges(const double* edges, int groupCount, double x, double y, double* moments);

/// The same of line loads: psi times the length from the start, times the number in kSlope's place.
void addLineLoads(const double* lines, int groupCount, double x, double y, double* moments);

/// The same of point loads.
/// @param places      2 by groupCount times kHatGroup, x before y of each group.
/// @param loads       groupCount times kHatGroup.
void addPointLoads(const double* places, const double* loads, int groupCount, double x, double y,
                   double* moments);

}  // namespace palpate
