// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/spread_force.h"

namespace palpate {

Eigen::MatrixXd responseTo(const GreensFunctions& greens, const SpreadForce& force) {
  greens.requireColumns(nodeList(force.nodes));
  Eigen::MatrixXd response = Eigen::MatrixXd::Zero(3 * greens.nodeCount(), 3);
  for (int c = 0; c < 3; ++c) {
    Eigen::Matrix3Xd weights = Eigen::Matrix3Xd::Zero(3, force.nodes.size());
    weights.row(c) = force.density.transpose();
    greens.accumulate(nodeList(force.nodes), weights.reshaped(), response.col(c));
  }
  return response;
}

}  // namespace palpate
