// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/capacitance_matrix.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// Nodes that one tool holds, and the point about which its torque is taken.
struct ContactZone {
  std::vector<int> nodes;
  Eigen::Vector3d centre;
};

/// Local buffer models of one or several contact zones, all coupled through one capacitance matrix
/// ([JP01] sections 5.1-5.3, eq. 21-28): the exact force response to displacements of the zones'
/// nodes, at the cost of the zones alone.
class ContactZones {
 public:
  /// @throws std::invalid_argument for a node that is named twice, fixed or without column, or for
  ///         another surface's Green's functions; and as CapacitanceMatrix does.
  ContactZones(std::shared_ptr<const GreensFunctions> greens, const SurfaceMesh& mesh,
               std::vector<ContactZone> zones);

  const CapacitanceMatrix& capacitance() const { return matrix_; }
  int zoneCount() const { return static_cast<int>(zones_.size()); }

  /// Tractions p_S = -C^-1 u_S (eq. 26, with the sign of a force on the body).
  /// @param displacement  3s, the zones' nodes one after the other, m.
  /// @return 3s, Pa.
  /// @throws std::invalid_argument for another size.
  Eigen::VectorXd tractions(const Eigen::VectorXd& displacement) const;

  /// K_S of eq. 27 for one zone: its force and torque per displacement of every zone's nodes.
  /// @return 6 by 3s; force rows in N/m, torque rows in N.
  /// @throws std::invalid_argument if there is no such zone.
  Eigen::MatrixXd bufferStiffness(int zone) const;

  /// Stiffness between rigid motions of the zones: force and torque on each per translation (m) and
  /// rotation (rad) of each, about their centres. Symmetric where the Green's functions are
  /// reciprocal.
  /// @return 6 #zones by 6 #zones, blocks (force, torque) by (translation, rotation).
  Eigen::MatrixXd rigidStiffness() const;

 private:
  Eigen::MatrixXd motions() const;

  std::vector<ContactZone> zones_;
  CapacitanceMatrix matrix_;
  Eigen::Matrix3Xd positions_;  ///< 3 by s nodes
  Eigen::VectorXd areas_;       ///< s nodes
};

}  // namespace palpate
