// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/surface_stiffness.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace palpate {

VertexStiffness maskedVertexStiffness(const GreensFunctions& greens, int vertex,
                                      const VertexMask& mask) {
  greens.requireColumns(nodeList(mask.nodes));
  Eigen::Matrix3Xd blocks(3, 3 * mask.nodes.size());
  greens.gather(Eigen::Map<const Eigen::VectorXi>(&vertex, 1), nodeList(mask.nodes), blocks.data());
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();
  for (std::size_t j = 0; j < mask.nodes.size(); ++j)
    compliance += mask.density[j] * blocks.middleCols<3>(3 * j);

  const Eigen::Matrix3d symmetric = (compliance + compliance.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetric);
  if (!(eigen.eigenvalues()[0] > 0)) {
    std::ostringstream text;
    text << "the compliance of vertex " << vertex << " is not positive definite (eigenvalue "
         << eigen.eigenvalues()[0] << " m/N): the mesh is too coarse or inside out there";
    throw std::runtime_error(text.str());
  }
  const Eigen::Matrix3d stiffness = eigen.eigenvectors() *
                                    eigen.eigenvalues().cwiseInverse().asDiagonal() *
                                    eigen.eigenvectors().transpose();
  return {(stiffness + stiffness.transpose()) / 2,
          (compliance - compliance.transpose()).norm() / compliance.norm()};
}

namespace {

bool hasColumns(const GreensFunctions& greens, const VertexMask& mask) {
  return std::all_of(mask.nodes.begin(), mask.nodes.end(),
                     [&](int node) { return greens.hasColumn(node); });
}

}  // namespace

SurfaceStiffness::SurfaceStiffness(std::shared_ptr<const GreensFunctions> greens,
                                   std::shared_ptr<const SurfaceMesh> mesh, MaskShape shape,
                                   double radius, double rigidStiffness,
                                   const ProgressCallback& callback)
    : greens_(std::move(greens)), mesh_(std::move(mesh)), rigidStiffness_(rigidStiffness) {
  if (!(rigidStiffness >= 0) || !std::isfinite(rigidStiffness))
    throw std::invalid_argument("the rigid stiffness must be at least 0 and finite, not " +
                                std::to_string(rigidStiffness));
  if (greens_->nodeCount() != mesh_->vertexCount())
    throw std::invalid_argument("the Green's functions have " +
                                std::to_string(greens_->nodeCount()) + " nodes, the surface " +
                                std::to_string(mesh_->vertexCount()) + " vertices");
  const int n = mesh_->vertexCount();
  const Progress progress(callback);
  const PressureMasks masks(*mesh_, greens_->info().conditions, shape, radius);
  elastic_.assign(n, Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  masks_.resize(n);
  hapticRatio_.assign(n, 1);
  asymmetry_.assign(n, 0);
  std::vector<int> served;
  double largest = 0;
  for (int v = 0; v < n; ++v) {
    if (v % 64 == 0) progress.report(double(v) / n, "stiffness");
    if (greens_->isFixed(v)) continue;
    masks_[v] = masks.at(v);
    if (!hasColumns(*greens_, masks_[v])) continue;
    served.push_back(v);
    const VertexStiffness result = maskedVertexStiffness(*greens_, v, masks_[v]);
    elastic_[v] = result.stiffness;
    asymmetry_[v] = result.asymmetry;
    largest = std::max(largest, result.stiffness.norm());
  }
  const std::vector<int> free = greens_->info().conditions.freeNodes();
  if (served.empty() && !free.empty()) greens_->requireColumns(nodeList(masks_[free.back()].nodes));
  // |K^R|_F = sqrt(3) k_Rigid.
  if (rigidStiffness_ == 0) rigidStiffness_ = largest / std::sqrt(3.0);
  for (int v : greens_->info().conditions.fixedNodes())
    elastic_[v] = rigidStiffness_ * Eigen::Matrix3d::Identity();
  for (int v : served)
    hapticRatio_[v] = std::min(1.0, std::sqrt(3.0) * rigidStiffness_ / elastic_[v].norm());
  progress.report(1, "stiffness");
}

Eigen::Matrix3d SurfaceStiffness::elasticAt(int triangle,
                                            const Eigen::Vector3d& barycentric) const noexcept {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (barycentric[k] != 0)
      stiffness += barycentric[k] * elastic_[mesh_->triangles()(k, triangle)];
  return stiffness;
}

Eigen::Matrix3d SurfaceStiffness::hapticAt(int triangle,
                                           const Eigen::Vector3d& barycentric) const noexcept {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (barycentric[k] != 0) stiffness += barycentric[k] * haptic(mesh_->triangles()(k, triangle));
  return stiffness;
}

}  // namespace palpate
