// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mesh/surface_mesh.h"

namespace palpate {

/// Distances along a surface by the heat method (Crane, Weischedel & Wardetzky, "Geodesics in
/// heat", 2013; CGAL's Heat_method_3 on the intrinsic Delaunay triangulation of each shell).
///
/// The method smooths over an edge length or so, where masks are small. So what it gives is kept
/// between two bounds of the polyhedron's true geodesic distance: the straight distance and the
/// shortest way along edges.
///
/// The constructor factors two sparse matrices a shell; a query costs two solves. Queries are safe
/// from several threads, one at a time at work on a shell; they allocate.
class GeodesicDistances {
 public:
  /// @param mesh  must outlive this.
  /// @throws std::runtime_error if a factorisation fails, or where Palpate was built without CGAL.
  explicit GeodesicDistances(const SurfaceMesh& mesh);
  ~GeodesicDistances();

  /// Distances from a vertex, #V, in the mesh's unit; infinite on other shells.
  /// @throws std::invalid_argument if there is no such vertex.
  Eigen::VectorXd from(int vertex) const;

 private:
  struct Shell;
  const SurfaceMesh& mesh_;
  std::vector<std::unique_ptr<Shell>> shells_;
  std::vector<int> indexInShell_;  ///< #V
};

}  // namespace palpate
