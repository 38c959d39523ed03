// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "greens/greens_functions.h"

namespace palpate {

/// How a force at a point is spread over free nodes, as a mask does: their traction is density
/// times force.
struct SpreadForce {
  std::vector<int> nodes;
  Eigen::VectorXd density;  ///< 1/m^2, one a node
};

/// The response of all nodes to unit forces along x, y and z.
/// @return 3 #nodes by 3: metres at free, pascals at fixed nodes.
/// @throws std::invalid_argument for a node without column.
Eigen::MatrixXd responseTo(const GreensFunctions& greens, const SpreadForce& force);

}  // namespace palpate
