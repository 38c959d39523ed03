// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_locator.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

/// Where the mesh, and not the material, makes a surface feel soft ([JP01] section 6, fig. 4 and 7,
/// table 1): measures of how much of a stiffness field is the mesh's own.
namespace palpate {

/// A stiffness by its principal axes.
struct PrincipalStiffness {
  Eigen::Vector3d values;      ///< N/m, the stiffest first
  Eigen::Matrix3d directions;  ///< a unit column each
  double condition;            ///< the stiffest over the softest
};

/// @param stiffness  symmetric positive definite, N/m.
/// @param outward    what the directions point along with, where they can, e.g. a vertex normal.
PrincipalStiffness principalStiffness(const Eigen::Matrix3d& stiffness,
                                      const Eigen::Vector3d& outward);

/// How much of the field |K| is the mesh's. Vertices that are fixed or have no stiffness are left
/// out of everything, and NaN in the fields.
struct StiffnessArtifacts {
  Eigen::VectorXd smooth;    ///< #V, N/m: |K| without what varies within the smoothing length
  Eigen::VectorXd artifact;  ///< #V: |K| / smooth - 1
  Eigen::VectorXd jump;      ///< #V: the largest relative jump of the vertex's edges
  int vertices = 0;          ///< that count
  /// Standard deviation of |K| / smooth over its mean, both by area.
  double variation = 0;
  /// Spearman's rank correlation of |K| with the vertex areas: single vertices are the stiffer the
  /// more area bears their force. 0 if all areas or all values are equal. Where a masked field
  /// keeps a correlation, areas go with the body's shape.
  double areaCorrelation = 0;
  /// Largest | |K_i| - |K_j| | over their mean, of all edges (i, j).
  double largestJump = 0;
  int jumpFrom = -1, jumpTo = -1;  ///< that edge
};

/// The smooth part is the penalised fit of [JP01] appendix A to ln |K|: it makes the integral of
/// (f - s)^2 + length^4 (div grad s)^2 over the free surface least (VariationalMasks, biharmonic).
/// - By a physical length, not by edges or numbers of modes: meshes of one body lose the same.
/// - Of fourth order: waves of 2 pi lengths pass by half, twice as long ones by 94 % and half as
///   long ones by 6 %; the second order's 80 % and 20 % would not tell the two apart.
/// - Of the logarithm: a vertex's area multiplies its stiffness, and ratios are what is felt. The
///   measures are the same in any unit.
/// @param norms   #V, |K|_F in N/m, NaN where there is none.
/// @param length  in the mesh's unit, > 0 and at most the mesh's diagonal.
/// @throws std::invalid_argument for another size or length, a norm that is not above 0, or if
///         fewer than three free vertices have a stiffness.
StiffnessArtifacts findStiffnessArtifacts(const SurfaceMesh& mesh,
                                          const BoundaryConditions& conditions,
                                          const Eigen::VectorXd& norms, double length);

/// Spearman's rank correlation, ties at their mean rank; 0 if all values of either are equal.
/// @param x, y  of one size, finite.
double rankCorrelation(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// How a stiffness differs from that of another mesh of the body at the same points.
struct StiffnessChange {
  Eigen::VectorXd change;  ///< #V: |K| over the other's, minus 1; NaN without one
  int matched = 0;         ///< vertices with a counterpart
  double median = 0;       ///< of the change, by area: one field stiffer throughout
  double variation = 0;    ///< standard deviation of the ratio over its mean, by area
  double ninetyFifth = 0;  ///< 95 % of the matched area has |change| at most this
};

/// Compares at the nearest point of the other surface, with K interpolated as in eq. 34. It counts
/// as the same point if the normals are within 60 degrees and it is no further than one mean edge
/// of the coarser surface; and if all that K is interpolated from is free.
/// @param norms      #V, N/m, NaN where there is none.
/// @param other      over the other surface, in the same frame and unit.
/// @param stiffness  of its vertices, NaN where there is none.
/// @throws std::invalid_argument for other sizes, or if less than half of the free area has a
///         counterpart.
StiffnessChange compareStiffness(const SurfaceMesh& mesh, const Eigen::VectorXd& norms,
                                 const SurfaceLocator& other,
                                 const std::vector<Eigen::Matrix3d>& stiffness);

/// The compliance of single vertices of sizes h, after [JP01] fig. 4: a unit force on a vertex
/// sinks it by about c / h, without bound as the mesh is refined, beside what the body yields as a
/// whole.
struct PointSingularity {
  double exponent = 0;     ///< p of the power law h^-p nearest to the compliances, in logarithms
  double exponentFit = 0;  ///< its coefficient of determination, R^2
  double body = 0;         ///< b of b + c / h by least squares, m/N
  double coefficient = 0;  ///< c, m^2/N
  double fit = 0;          ///< R^2
};

/// @param sizes        h > 0 of each mesh, e.g. the root of the vertex's area, m.
/// @param compliances  m/N, > 0, e.g. |K^-1|_F.
/// @throws std::invalid_argument for fewer than two different sizes or other values.
PointSingularity fitPointSingularity(const Eigen::VectorXd& sizes,
                                     const Eigen::VectorXd& compliances);

}  // namespace palpate
