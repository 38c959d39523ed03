// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.h"
#include "mesh/tetrahedral_mesh.h"
#include "progress.h"

namespace palpate {

/// What the material inside a surface is cut into.
struct Tetrahedralization {
  /// Its first points are the surface's vertices in their order, then those of its boundary that
  /// are new, then the inner ones.
  TetrahedralMesh mesh;
  int newBoundaryPoints = 0;
  /// Triangles of the surface that its boundary does not have: others of the same vertices, or of
  /// new ones, lie in their place.
  int lostTriangles = 0;
};

/// Cuts the inside of a closed surface into tetrahedra by Delaunay refinement, with all vertices of
/// the surface kept (CGAL's Mesh_3 with every vertex as a corner), and betters the worst dihedral
/// angles by perturbation and exudation, which on some regular meshes do not end by themselves and
/// then are stopped, after 10 s and 0.02 s a vertex. But for these the result is the same on each
/// run.
/// @param cellSize  largest circumradius of a tetrahedron, m; 0 lets them grow with the distance
///                  from the surface.
/// @throws std::invalid_argument for a negative cell size, or one that would make more than ten
///         million tetrahedra; std::runtime_error if the result lost a vertex, or the library was
///         built without CGAL; Aborted before the work begins.
Tetrahedralization tetrahedralize(const SurfaceMesh& surface, double cellSize = 0,
                                  const ProgressCallback& progress = {});

}  // namespace palpate
