// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "model/support.h"
#include "progress.h"

namespace palpate::imported {

/// Inverts a symmetric positive definite matrix by Cholesky's factors of it with a diagonal of
/// ones.
/// @param matrix  both triangles; replaced by the inverse, exactly symmetric.
/// @return 0, or the row, from 1, at which the matrix is not positive definite to rounding: it is
///         then lost.
/// @throws Aborted.
int invertDefinite(Eigen::MatrixXd& matrix, const Progress& progress = {});

/// How negative a symmetric matrix is: the least eigenvalue, where it is negative, over the
/// largest in size.
struct Negativity {
  double share = 0;  ///< 0, or what lies below the tolerance, to 1 %
  double value = 0;  ///< the eigenvalue itself
  int row = -1;      ///< where a factorisation found it
};

/// By bisection with Cholesky factorisations of M + share |M| I: none but the first where all is
/// well.
/// @param tolerance  negative eigenvalues up to this share are rounding.
/// @throws Aborted.
Negativity negativity(const Eigen::MatrixXd& symmetric, double tolerance,
                      const Progress& progress = {});

/// The rigid motions of some points by the work that a stiffness does against them.
struct RigidMotions {
  /// Ascending, of the work that each point's own stiffness would do; as many as differ.
  Eigen::VectorXd shares;
  RigidMotion weakest;
};

/// @param stiffness  3 #points by 3 #points, symmetric, its diagonal positive.
/// @param points     3 by #points.
/// @param rotations  false for translations alone.
RigidMotions rigidMotions(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& points,
                          bool rotations = true);

}  // namespace palpate::imported
