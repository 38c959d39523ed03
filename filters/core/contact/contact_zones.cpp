// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/contact_zones.h"

#include <Eigen/Geometry>
#include <stdexcept>

namespace palpate {
namespace {

std::vector<int> nodesOf(const GreensFunctions& greens, const std::vector<ContactZone>& zones) {
  std::vector<int> nodes;
  for (const ContactZone& zone : zones)
    nodes.insert(nodes.end(), zone.nodes.begin(), zone.nodes.end());
  greens.requireColumns(nodeList(nodes));
  for (int node : nodes)
    if (greens.isFixed(node))
      throw std::invalid_argument("node " + std::to_string(node) +
                                  " of a contact zone is fixed: zones lie on the free surface");
  std::vector<int> zoneOfNode(greens.nodeCount(), -1);
  for (std::size_t z = 0; z < zones.size(); ++z)
    for (int node : zones[z].nodes) {
      if (zoneOfNode[node] >= 0)
        throw std::invalid_argument("node " + std::to_string(node) +
                                    (zoneOfNode[node] == static_cast<int>(z)
                                         ? " is named twice by a contact zone"
                                         : " is in two contact zones"));
      zoneOfNode[node] = static_cast<int>(z);
    }
  return nodes;
}

}  // namespace

ContactZones::ContactZones(std::shared_ptr<const GreensFunctions> greens, const SurfaceMesh& mesh,
                           std::vector<ContactZone> zones)
    : zones_(std::move(zones)), matrix_(greens, switchesOfNodes(nodesOf(*greens, zones_))) {
  if (greens->nodeCount() != mesh.vertexCount())
    throw std::invalid_argument("the Green's functions have " +
                                std::to_string(greens->nodeCount()) + " nodes, the surface " +
                                std::to_string(mesh.vertexCount()) + " vertices");
  const std::vector<int> nodes = nodesOf(*greens, zones_);
  positions_ = mesh.points()(Eigen::all, nodes);
  areas_ = greens->info().vertexAreas(nodes);
}

Eigen::VectorXd ContactZones::tractions(const Eigen::VectorXd& displacement) const {
  if (displacement.size() != matrix_.size())
    throw std::invalid_argument("there are " + std::to_string(displacement.size()) +
                                " displacement components for " + std::to_string(matrix_.size()));
  Eigen::VectorXd values(matrix_.size());
  matrix_.solve(displacement.data(), values.data());
  return values;
}

/// 3s by 6 #zones: displacements of the nodes under unit translations and rotations of each zone.
Eigen::MatrixXd ContactZones::motions() const {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(matrix_.size(), 6 * zoneCount());
  int node = 0;
  for (int z = 0; z < zoneCount(); ++z)
    for (std::size_t i = 0; i < zones_[z].nodes.size(); ++i, ++node)
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(c);
        motion.block<3, 1>(3 * node, 6 * z + c) = axis;
        motion.block<3, 1>(3 * node, 6 * z + 3 + c) =
            axis.cross(positions_.col(node) - zones_[z].centre);
      }
  return motion;
}

Eigen::MatrixXd ContactZones::bufferStiffness(int zone) const {
  if (zone < 0 || zone >= zoneCount())
    throw std::invalid_argument("there is no contact zone " + std::to_string(zone));
  Eigen::MatrixXd weighted = motions().middleCols(6 * zone, 6);
  for (Eigen::Index node = 0; node < areas_.size(); ++node)
    weighted.middleRows<3>(3 * node) *= areas_[node];
  return -weighted.transpose() * matrix_.inverse();
}

Eigen::MatrixXd ContactZones::rigidStiffness() const {
  const Eigen::MatrixXd motion = motions();
  Eigen::MatrixXd stiffness(6 * zoneCount(), 6 * zoneCount());
  for (int z = 0; z < zoneCount(); ++z)
    stiffness.middleRows<6>(6 * z) = bufferStiffness(z) * motion;
  return stiffness;
}

}  // namespace palpate
