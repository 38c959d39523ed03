// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "imported/given_matrix.h"

namespace palpate::imported {

bool isHarwellBoeing(std::string_view bytes);

/// An assembled real matrix in Harwell and Boeing's format, symmetric or not, as Ansys' HBMAT
/// writes it (I. S. Duff, R. G. Grimes, J. G. Lewis, "Users' guide for the Harwell-Boeing sparse
/// matrix collection", 1992). Right-hand sides behind it are passed over.
/// @throws std::invalid_argument naming the line for anything else.
GivenMatrix readHarwellBoeing(std::string_view bytes, const std::string& path);

/// The mapping file that Ansys' HBMAT writes beside a matrix: after a heading, a line of equation,
/// node and degree of freedom for each row.
/// @param size  of the matrix.
/// @throws std::invalid_argument naming the line, or a row that has none or two.
std::vector<MatrixDof> readMapping(std::string_view bytes, int size, const std::string& path);

}  // namespace palpate::imported
