// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/mask_kernel.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

namespace palpate {

class GeodesicDistances;

/// A vertex pressure mask: the scalar density rho that spreads a force over the nodes around a
/// vertex, with sum of a_j rho_j = 1 (eq. 29-31).
struct VertexMask {
  std::vector<int> nodes;
  Eigen::VectorXd density;  ///< 1/m^2, one a node

  // What the mask would have covered and does not, as shares (0 to 1) of the whole by area. The
  // free nodes within reach take the force of it.
  double supportShare = 0;  ///< fixed vertices
  double beyondShare = 0;   ///< vertices of other components and at the far side of a wall
};

/// Masks of the free vertices of a surface, however they are made.
class VertexMasks {
 public:
  virtual ~VertexMasks() = default;

  /// The mask around a free vertex, that vertex among its nodes, all of them free and on its
  /// component. Safe from several threads.
  /// @throws std::invalid_argument if the vertex is fixed (its mask would have no free node at its
  ///         centre) or out of range.
  virtual VertexMask at(int vertex) const = 0;

 protected:
  /// @throws std::invalid_argument for boundary types of another number of vertices.
  VertexMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions);
  void requireFree(int vertex) const;

  const SurfaceMesh& mesh_;
  const BoundaryConditions& conditions_;
};

/// How far a vertex is from the centre of its mask.
enum class MaskDistance {
  Euclidean,  ///< straight
  Geodesic,   ///< along the surface, by GeodesicDistances: down into a groove and up again
};

/// Makes vertex pressure masks by nodal collocation on the free boundary (section 6.1).
///
/// A mask holds the free vertices within the radius that can be reached from its centre along edges
/// within it, with normals less than 90 degrees from the centre's: it never reaches another
/// component of the surface, nor the far side of a wall. By geodesic distance it does not reach
/// across a groove either.
class PressureMasks : public VertexMasks {
 public:
  /// @param mesh, conditions  must outlive this.
  /// @param radius  in the mesh's unit, >= 0; below the shortest edge around a vertex the mask is
  ///                the vertex alone, rho = 1 / a.
  /// @throws std::invalid_argument for a radius that is negative or not a number, or for boundary
  ///         types of another number of vertices; as GeodesicDistances.
  PressureMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions, MaskShape shape,
                double radius, MaskDistance distance = MaskDistance::Euclidean);

  VertexMask at(int vertex) const override;

  double radius() const { return radius_; }

 private:
  Eigen::VectorXd distancesFrom(int vertex) const;

  MaskShape shape_;
  double radius_;
  std::shared_ptr<const GeodesicDistances> geodesic_;  ///< null for straight distances
};

}  // namespace palpate
