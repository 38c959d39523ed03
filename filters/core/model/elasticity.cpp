// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/elasticity.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kAsymmetry = 1e-9, kLeastEigenvalue = 1e-12;
constexpr int kFirst[6] = {0, 1, 2, 1, 0, 0}, kSecond[6] = {0, 1, 2, 2, 2, 1};

void requireDefinite(const Matrix6d& matrix, const char* what) {
  if (!matrix.allFinite()) refuse(what, " holds a value that is not finite");
  if ((matrix - matrix.transpose()).norm() > kAsymmetry * matrix.norm())
    refuse(what, " must be symmetric; it differs from its transpose by ",
           (matrix - matrix.transpose()).norm() / matrix.norm(), " of itself");
  const auto eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix6d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(eigenvalues[0] > kLeastEigenvalue * eigenvalues[5]))
    refuse(what, " must be positive definite: some strain would store no energy (eigenvalues ",
           eigenvalues[0], " to ", eigenvalues[5], ")");
}

void requireOrthonormal(const Eigen::Matrix3d& axes) {
  constexpr double tolerance = 1e-6;
  if (!((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() < tolerance) ||
      axes.determinant() < 0)
    refuse("the axes of a material must be a right-handed set of unit vectors at right angles");
}

/// How stress in Voigt's order turns with the axes (Bond's matrix).
Matrix6d stressTurn(const Eigen::Matrix3d& a) {
  Matrix6d turn;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const int p = kFirst[i], q = kSecond[i], r = kFirst[j], s = kSecond[j];
      turn(i, j) = a(p, r) * a(q, s) + (j < 3 ? 0 : a(p, s) * a(q, r));
    }
  return turn;
}

}  // namespace

Elasticity::Elasticity(const Material& isotropic) {
  const double nu = isotropic.poissonRatio(), shear = isotropic.shearModulus();
  const double oneOverLambda = (1 - 2 * nu) / (2 * shear * nu);
  isSplit_ = nu >= kSplitFrom;
  stiffness_.diagonal() << 2 * shear, 2 * shear, 2 * shear, shear, shear, shear;
  if (isSplit_)
    compressibility_ = oneOverLambda;
  else
    stiffness_.topLeftCorner<3, 3>().array() += 2 * shear * nu / (1 - 2 * nu);
}

Elasticity::Elasticity(const Matrix6d& stiffness) {
  requireDefinite(stiffness, "the stiffness of a material");
  stiffness_ = (stiffness + stiffness.transpose()) / 2;
}

Elasticity Elasticity::orthotropic(const OrthotropicModuli& moduli, const Eigen::Matrix3d& axes) {
  const double* const e = moduli.young;
  for (int i = 0; i < 3; ++i)
    if (!(e[i] > 0) || !(moduli.shear[i] > 0))
      refuse("the moduli of an orthotropic material must be above 0, not ", e[i], " and ",
             moduli.shear[i]);
  Matrix6d compliance = Matrix6d::Zero();
  for (int i = 0; i < 3; ++i) compliance(i, i) = 1 / e[i];
  compliance(0, 1) = compliance(1, 0) = -moduli.poisson[0] / e[0];
  compliance(0, 2) = compliance(2, 0) = -moduli.poisson[1] / e[0];
  compliance(1, 2) = compliance(2, 1) = -moduli.poisson[2] / e[1];
  compliance(3, 3) = 1 / moduli.shear[2];
  compliance(4, 4) = 1 / moduli.shear[1];
  compliance(5, 5) = 1 / moduli.shear[0];
  requireDefinite(compliance, "the compliance of an orthotropic material");
  return Elasticity(Matrix6d(compliance.inverse())).turned(axes);
}

Elasticity Elasticity::transverselyIsotropic(const Eigen::Vector3d& fibre, double youngAlong,
                                             double poissonAlong, double youngAcross,
                                             double poissonAcross, double shearAlong) {
  if (!(fibre.norm() > 0) || !fibre.allFinite()) refuse("the direction of fibres must not be zero");
  Eigen::Matrix3d axes;
  axes.col(0) = fibre.normalized();
  axes.col(1) = axes.col(0).unitOrthogonal();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const double shearAcross = youngAcross / (2 * (1 + poissonAcross));
  return orthotropic({{youngAlong, youngAcross, youngAcross},
                      {poissonAlong, poissonAlong, poissonAcross},
                      {shearAlong, shearAlong, shearAcross}},
                     axes);
}

Elasticity Elasticity::turned(const Eigen::Matrix3d& axes) const {
  requireOrthonormal(axes);
  Elasticity result = *this;
  const Matrix6d turn = stressTurn(axes);
  result.stiffness_ = turn * stiffness_ * turn.transpose();
  return result;
}

}  // namespace palpate
