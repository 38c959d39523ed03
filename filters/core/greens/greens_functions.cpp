// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/greens_functions.h"

#include <cmath>
#include <map>
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

int GreensFunctions::missingCount() const {
  int count = 0;
  for (int node = 0; node < nodeCount(); ++node) count += !isFixed(node) && !hasColumn(node);
  return count;
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

Eigen::Matrix3Xd solveFaceTractions(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                    const Eigen::VectorXi& patches,
                                    const Eigen::Matrix3Xd& faceTractions,
                                    Eigen::Matrix3Xd& applied) {
  if (greens.nodeCount() != mesh.vertexCount())
    throw std::invalid_argument("the Green's functions have " + std::to_string(greens.nodeCount()) +
                                " nodes, the surface " + std::to_string(mesh.vertexCount()) +
                                " vertices");
  if (faceTractions.cols() != mesh.triangleCount() || patches.size() != mesh.triangleCount())
    throw std::invalid_argument("there are " + std::to_string(faceTractions.cols()) +
                                " triangle tractions and " + std::to_string(patches.size()) +
                                " patch numbers for " + std::to_string(mesh.triangleCount()) +
                                " triangles");
  struct Load {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    double area = 0;
  };
  std::map<std::pair<int, int>, Load> loads;  // by node and patch
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      Load& load = loads[{mesh.triangles()(k, f), patches[f]}];
      load.force += mesh.triangleAreas()[f] / 3 * faceTractions.col(f);
      load.area += mesh.triangleAreas()[f] / 3;
    }
  std::map<std::pair<int, int>, int> patchColumn;
  const std::vector<PatchColumn>& stored = greens.info().patchColumns;
  for (std::size_t c = 0; c < stored.size(); ++c)
    patchColumn[{stored[c].node, stored[c].patch}] = static_cast<int>(c);

  applied = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount());
  Eigen::Matrix3Xd given = applied;
  std::vector<int> columns;
  std::vector<double> weights;
  for (const auto& [key, load] : loads) {
    const int node = key.first;
    const auto column = patchColumn.find(key);
    const Eigen::Vector3d traction = load.force / load.area;
    if (load.force.isZero(0)) continue;
    if (column != patchColumn.end()) {
      columns.push_back(column->second);
      weights.insert(weights.end(), traction.data(), traction.data() + 3);
      applied.col(node) += load.force;
    } else if (!greens.isFixed(node)) {
      if (std::abs(load.area - greens.vertexArea(node)) > 1e-9 * load.area)
        throw std::invalid_argument("node " + std::to_string(node) +
                                    " lies on a sharp edge: precompute with patch columns to load "
                                    "its patches apart");
      given.col(node) = traction;
      applied.col(node) += load.force;
    }
  }
  Eigen::Matrix3Xd response = solveReferenceProblem(greens, given);
  greens.accumulatePatches(nodeList(columns),
                           Eigen::Map<Eigen::VectorXd>(weights.data(), weights.size()),
                           response.reshaped());
  return response;
}

}  // namespace palpate
