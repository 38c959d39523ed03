// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "greens/greens_functions.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// Unit forces that are spread around points of a surface like (1 - r / length)+, r the distance.
struct SpreadLoads {
  std::vector<int> vertices;  ///< free ones in the middles
  double length = 0;          ///< m
};

/// Free vertices far from each other, the first farthest from the support, and a length common to
/// all meshes of a body that are fine enough for it: a fifth of the root of its free surface's
/// area.
/// @param mesh   the coarsest that the loads are meant for; two of its edges are the least length.
/// @param count  at most so many.
SpreadLoads chooseSpreadLoads(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                              int count);

/// How the answers of meshes of one body differ under loads, relative to the first's: one entry a
/// load for which all have all columns.
struct LoadDifferences {
  std::vector<double> field;  ///< of the displacement, L2 over the free surface, in all directions
  std::vector<double> contact;  ///< of the 3 by 3 compliance in the load's middle, Frobenius
  std::vector<double> fieldGrowth, contactGrowth;  ///< the first's norms over the second's

  /// Root mean square, and what 95 % of the entries do not exceed; -1 if there are none.
  static double mean(const std::vector<double>& differences);
  static double most(const std::vector<double>& differences);
};

/// A mesh whose answers are part of a comparison.
struct ComparedMesh {
  const GreensFunctions& greens;
  const SurfaceMesh& mesh;
  std::vector<int> vertices;  ///< #shared: their numbers here; negative for those that it lacks
  double factor = 1;          ///< of its answers
};

/// The sum of factors times answers, at the free vertices of a mesh that all share, if slightly
/// moved.
/// @param meshes  two or more.
/// @param shared  of the mesh that has the loads.
LoadDifferences compareUnderLoads(const std::vector<ComparedMesh>& meshes,
                                  const GreensFunctions& shared, const SpreadLoads& loads);

/// @param finer     over a mesh that has the coarser one's vertices, if slightly moved.
/// @param vertices  #coarser nodes, their numbers in the finer mesh; negative for those that it
///                  lacks, which are not compared.
/// @param loads     of the coarser mesh.
LoadDifferences compareUnderLoads(const GreensFunctions& finer, const SurfaceMesh& finerMesh,
                                  const GreensFunctions& coarser, const SurfaceMesh& coarserMesh,
                                  const std::vector<int>& vertices, const SpreadLoads& loads);

/// Of a finer mesh whose first vertices are the coarser one's.
LoadDifferences compareUnderLoads(const GreensFunctions& finer, const SurfaceMesh& finerMesh,
                                  const GreensFunctions& coarser, const SurfaceMesh& coarserMesh,
                                  const SpreadLoads& loads);

}  // namespace palpate
