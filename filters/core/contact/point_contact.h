// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>

#include "contact/surface_stiffness.h"
#include "mesh/surface_point.h"

namespace palpate {

/// The points of a contact ([JP01] fig. 8) and what acts there.
struct ContactResponse {
  Eigen::Vector3d force;                ///< on the body, N
  Eigen::Vector3d staticPoint;          ///< x^C, on the undeformed surface
  Eigen::Vector3d elasticPoint;         ///< x^E, the same material point deformed
  Eigen::Vector3d hapticPoint;          ///< x^H, where the probe is
  Eigen::Vector3d elasticDisplacement;  ///< u^E = x^E - x^C
  Eigen::Vector3d hapticDisplacement;   ///< u^H = x^H - x^C
};

/// Point-like contact anywhere on a surface through its vertices' masks ([JP01] section 6.3). All
/// that depends on the place is computed by the constructor; what is asked of it afterwards
/// allocates nothing.
class PointContact {
 public:
  /// @throws std::invalid_argument if the triangle or the barycentric coordinates are out of range;
  ///         as maskedVertexStiffness if a vertex of the point has no stiffness.
  PointContact(std::shared_ptr<const SurfaceStiffness> stiffness, const SurfacePoint& point);

  /// Force of a prescribed displacement, f = K^H(x) u^H (eq. 34). The elastic displacement that
  /// goes with it differs from the haptic one between vertices, where K is interpolated, at
  /// vertices by what symmetrising takes from the compliance, and where the surface is stiffer than
  /// k_Rigid. Where the stiffness is by the mean displacement, it is the mean under a vertex's mask
  /// that is the haptic one, and the material point moves farther.
  ContactResponse displace(const Eigen::Vector3d& displacement) const noexcept;

  /// Displacement under a prescribed force, u^H = K^H(x)^-1 f.
  ContactResponse push(const Eigen::Vector3d& force) const noexcept;

  /// All nodes' displacements and tractions under a force here (eq. 35): each vertex of the
  /// triangle that is free carries its barycentric share, spread by its mask. The share of a fixed
  /// vertex goes into the support.
  /// @param displacement, traction  3 by #nodes, overwritten (resized if need be); m, Pa.
  void deform(const Eigen::Vector3d& force, Eigen::Matrix3Xd& displacement,
              Eigen::Matrix3Xd& traction) const;

  /// The same under a force and a torque, both spread by the point's mask (TorqueMask); the force
  /// acts in the mask's centre, to which the torque refers.
  /// @param torque  on the body, N m.
  /// @return  the mean rotation under the mask that the force and the torque come to, rad.
  /// @throws std::invalid_argument as torqueMask.
  Eigen::Vector3d deform(const Eigen::Vector3d& force, const Eigen::Vector3d& torque,
                         Eigen::Matrix3Xd& displacement, Eigen::Matrix3Xd& traction) const;

 private:
  ContactResponse respond(const Eigen::Vector3d& force,
                          const Eigen::Vector3d& hapticDisplacement) const noexcept;
  Eigen::Matrix3d complianceHere(const SurfacePoint& point) const;
  template <class Traction>
  void deformBy(const Traction& tractionOf, Eigen::Matrix3Xd& displacement,
                Eigen::Matrix3Xd& traction) const;

  std::shared_ptr<const SurfaceStiffness> stiffness_;
  Eigen::Vector3d staticPoint_;
  Eigen::Matrix3d hapticStiffness_, hapticCompliance_;  ///< K^H(x) and its inverse
  Eigen::Matrix3d elasticCompliance_;  ///< u^E per force, by eq. 35 interpolated at the point
  std::vector<int> nodes_;             ///< of the combined mask
  Eigen::VectorXd density_;  ///< sum over the triangle's free vertices of phi_i(x) rho^i_j, 1/m^2
};

}  // namespace palpate
