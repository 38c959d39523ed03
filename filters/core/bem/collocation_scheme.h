// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/body_surface.h"
#include "bem/collocation.h"

namespace palpate::bem {

/// A point of the surface at which the boundary integral equation is evaluated, with the triangles
/// that contain it.
struct CollocationPoint {
  struct Own {
    int triangle;
    Eigen::Vector3d barycentric;
  };
  Eigen::Vector3d position;
  std::vector<Own> own;
};

/// Three rows of the system: the boundary integral equation at some points, averaged.
struct CollocationEquation {
  struct Term {
    int point;
    double weight;  ///< the weights of an equation sum to 1
  };
  std::vector<Term> terms;
  int vertex;                  ///< the vertex whose unknown it goes with
  double area;                 ///< integral of the vertex's hat over the triangles it stands for
  Eigen::Vector3d areaVector;  ///< integral of hat times normal over them
};

/// A traction vector that the reference problem does not prescribe.
struct TractionUnknown {
  int vertex;              ///< a fixed vertex of the body
  std::vector<int> nodes;  ///< the traction nodes that share the vector
  double area;             ///< of those nodes
  int column;              ///< its block column of the system
  /// What the system solves for is traction over scale, 1 / sqrt(area): its column is then as large
  /// as those of displacements, whatever the size of the triangles.
  double scale;
};

/// The unknowns of the reference problem and the equations that determine them.
///
/// Free vertices carry an unknown displacement. At a fixed vertex the traction is unknown on every
/// patch on which the vertex is a corner of a wholly fixed triangle, and given on the others; a
/// fixed vertex without such a triangle carries one traction on all its patches. The first block of
/// columns belongs to the vertices, in order (a displacement, or the first unknown traction);
/// further unknown tractions follow.
///
/// There is one equation for each unknown. Averaged collocation takes the mean of the boundary
/// integral equation under the vertex's hat, by the rule (vertices + 9 centroid) / 12 on each
/// triangle, which is exact for quadratics. Where k >= 2 tractions of a vertex are unknown there
/// are k equations, each a mean over points inside the triangles of one patch and a k-th of those
/// where nothing is unknown, in both kinds of collocation: the equation at the vertex itself could
/// not tell them apart.
struct CollocationScheme {
  CollocationScheme(const BodySurface& body, Collocation kind);

  Collocation kind;
  int equationCount() const { return static_cast<int>(equations.size()); }

  std::vector<TractionUnknown> tractions;
  std::vector<CollocationPoint> points;
  std::vector<CollocationEquation> equations;  ///< in an order that keeps neighbours together
};

}  // namespace palpate::bem
