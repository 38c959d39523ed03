// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace palpate::imported {

bool isNumpy(std::string_view bytes);

/// A two-dimensional array of a .npy file (NumPy Enhancement Proposal 1; versions 1 to 3) of
/// little-endian float32 or float64, in the order of C or Fortran.
/// @param path  for sentences.
/// @throws std::invalid_argument for any other array, and unless the file is exactly as long as it
///         says.
Eigen::MatrixXd readNumpy(std::string_view bytes, const std::string& path);

}  // namespace palpate::imported
