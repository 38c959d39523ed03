// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/point_contact.h"

#include <algorithm>
#include <Eigen/LU>
#include <map>
#include <stdexcept>

#include "contact/torque_mask.h"

namespace palpate {

PointContact::PointContact(std::shared_ptr<const SurfaceStiffness> stiffness,
                           const SurfacePoint& point)
    : stiffness_(std::move(stiffness)) {
  const SurfaceMesh& mesh = stiffness_->mesh();
  if (point.triangle < 0 || point.triangle >= mesh.triangleCount())
    throw std::invalid_argument("there is no triangle " + std::to_string(point.triangle) +
                                " to touch");
  if (!(point.barycentric.minCoeff() >= -1e-9) || !(std::abs(point.barycentric.sum() - 1) <= 1e-9))
    throw std::invalid_argument(
        "the barycentric coordinates of a contact must not be negative and "
        "must sum to 1");
  std::map<int, double> density;
  for (int k = 0; k < 3; ++k) {
    if (point.barycentric[k] == 0) continue;
    const int vertex = mesh.triangles()(k, point.triangle);
    stiffness_->requireServed(vertex);
    const VertexMask& mask = stiffness_->mask(vertex);
    for (std::size_t j = 0; j < mask.nodes.size(); ++j)
      density[mask.nodes[j]] += point.barycentric[k] * mask.density[j];
  }
  std::vector<double> values;
  for (const auto& [node, value] : density) {
    nodes_.push_back(node);
    values.push_back(value);
  }
  density_ = Eigen::Map<Eigen::VectorXd>(values.data(), values.size());

  staticPoint_ = placeOf(mesh, point);
  hapticStiffness_ = stiffness_->hapticAt(point.triangle, point.barycentric);
  hapticCompliance_ = hapticStiffness_.inverse();
  elasticCompliance_ = complianceHere(point);
}

/// Displacement of the point on the deformed surface per force spread over the combined mask.
Eigen::Matrix3d PointContact::complianceHere(const SurfacePoint& point) const {
  const GreensFunctions& greens = stiffness_->greens();
  const Eigen::Vector3i corners = stiffness_->mesh().triangles().col(point.triangle);
  Eigen::MatrixXd blocks(9, 3 * nodes_.size());
  greens.gather(corners, nodeList(nodes_), blocks.data());
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < nodes_.size() && !greens.isFixed(corners[k]); ++j)
      compliance += point.barycentric[k] * density_[j] * blocks.block<3, 3>(3 * k, 3 * j);
  return compliance;
}

ContactResponse PointContact::respond(const Eigen::Vector3d& force,
                                      const Eigen::Vector3d& hapticDisplacement) const noexcept {
  ContactResponse response;
  response.force = force;
  response.staticPoint = staticPoint_;
  response.hapticDisplacement = hapticDisplacement;
  response.elasticDisplacement = elasticCompliance_ * force;
  response.hapticPoint = response.staticPoint + response.hapticDisplacement;
  response.elasticPoint = response.staticPoint + response.elasticDisplacement;
  return response;
}

ContactResponse PointContact::displace(const Eigen::Vector3d& displacement) const noexcept {
  return respond(hapticStiffness_ * displacement, displacement);
}

ContactResponse PointContact::push(const Eigen::Vector3d& force) const noexcept {
  return respond(force, hapticCompliance_ * force);
}

/// @param tractionOf  an index into nodes_.
template <class Traction>
void PointContact::deformBy(const Traction& tractionOf, Eigen::Matrix3Xd& displacement,
                            Eigen::Matrix3Xd& traction) const {
  const GreensFunctions& greens = stiffness_->greens();
  const int n = greens.nodeCount(), masked = static_cast<int>(nodes_.size());
  displacement.setZero(3, n);
  traction.setZero(3, n);
  // Weights on the stack, a few nodes at a time.
  constexpr int kNodes = 32;
  Eigen::Matrix<double, 3 * kNodes, 1> weights;
  for (int first = 0; first < masked; first += kNodes) {
    const int count = std::min(kNodes, masked - first);
    for (int j = 0; j < count; ++j) weights.segment<3>(3 * j) = tractionOf(first + j);
    greens.accumulate(Eigen::Map<const Eigen::VectorXi>(nodes_.data() + first, count),
                      weights.head(3 * count), displacement.reshaped());
  }
  for (int node = 0; node < n; ++node)
    if (greens.isFixed(node)) displacement.col(node).swap(traction.col(node));
  for (int j = 0; j < masked; ++j) traction.col(nodes_[j]) = tractionOf(j);
}

void PointContact::deform(const Eigen::Vector3d& force, Eigen::Matrix3Xd& displacement,
                          Eigen::Matrix3Xd& traction) const {
  const auto tractionOf = [&](int j) -> Eigen::Vector3d { return density_[j] * force; };
  deformBy(tractionOf, displacement, traction);
}

Eigen::Vector3d PointContact::deform(const Eigen::Vector3d& force, const Eigen::Vector3d& torque,
                                     Eigen::Matrix3Xd& displacement,
                                     Eigen::Matrix3Xd& traction) const {
  const TorqueMask mask = torqueMask(stiffness_->mesh(), {nodes_, density_});
  const auto tractionOf = [&](int j) -> Eigen::Vector3d {
    return density_[j] * force + mask.tensor(j) * torque;
  };
  deformBy(tractionOf, displacement, traction);
  return mask.meanRotation(displacement(Eigen::all, nodes_));
}

}  // namespace palpate
