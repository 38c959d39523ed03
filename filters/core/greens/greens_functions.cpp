// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/greens_functions.h"

#include <stdexcept>

namespace palpate {

GreensFunctions::GreensFunctions(GreensFunctionsInfo info)
    : info_(std::move(info)), columnOfNode_(info_.conditions.nodeCount(), -1) {
  if (info_.vertexAreas.size() != nodeCount())
    throw std::invalid_argument("there are " + std::to_string(info_.vertexAreas.size()) +
                                " vertex areas for " + std::to_string(nodeCount()) + " nodes");
  for (std::size_t column = 0; column < info_.columnNodes.size(); ++column) {
    const int node = info_.columnNodes[column];
    if (node < 0 || node >= nodeCount() || columnOfNode_[node] >= 0)
      throw std::invalid_argument("node " + std::to_string(node) + " of stored column " +
                                  std::to_string(column) + " is repeated or out of range");
    columnOfNode_[node] = static_cast<int>(column);
  }
}

void GreensFunctions::requireColumns(NodeList nodes) const {
  for (int node : nodes) {
    if (node < 0 || node >= nodeCount())
      throw std::invalid_argument("there is no node " + std::to_string(node) + ": the model has " +
                                  std::to_string(nodeCount()) + " nodes");
    if (!hasColumn(node))
      throw std::invalid_argument("the Green's functions of node " + std::to_string(node) +
                                  " were not computed: name it among the columns to precompute");
  }
}

Eigen::Matrix3Xd solveReferenceProblem(const GreensFunctions& greens,
                                       const Eigen::Matrix3Xd& given) {
  if (given.cols() != greens.nodeCount())
    throw std::invalid_argument("there are " + std::to_string(given.cols()) + " given values for " +
                                std::to_string(greens.nodeCount()) + " nodes");
  std::vector<int> nodes;
  for (int node = 0; node < given.cols(); ++node)
    if (!given.col(node).isZero(0)) nodes.push_back(node);
  greens.requireColumns(nodeList(nodes));
  Eigen::Matrix3Xd weights(3, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) weights.col(i) = given.col(nodes[i]);
  Eigen::Matrix3Xd response = Eigen::Matrix3Xd::Zero(3, given.cols());
  greens.accumulate(nodeList(nodes), weights.reshaped(), response.reshaped());
  return response;
}

}  // namespace palpate
