// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/torque_mask.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <stdexcept>

namespace palpate {
namespace {

constexpr double kThinnest = 1e-9;  ///< smallest over largest moment of a mask that is no line

Eigen::Matrix3d crossing(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

}  // namespace

Eigen::Matrix3d TorqueMask::tensor(int index) const {
  return -density[index] * crossing(arms.col(index)) * inverseInertia;
}

Eigen::Vector3d TorqueMask::meanRotation(const Eigen::Matrix3Xd& displacements) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < share.size(); ++j)
    sum += share[j] * crossing(arms.col(j)) * displacements.col(j);
  return inverseInertia * sum;
}

TorqueMask torqueMask(const SurfaceMesh& mesh, const VertexMask& mask) {
  TorqueMask torque;
  torque.nodes = mask.nodes;
  torque.density = mask.density;
  torque.share = mesh.vertexAreas()(mask.nodes).cwiseProduct(mask.density);
  torque.arms = mesh.points()(Eigen::all, mask.nodes);
  torque.centre = torque.arms * torque.share / torque.share.sum();
  torque.arms.colwise() -= torque.centre;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (int j = 0; j < torque.share.size(); ++j) {
    const Eigen::Matrix3d arm = crossing(torque.arms.col(j));
    inertia += torque.share[j] * arm.transpose() * arm;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia);
  if (!(eigen.eigenvalues()[0] > kThinnest * eigen.eigenvalues()[2]))
    throw std::invalid_argument(
        "a torque needs a pressure mask of three nodes or more that are not on one line: give it "
        "a larger radius");
  torque.inverseInertia = eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                          eigen.eigenvectors().transpose();
  return torque;
}

Matrix6d wrenchCompliance(const GreensFunctions& greens, const TorqueMask& mask) {
  greens.requireColumns(nodeList(mask.nodes));
  const int count = static_cast<int>(mask.nodes.size());
  const auto rows = nodeList(mask.nodes);
  // Displacements of the nodes under unit forces and torques, 3 #nodes by 6.
  Eigen::MatrixXd columns(3 * count, 3), response = Eigen::MatrixXd::Zero(3 * count, 6);
  for (int j = 0; j < count; ++j) {
    greens.gather(rows, rows.segment(j, 1), columns.data());
    response.leftCols<3>() += mask.density[j] * columns;
    response.rightCols<3>() += columns * mask.tensor(j);
  }
  Matrix6d compliance;
  for (int c = 0; c < 6; ++c) {
    const Eigen::Matrix3Xd moved = response.col(c).reshaped(3, count);
    compliance.col(c) << moved * mask.share, mask.meanRotation(moved);
  }
  return compliance;
}

Eigen::Matrix3d rotationalStiffness(const GreensFunctions& greens, const TorqueMask& mask) {
  const Eigen::Matrix3d block = wrenchCompliance(greens, mask).bottomRightCorner<3, 3>();
  const Eigen::LLT<Eigen::Matrix3d> factors((block + block.transpose()) / 2);
  if (factors.info() != Eigen::Success)
    throw std::runtime_error("the mask turns against the torque: the surface is inside out there");
  return factors.solve(Eigen::Matrix3d::Identity());
}

std::vector<Eigen::Matrix3d> rotationalStiffnesses(const SurfaceStiffness& stiffness,
                                                   const ProgressCallback& callback) {
  const int n = stiffness.mesh().vertexCount();
  const Progress progress(callback);
  std::vector<Eigen::Matrix3d> all(
      n, Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (int v = 0; v < n; ++v) {
    if (v % 64 == 0) progress.report(double(v) / n, "rotational stiffness");
    if (stiffness.greens().isFixed(v)) continue;
    try {
      all[v] =
          rotationalStiffness(stiffness.greens(), torqueMask(stiffness.mesh(), stiffness.mask(v)));
    } catch (const std::exception&) {
      // It stays NaN; torqueMask and rotationalStiffness say why to whoever asks them.
    }
  }
  progress.report(1, "rotational stiffness");
  return all;
}

}  // namespace palpate
