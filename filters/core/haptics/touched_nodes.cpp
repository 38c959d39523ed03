// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/touched_nodes.h"

#include <algorithm>
#include <cmath>

#include "contact/unilateral_contact.h"

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The gap outside a Hertz contact (K. L. Johnson, "Contact Mechanics", 1985, eq. 3.42a): of a ball
/// of an effective radius, pressed in by a depth.
double gapAt(double r, double effective, double depth) {
  const double a = std::min(r, std::sqrt(effective * depth));
  const double sunk =
      ((2 * a * a - r * r) * std::asin(a / r) + a * std::sqrt(r * r - a * a)) / (kPi * effective);
  return r * r / (2 * effective) - depth + sunk;
}

/// Where it is so wide.
double radiusOfGap(double gap, double effective, double depth) {
  double low = std::sqrt(effective * depth), high = std::sqrt(2 * effective * (depth + gap));
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (gapAt(middle, effective, depth) < gap ? low : high) = middle;
  }
  return high;
}

/// Of a tool that is large for the mesh. What is left behind is watched to twice the margin. A
/// rigid tool watches the surface as it is deformed, and looks at nodes that are near but for that
/// at half the way to the watch.
TouchedNodes touchedVertices(double radius, const BodySizes& body, double depth, double margin,
                             bool rigid) {
  const double effective = 1 / (1 / radius + 1 / body.radius);
  const double end = std::sqrt(2 * effective * (depth + margin));  // near, undeformed
  const double last = std::sqrt(2 * effective * (depth + 2 * margin));
  const double ahead = rigid ? radiusOfGap(margin, effective, depth) : end;
  const double behind = rigid ? radiusOfGap(2 * margin, effective, depth) : last;
  // A ball's middle goes round the body on a larger circle than its contact.
  const double lever = std::isfinite(radius) ? 1 + radius / body.radius : 1;
  double looks = 2 * end;                       // once as they come near
  for (const double begin : {ahead, behind}) {  // a half of the circle each
    constexpr int steps = 64;
    const double width = std::max(0.0, end - begin) / steps;
    for (int step = 0; step < steps; ++step) {
      const double r = begin + (step + 0.5) * width;
      looks += kPi * r * width * 2 / (gapAt(r, effective, depth) - margin / 2);
    }
  }
  return {kPi * effective * depth / body.nodeArea,
          kPi * (ahead * ahead + behind * behind) / 2 / body.nodeArea, 2 * ahead / body.nodeArea,
          rigid ? looks * lever / body.nodeArea : 0};
}

/// Of a tool that meets triangles inside, all of one size.
/// @param fine  as if it met vertices.
TouchedNodes touchedTriangles(double radius, const BodySizes& body, double depth, double margin,
                              const TouchedNodes& fine) {
  const double effective = 1 / (1 / radius + 1 / body.radius);
  const double triangle = body.nodeArea / 2, edge = std::sqrt(4 * triangle / std::sqrt(3.0));
  const double nearness = UnilateralContact::kNear * margin;
  const auto reach = [&](double gap) { return std::sqrt(2 * effective * gap + gap * gap); };
  TouchedNodes touched = fine;
  // One at first, those that a dent brings near, and as many as vertices under a larger tool.
  touched.pressedInside =
      std::max(1 + 4 * std::min(1.0, depth * depth / (edge * edge)), fine.loaded);
  touched.loaded = 2 + touched.pressedInside;
  // Triangles within reach of a foot: the area of one with a border so wide, over its own.
  const double border = reach(0.6 * nearness + 0.28 * depth);
  touched.inside = 1 + (3 * edge * border + kPi * border * border) / triangle;
  const double ahead = reach(margin), behind = reach(2 * margin);
  touched.watched =
      std::max(fine.watched, kPi * (ahead * ahead + behind * behind) / 2 / body.nodeArea);
  touched.rim = std::max(fine.rim, 2 * ahead / body.nodeArea);
  return touched;
}

}  // namespace

TouchedNodes touchedNodes(double radius, const BodySizes& body, double depth, double margin,
                          bool rigid, bool isPart) {
  const double limit = isPart ? UnilateralContact::kLargeEdgeOfMany : UnilateralContact::kLargeEdge;
  const TouchedNodes fine = touchedVertices(radius, body, depth, margin, rigid);
  const auto large =
      std::upper_bound(body.longestEdges.begin(), body.longestEdges.end(), limit * radius);
  if (!rigid || large == body.longestEdges.end()) return fine;
  const TouchedNodes coarse = touchedTriangles(radius, body, depth, margin, fine);
  const double share = static_cast<double>(body.longestEdges.end() - large) /
                       static_cast<double>(body.longestEdges.size());
  const auto mean = [share](double a, double b) { return (1 - share) * a + share * b; };
  return {mean(fine.loaded, coarse.loaded), mean(fine.watched, coarse.watched),
          mean(fine.rim, coarse.rim),       mean(fine.looks, coarse.looks),
          mean(fine.inside, coarse.inside), mean(fine.pressedInside, coarse.pressedInside)};
}

}  // namespace palpate
