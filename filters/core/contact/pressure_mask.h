// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

namespace palpate {

/// Radial mask functionals, as functions of distance over radius, zero from 1 on.
enum class MaskShape {
  Linear,    ///< 1 - t, the paper's (section 6.1.2)
  Uniform,   ///< 1
  Gaussian,  ///< exp(-(3 t)^2 / 2), a standard deviation of a third of the radius
  Hertzian,  ///< sqrt(1 - t^2), the pressure under a sphere
};

/// @throws std::invalid_argument for a name other than linear, uniform, gaussian, hertzian.
MaskShape maskShapeFromName(const std::string& name);

/// The functional at a distance of t radii, t >= 0.
double maskValue(MaskShape shape, double t);

/// A vertex pressure mask: the scalar density rho that spreads a force over the nodes around a
/// vertex, with sum of a_j rho_j = 1 (eq. 29-31).
struct VertexMask {
  std::vector<int> nodes;
  Eigen::VectorXd density;  ///< 1/m^2, one a node
};

/// Makes vertex pressure masks by nodal collocation on the free boundary (section 6.1).
///
/// A mask holds the free vertices within the radius that can be reached from its centre along edges
/// within it, with normals less than 90 degrees from the centre's: it never reaches another
/// component of the surface, nor the far side of a wall.
class PressureMasks {
 public:
  /// @param radius  in the mesh's unit, >= 0; below the shortest edge around a vertex the mask is
  ///                the vertex alone, rho = 1 / a.
  /// @throws std::invalid_argument for a radius that is negative or not a number, or for boundary
  ///         types of another number of vertices.
  PressureMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions, MaskShape shape,
                double radius);

  /// @throws std::invalid_argument if the vertex is fixed (its mask would have no free node at its
  ///         centre) or out of range.
  VertexMask at(int vertex) const;

  double radius() const { return radius_; }

 private:
  const SurfaceMesh& mesh_;
  const BoundaryConditions& conditions_;
  MaskShape shape_;
  double radius_;
};

}  // namespace palpate
