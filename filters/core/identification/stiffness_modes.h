// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// Leading modes of a random field over a body (Karhunen 1947, Loeve 1948): fields b_k such that
/// sum a_k b_k with independent standard normal a_k has the variance 1 and the correlation
/// exp(-d^2 / 2 l^2) at a distance d, but for what the modes left out would add. They are found by
/// Nystroem's method from some of the cells (Drineas and Mahoney, J. Mach. Learn. Res. 6, 2005).
/// @param centres  3 by #T, of cells.
/// @param volumes  #T, the weight with which each cell counts.
/// @param length   l, m.
/// @param count    of modes; fewer come back where the field has fewer beyond rounding.
/// @return #T by #modes.
/// @throws std::invalid_argument for a length that is not positive or below a cell's, or no modes.
Eigen::MatrixXd stiffnessModes(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& volumes,
                               double length, int count);

}  // namespace palpate
