// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/pressure_mask.h"
#include "contact/surface_stiffness.h"

namespace palpate {

/// The tensor-valued mask that spreads a torque over the nodes of a pressure mask ([JP01] footnote
/// 7), p_j = rho_j (J^-1 tau) x (x_j - c): the field of a rigid rotation, as dense as the pressure.
/// c is the pressure's centre, the mean of x_j by a_j rho_j, and J = sum of a_j rho_j (r^2 1 - r
/// r^T), r = x_j - c. So the tractions add up to no force and to the torque tau, about any point.
struct TorqueMask {
  std::vector<int> nodes;
  Eigen::VectorXd share;           ///< a_j rho_j, one a node
  Eigen::VectorXd density;         ///< rho_j, 1/m^2
  Eigen::Matrix3Xd arms;           ///< x_j - c, m
  Eigen::Vector3d centre;          ///< c, m
  Eigen::Matrix3d inverseInertia;  ///< J^-1, 1/m^2

  /// Traction at a node per torque: p_j = tensor(j) tau. 1/m^3.
  /// @param index  into nodes.
  Eigen::Matrix3d tensor(int index) const;

  /// The mean rotation under the mask, on which the torque does its work: the rotation whose
  /// displacements are nearest to these, weighted by the mask. rad.
  /// @param displacements  3 by #nodes, m.
  Eigen::Vector3d meanRotation(const Eigen::Matrix3Xd& displacements) const;
};

/// @throws std::invalid_argument if the mask's nodes lie on one line or it pulls so much that J is
///         not positive definite: a single vertex takes up no torque.
TorqueMask torqueMask(const SurfaceMesh& mesh, const VertexMask& mask);

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// What a force at the mask's centre and a torque, both spread by the mask, move and turn it by in
/// the mean: (u, theta) = compliance (f, tau). m/N, 1/N, 1/(N m). Symmetric where the Green's
/// functions are reciprocal.
/// @throws std::invalid_argument if a column is missing.
Matrix6d wrenchCompliance(const GreensFunctions& greens, const TorqueMask& mask);

/// Torque per rotation about a mask's centre that is free to move, N m/rad: the inverse of the
/// compliance's last block, made symmetric.
/// @throws as wrenchCompliance; std::runtime_error if it is not positive definite.
Eigen::Matrix3d rotationalStiffness(const GreensFunctions& greens, const TorqueMask& mask);

/// That of all vertices; NaN where fixed and where it cannot be had (see torqueMask,
/// rotationalStiffness).
/// @throws Aborted.
std::vector<Eigen::Matrix3d> rotationalStiffnesses(const SurfaceStiffness& stiffness,
                                                   const ProgressCallback& progress = {});

}  // namespace palpate
