// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/snapshot_deformation.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace palpate {

SnapshotDeformation::SnapshotDeformation(std::shared_ptr<const GreensFunctions> greens, int body,
                                         const Eigen::Quaterniond& orientation)
    : greens_(std::move(greens)), body_(body), orientation_(orientation.toRotationMatrix()) {
  if (!greens_) throw std::invalid_argument("there are no Green's functions to deform by");
  displacement_.setZero(3, greens_->nodeCount());
}

std::vector<int> SnapshotDeformation::loadedNodes(const ContactSnapshot& snapshot) const {
  std::vector<int> nodes;
  for (int i = 0; i < snapshot.loadedCount; ++i)
    if (snapshot.loadedBodies[i] == body_ && !greens_->isFixed(snapshot.loadedNodes[i]))
      nodes.push_back(snapshot.loadedNodes[i]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// The loaded nodes and their tractions.
void SnapshotDeformation::collect(const ContactSnapshot& snapshot, double stiffnessScale) {
  nodes_ = loadedNodes(snapshot);
  tractions_.setZero(3 * nodes_.size());
  for (int i = 0; i < snapshot.loadedCount; ++i) {
    const int node = snapshot.loadedNodes[i];
    if (snapshot.loadedBodies[i] != body_ || greens_->isFixed(node)) continue;
    const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin();
    tractions_.segment<3>(3 * place) +=
        orientation_.transpose() * snapshot.loads[i] / (stiffnessScale * greens_->vertexArea(node));
  }
}

void SnapshotDeformation::computeAll(const ContactSnapshot& snapshot, double stiffnessScale) {
  collect(snapshot, stiffnessScale);
  displacement_.setZero();
  greens_->accumulate(nodeList(nodes_), tractions_, displacement_.reshaped());
  for (int node = 0; node < greens_->nodeCount(); ++node)
    if (greens_->isFixed(node)) displacement_.col(node).setZero();
  if (!orientation_.isIdentity(0)) displacement_ = orientation_ * displacement_;
}

void SnapshotDeformation::computeAt(const std::vector<int>& nodes, const ContactSnapshot& snapshot,
                                    double stiffnessScale) {
  for (int node : nodes)
    if (node < 0 || node >= greens_->nodeCount())
      throw std::invalid_argument("there is no node " + std::to_string(node) + " to deform");
  collect(snapshot, stiffnessScale);
  Eigen::VectorXd at = Eigen::VectorXd::Zero(3 * nodes.size());
  greens_->accumulate(nodeList(nodes_), tractions_, nodeList(nodes), at);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    displacement_.col(nodes[i]) = greens_->isFixed(nodes[i])
                                      ? Eigen::Vector3d::Zero()
                                      : Eigen::Vector3d(orientation_ * at.segment<3>(3 * i));
}

}  // namespace palpate
