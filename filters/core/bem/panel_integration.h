// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// The inner loop of the boundary element method: integrals of the Kelvin kernels times hat
// functions over flat triangles, for a *panel* of eight collocation points at a time. The
// implementation is compiled once per instruction set and chosen at run time, so this header holds
// plain data only.

namespace palpate::bem {

constexpr int kLanes = 8;  ///< collocation points of a panel

/// A quadrature rule on a triangle made of the centroid and two triples (1 - 2 b, b, b), or of one
/// triple alone.
struct PanelRule {
  double centroidWeight;      ///< weights sum to 1 over the points
  double weight[2], near[2];  ///< of a triple's points: weight, and 1 - 2 b
  double smallestDistance;    ///< from the centroid, in triangle radii, at which it is accurate
};

/// A triangle's plane, as closed forms need it, in non-dimensional coordinates.
struct TriangleFrame {
  double axis1[3], axis2[3];  ///< with the normal a right-handed frame; axis1 along the first edge
  double planar[3][2];        ///< the vertices in that frame, relative to vertex 0
  double tangent[3][2];       ///< of the edge from vertex k to k + 1, in the frame
  double outward[3][2];       ///< in-plane normal of that edge
  double length[3];           ///< of that edge
  double gradient[3][2];      ///< of vertex k's hat function
};

/// A triangle as every point sees it, in non-dimensional coordinates: kept small, as a panel reads
/// all of them.
struct PanelTriangle {
  double vertex[3][3];
  double normal[3];
  double centroid[3];
  double area;
  double radius;               ///< largest distance from the centroid to a vertex
  const TriangleFrame* frame;  ///< what only near points need
  int vertexIndex[3];          ///< block of H to add to
  int tractionNode[3];         ///< block of G to add to
};

/// Marks the lanes of a panel whose point lies on the triangle: barycentric coordinates there, and
/// zeros in every other lane.
struct OwnTriangle {
  double barycentric[3][kLanes];
  double mask[kLanes];  ///< 1 where the point lies on the triangle, else 0
};

/// One panel's work. H blocks hold 9 components (row-major 3 by 3) of kLanes values, G blocks the 6
/// components xx, xy, xz, yy, yz, zz of kLanes values.
///
/// On a point's own triangles the hat functions of H are taken less their value at the point: what
/// is left out is the same for all and follows from rigid translation.
struct PanelTask {
  double x[3][kLanes];  ///< collocation points
  const PanelTriangle* triangles;
  int triangleCount;
  const int* ownIndex;  ///< #triangles, index into `own`, or -1
  const OwnTriangle* own;
  PanelRule nearRule, farRule;  ///< seven points, three points
  double poissonRatio;
  double* h;                        ///< #V blocks, added to
  double* g;                        ///< #traction nodes blocks, added to
  long* closedFormCount = nullptr;  ///< counts, unless null, the pairs integrated in closed form
};

/// Adds the integrals of all triangles to a panel's blocks, for unit shear modulus:
///   H_j += integral of T(x, y) phi_j(y) dS_y,   G_j += integral of U(x, y) phi_j(y) dS_y,
/// with Kelvin's displacement U and traction T (load at x, response at y). Far triangles use the
/// cheapest rule that their distance admits, near and singular ones closed forms.
void integratePanel(const PanelTask& task);

/// Blocks of equations from blocks at points, of `components` rows of kLanes values each:
///   equations[places[b]][c][e] += sum over p of weights[p][e] points[b][c][p],
///   sums[c][p] += sum over b of points[b][c][p];
/// the points' values are zero afterwards.
/// @param weights     kLanes points by kLanes equations.
/// @param places      count places of blocks among those of the equations.
/// @param components  9 or 6.
void averageBlocks(const double* weights, const int* places, long count, int components,
                   double* points, double* equations, double* sums);

/// sums[s][c] = sum over v of m_s(v) h[v][c], for m = 1, x, y, z, in each of the kLanes rows.
/// @param h          count blocks of 9 components of kLanes values.
/// @param positions  x, y, z of each block's vertex.
/// @param sums       4 by 9 by kLanes, overwritten.
void sumBlocks(const double* h, long count, const double* positions, double* sums);

}  // namespace palpate::bem
