// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "contact/pressure_mask.h"
#include "greens/greens_functions.h"

namespace palpate::test {

/// B of a masked vertex, the sum over j of rho_j Xi_ij, m/N.
inline Eigen::Matrix3d vertexCompliance(const GreensFunctions& greens, int vertex,
                                        const VertexMask& mask) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), block;
  for (std::size_t j = 0; j < mask.nodes.size(); ++j) {
    greens.gather(nodeList({vertex}), nodeList({mask.nodes[j]}), block.data());
    sum += mask.density[j] * block;
  }
  return sum;
}

/// M of a mask, the sum over i of a_i rho_i times that of row i, made symmetric.
inline Eigen::Matrix3d meanCompliance(const GreensFunctions& greens, const VertexMask& mask) {
  Eigen::MatrixXd blocks(3 * mask.nodes.size(), 3 * mask.nodes.size());
  greens.gather(nodeList(mask.nodes), nodeList(mask.nodes), blocks.data());
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < mask.nodes.size(); ++i)
    for (std::size_t j = 0; j < mask.nodes.size(); ++j)
      mean += greens.vertexArea(mask.nodes[i]) * mask.density[i] * mask.density[j] *
              blocks.block<3, 3>(3 * i, 3 * j);
  return (mean + mean.transpose()) / 2;
}

}  // namespace palpate::test
