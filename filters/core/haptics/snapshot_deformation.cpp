// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/snapshot_deformation.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace palpate {

namespace {

/// Whether a snapshot's load is on a body's free surface.
bool deforms(const GreensFunctions& greens, const ContactSnapshot& snapshot, int body, int load) {
  return snapshot.loadedBodies[load] == body && !greens.isFixed(snapshot.loadedNodes[load]);
}

std::vector<int> nodesUnderForce(const GreensFunctions& greens, const ContactSnapshot& snapshot,
                                 int body) {
  std::vector<int> nodes;
  for (int i = 0; i < snapshot.loadedCount; ++i)
    if (deforms(greens, snapshot, body, i)) nodes.push_back(snapshot.loadedNodes[i]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

SnapshotTractions snapshotTractions(const GreensFunctions& greens, const ContactSnapshot& snapshot,
                                    int body, const Eigen::Matrix3d& orientation,
                                    double stiffnessScale) {
  std::vector<int> nodes = nodesUnderForce(greens, snapshot, body);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * nodes.size());
  for (int i = 0; i < snapshot.loadedCount; ++i) {
    if (!deforms(greens, snapshot, body, i)) continue;
    const int node = snapshot.loadedNodes[i];
    const auto place = std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
    values.segment<3>(3 * place) +=
        orientation.transpose() * snapshot.loads[i] / (stiffnessScale * greens.vertexArea(node));
  }
  return {std::move(nodes), std::move(values)};
}

SnapshotDeformation::SnapshotDeformation(std::shared_ptr<const GreensFunctions> greens, int body,
                                         const Eigen::Quaterniond& orientation)
    : greens_(std::move(greens)), body_(body), orientation_(orientation.toRotationMatrix()) {
  if (!greens_) throw std::invalid_argument("there are no Green's functions to deform by");
  displacement_.setZero(3, greens_->nodeCount());
}

std::vector<int> SnapshotDeformation::loadedNodes(const ContactSnapshot& snapshot) const {
  return nodesUnderForce(*greens_, snapshot, body_);
}

void SnapshotDeformation::requireNodes(const std::vector<int>& nodes) const {
  for (int node : nodes)
    if (node < 0 || node >= greens_->nodeCount())
      throw std::invalid_argument("there is no node " + std::to_string(node) + " to deform");
}

void SnapshotDeformation::computeAll(const ContactSnapshot& snapshot, double stiffnessScale) {
  const auto [nodes, tractions] =
      snapshotTractions(*greens_, snapshot, body_, orientation_, stiffnessScale);
  displacement_.setZero();
  greens_->accumulate(nodeList(nodes), tractions, displacement_.reshaped());
  for (int node = 0; node < greens_->nodeCount(); ++node)
    if (greens_->isFixed(node)) displacement_.col(node).setZero();
  if (!orientation_.isIdentity(0)) displacement_ = orientation_ * displacement_;
}

void SnapshotDeformation::computeAt(const std::vector<int>& rows, const ContactSnapshot& snapshot,
                                    double stiffnessScale) {
  requireNodes(rows);
  const auto [nodes, tractions] =
      snapshotTractions(*greens_, snapshot, body_, orientation_, stiffnessScale);
  Eigen::VectorXd at = Eigen::VectorXd::Zero(3 * rows.size());
  greens_->accumulate(nodeList(nodes), tractions, nodeList(rows), at);
  for (std::size_t i = 0; i < rows.size(); ++i)
    displacement_.col(rows[i]) = greens_->isFixed(rows[i])
                                     ? Eigen::Vector3d::Zero()
                                     : Eigen::Vector3d(orientation_ * at.segment<3>(3 * i));
}

void SnapshotDeformation::clearAt(const std::vector<int>& nodes) {
  requireNodes(nodes);
  for (int node : nodes) displacement_.col(node).setZero();
}

}  // namespace palpate
