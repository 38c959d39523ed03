// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "imported/given_matrix.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

namespace palpate {

/// How the three components of a matrix' nodes follow each other where it does not say.
enum class DofOrder {
  ByNode,       ///< x, y, z of the first node, then of the next
  ByComponent,  ///< x of all nodes, then y, then z
};

namespace imported {

/// Which rows of a matrix belong to the vertices of a surface.
struct NodePlaces {
  Eigen::Matrix3Xi rowsOfVertex;  ///< 3 by #V, -1 where the matrix has no such node
  std::vector<int> others;        ///< rows that belong to no displacement of a vertex, ascending
  int nodeCount = 0;              ///< of the matrix
  std::vector<MatrixDof> dofs;    ///< #rows

  /// "row 7 (node 12, y)", for sentences.
  std::string nameOf(int row) const;
};

/// Finds the vertex at the place of each node. Without places, the nodes are the vertices in their
/// order, or the free ones in theirs if there are as many.
/// @param nodes      in the unit of the surface; none to go by order.
/// @param tolerance  in that unit.
/// @throws std::invalid_argument for sizes that do not go together, numbers without a place, two
///         nodes at one vertex, vertices of which some components are missing, and for a vertex
///         that is not fixed but has no node.
NodePlaces nodePlaces(const GivenMatrix& matrix, const NodeTable& nodes, DofOrder order,
                      const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                      double tolerance);

}  // namespace imported
}  // namespace palpate
