// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <list>
#include <memory>
#include <vector>

#include "contact/capacitance_matrix.h"
#include "contact/wrench.h"
#include "greens/greens_functions.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// A boundary value problem as it differs from the reference one.
struct BoundaryValues {
  /// Changed constraints. Two at one node must not be parallel.
  std::vector<ConstraintSwitch> switches;
  /// A value a switch: displacement along its direction (m) at a free node, of the far end of its
  /// spring if it has one; traction (Pa) at a released fixed node, besides that of its spring.
  Eigen::VectorXd prescribed;
  /// 3 by #nodes, what the reference BVP prescribes: traction (Pa) at free, displacement (m) at
  /// fixed nodes. Components that are switched do not count. Empty for all zero.
  Eigen::Matrix3Xd given;
};

/// Prescribes the displacements of whole free nodes and releases whole fixed nodes.
/// @param values  3 by #nodes of the list.
BoundaryValues switchWholeNodes(const std::vector<int>& nodes, const Eigen::Matrix3Xd& values);

/// All nodal values of a solved problem.
struct BoundarySolution {
  Eigen::Matrix3Xd displacement;   ///< 3 by #nodes, m
  Eigen::Matrix3Xd traction;       ///< 3 by #nodes, Pa; area times traction is the nodal force
  Eigen::VectorXd switchedValues;  ///< what each switch made unknown: Pa, or m where released
  double condition = 1;            ///< of the scaled capacitance matrix
};

/// Solves boundary value problems near the reference one with capacitance matrices ([JP01] section
/// 4.2). Keeps the inverses of the last problem types. Each is made afresh, so that a solution does
/// not depend on those before it; what changes node by node is for CapacitanceMatrix itself.
class CapacitanceSolver {
 public:
  /// @param mesh        the surface of the Green's functions: positions for the support test.
  /// @param cacheCount  problem types kept, at least 1.
  CapacitanceSolver(std::shared_ptr<const GreensFunctions> greens,
                    std::shared_ptr<const SurfaceMesh> mesh, int cacheCount = 8);

  /// @throws std::invalid_argument for bad nodes, directions or sizes, or if releases would leave a
  ///         body unsupported; std::runtime_error if the constraints cannot be told apart.
  BoundarySolution solve(const BoundaryValues& values);

  /// The solution's unknown part v at selected nodes alone (section 4.3), at the cost of those
  /// rows.
  /// @return 3 by #rows: displacement where the node is free in the reference BVP, else traction
  ///         (components that are switched hold the switch's other value, as in `solve`).
  Eigen::Matrix3Xd solveAt(const BoundaryValues& values, const std::vector<int>& rows);

  /// The inverse that belongs to a set of switches, from the cache if it is there.
  std::shared_ptr<const CapacitanceMatrix> matrixFor(const std::vector<ConstraintSwitch>& switches);

  int cachedCount() const { return static_cast<int>(cache_.size()); }

 private:
  struct Problem;  // checked values with the switched components taken out
  Problem prepare(const BoundaryValues& values);
  void requireSupported(const std::vector<ConstraintSwitch>& switches) const;

  std::shared_ptr<const GreensFunctions> greens_;
  std::shared_ptr<const SurfaceMesh> mesh_;
  int cacheCount_;
  std::list<std::shared_ptr<const CapacitanceMatrix>> cache_;  // last used first
};

/// Force and torque of tractions on a set of nodes, f = a_S^T p_S (eq. 27), about a centre.
/// @param points    3 by #nodes, where the nodes' forces act: the vertices, or forcePoints.
/// @param traction  3 by #nodes.
Wrench wrenchOf(const GreensFunctions& greens, const Eigen::Matrix3Xd& points,
                const std::vector<int>& nodes, const Eigen::Matrix3Xd& traction,
                const Eigen::Vector3d& centre);

/// Where the nodes' forces act. A free vertex is moved as a whole: at the vertex, so that its
/// torque is conjugate to turning the vertices. A fixed one bears a reaction that the boundary
/// element method spreads by its hat function over the patches on which its traction is unknown: at
/// the mean of the surface there, so that the support's torque balances the loads (but for vertices
/// at which several such patches meet, whose tractions are not told apart).
/// @param smoothPatches  #F.
/// @return 3 by #V.
Eigen::Matrix3Xd forcePoints(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             const Eigen::VectorXi& smoothPatches);

}  // namespace palpate
