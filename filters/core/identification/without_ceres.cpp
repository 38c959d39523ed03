// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <stdexcept>

#include "identification/least_squares.h"

namespace palpate {

LeastSquaresSolution solveLeastSquares(const LeastSquaresProblem&) {
  throw std::runtime_error(
      "identification needs Ceres, which this build of Palpate was made without");
}

}  // namespace palpate
