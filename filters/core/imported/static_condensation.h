// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "imported/given_matrix.h"
#include "imported/node_places.h"
#include "progress.h"

namespace palpate::imported {

/// The stiffness of some rows while no force acts on the others (R. J. Guyan, "Reduction of
/// stiffness and mass matrices", AIAA Journal 3(2), 1965), of the symmetric part of a matrix:
///     K = K_kk - K_ki K_ii^-1 K_ik.
/// Rows of zeros among the others are left out: nothing moves them. Large sparse matrices are
/// condensed by a multifrontal factorisation, others by LAPACK.
/// @param kept    rows, in the order of the result.
/// @param places  names rows in sentences, and has the others.
/// @return 3 #kept by 3 #kept, symmetric.
/// @throws std::invalid_argument naming a row that the others do not hold in its place;
///         std::runtime_error if a sparse factorisation finds that; std::bad_alloc; Aborted.
Eigen::MatrixXd condensedStiffness(const GivenMatrix& matrix, const std::vector<int>& kept,
                                   const NodePlaces& places, const Progress& progress);

}  // namespace palpate::imported
