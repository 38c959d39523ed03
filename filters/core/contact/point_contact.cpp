// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/point_contact.h"

#include <algorithm>
#include <Eigen/LU>
#include <limits>
#include <map>
#include <stdexcept>

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

  staticPoint_ =
      mesh.points()(Eigen::all, mesh.triangles().col(point.triangle)) * point.barycentric;
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

void PointContact::deform(const Eigen::Vector3d& force, Eigen::Matrix3Xd& displacement,
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
    for (int j = 0; j < count; ++j) weights.segment<3>(3 * j) = density_[first + j] * force;
    greens.accumulate(Eigen::Map<const Eigen::VectorXi>(nodes_.data() + first, count),
                      weights.head(3 * count), displacement.reshaped());
  }
  for (int node = 0; node < n; ++node)
    if (greens.isFixed(node)) displacement.col(node).swap(traction.col(node));
  for (int j = 0; j < masked; ++j) traction.col(nodes_[j]) = density_[j] * force;
}

namespace {

/// Point of a triangle nearest to x, in barycentric coordinates (Ericson, "Real-time collision
/// detection", 5.1.5).
Eigen::Vector3d nearestInTriangle(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double d1 = ab.dot(x - a), d2 = ac.dot(x - a);
  const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
  const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace

SurfacePoint nearestSurfacePoint(const SurfaceMesh& mesh, const Eigen::Vector3d& place) {
  if (!place.allFinite()) throw std::invalid_argument("the point to touch is not a finite number");
  SurfacePoint nearest{0, Eigen::Vector3d::Zero()};
  double smallest = std::numeric_limits<double>::infinity();
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Eigen::Matrix3d corners = mesh.points()(Eigen::all, mesh.triangles().col(f));
    const Eigen::Vector3d barycentric =
        nearestInTriangle(place, corners.col(0), corners.col(1), corners.col(2));
    const double distance = (corners * barycentric - place).squaredNorm();
    if (distance < smallest) {
      smallest = distance;
      nearest = {f, barycentric};
    }
  }
  return nearest;
}

}  // namespace palpate
