// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "model/material.h"

namespace palpate {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Moduli of a material with three planes of symmetry, along its own axes 1, 2, 3; of nu_ij the
/// stress is along i and the contraction along j: nu_ij / E_i = nu_ji / E_j.
struct OrthotropicModuli {
  double young[3];    ///< E_1, E_2, E_3, Pa
  double poisson[3];  ///< nu_12, nu_13, nu_23
  double shear[3];    ///< G_12, G_13, G_23, Pa
};

/// How a point of a body resists strain: stress = stiffness * strain, with stress (xx, yy, zz, yz,
/// xz, xy) and engineering shear strains in the same order (Voigt's). A nearly incompressible
/// isotropic material is split into 2 G e and a pressure (isSplit), which finite elements then
/// carry as an unknown of its own.
class Elasticity {
 public:
  /// From kSplitFrom on it is split; nu = 0.5 is legal.
  explicit Elasticity(const Material& isotropic);

  /// Any of the 21 constants.
  /// @param stiffness  Pa, symmetric to 1e-9 and positive definite.
  /// @throws std::invalid_argument with the smallest eigenvalue if it is not, or is not finite.
  explicit Elasticity(const Matrix6d& stiffness);

  /// @param axes  columns: unit vectors along the material's axes, right-handed.
  /// @throws std::invalid_argument if the moduli leave a strain without resistance or the axes are
  ///         not orthonormal.
  static Elasticity orthotropic(const OrthotropicModuli& moduli, const Eigen::Matrix3d& axes);

  /// Fibres along one direction, all across it alike.
  /// @param fibre    any length but zero.
  /// @param along    E and nu for stress along the fibres.
  /// @param across   E and nu in the plane across them.
  /// @param shear    G along the fibres, Pa.
  static Elasticity transverselyIsotropic(const Eigen::Vector3d& fibre, double youngAlong,
                                          double poissonAlong, double youngAcross,
                                          double poissonAcross, double shearAlong);

  /// The same material turned: its axes x, y, z become the columns of `axes`.
  Elasticity turned(const Eigen::Matrix3d& axes) const;

  /// Pa; without the part of the pressure where isSplit.
  const Matrix6d& stiffness() const { return stiffness_; }
  bool isSplit() const { return isSplit_; }
  /// 1 / lambda where isSplit, 1/Pa: divergence = compressibility times the pressure unknown.
  double compressibility() const { return compressibility_; }

  static constexpr double kSplitFrom = 0.45;

 private:
  Elasticity() = default;

  Matrix6d stiffness_ = Matrix6d::Zero();
  bool isSplit_ = false;
  double compressibility_ = 0;
};

}  // namespace palpate
