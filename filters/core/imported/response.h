// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "progress.h"

namespace palpate::imported {

/// How free and fixed nodes answer to forces on the free and displacements of the fixed ones.
struct Response {
  Eigen::MatrixXd compliance;  ///< 3F by 3F, displacements per force
  Eigen::MatrixXd moved;       ///< 3F by 3X, displacements per displacement
  Eigen::MatrixXd reactions;   ///< 3X by 3F, forces per force
  Eigen::MatrixXd holding;     ///< 3X by 3X, forces per displacement
};

/// @param stiffness  of free nodes, then of fixed ones, symmetric; taken.
/// @param free       how many rows are of free ones.
/// @param row        set to the row at which the stiffness is not positive definite, else to -1;
///                   then there is no response.
/// @throws Aborted.
Response responseOfStiffness(Eigen::MatrixXd stiffness, Eigen::Index free, int& row,
                             const Progress& progress);

/// @param compliance  likewise.
/// @param symmetric   whether it is.
/// @param row         likewise, among the fixed ones.
Response responseOfCompliance(Eigen::MatrixXd compliance, Eigen::Index free, bool symmetric,
                              int& row);

}  // namespace palpate::imported
