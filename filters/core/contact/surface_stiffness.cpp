// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/surface_stiffness.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr double kLeastShare = 0.5;    ///< of M in the served compliance
constexpr double kFarthestAstray = 1;  ///< |B K - 1|, of a displacement that is asked for
constexpr double kRounding = 1e-12;    ///< of a matrix that is the one it is held against

void requireRigidStiffness(double rigidStiffness) {
  if (!(rigidStiffness >= 0) || !std::isfinite(rigidStiffness))
    throw std::invalid_argument("the rigid stiffness must be at least 0 and finite, not " +
                                std::to_string(rigidStiffness));
}

const std::shared_ptr<const SurfaceMesh>& requireFitting(
    const GreensFunctions& greens, const std::shared_ptr<const SurfaceMesh>& mesh) {
  if (greens.nodeCount() != mesh->vertexCount())
    throw std::invalid_argument("the Green's functions have " + std::to_string(greens.nodeCount()) +
                                " nodes, the surface " + std::to_string(mesh->vertexCount()) +
                                " vertices");
  return mesh;
}

Eigen::Matrix3d symmetricPart(const Eigen::Matrix3d& matrix) {
  return (matrix + matrix.transpose()) / 2;
}

/// A symmetric matrix, nowhere below a positive definite one.
struct Raised {
  Eigen::Matrix3d matrix;
  bool isAbove;  ///< whether nothing had to be raised
};

/// @param floor  left out of account where it is not positive definite itself.
Raised raisedTo(const Eigen::Matrix3d& floor, const Eigen::Matrix3d& matrix) {
  const Eigen::LLT<Eigen::Matrix3d> factors(floor);
  if (factors.info() != Eigen::Success) return {matrix, true};
  const Eigen::Matrix3d half = factors.matrixL().solve(matrix);
  const Eigen::Matrix3d relative = factors.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetricPart(relative));
  if (eigen.eigenvalues()[0] >= 1 - kRounding) return {matrix, true};
  const Eigen::Matrix3d root = factors.matrixL() * eigen.eigenvectors() *
                               eigen.eigenvalues().cwiseMax(1).cwiseSqrt().asDiagonal();
  return {root * root.transpose(), false};
}

/// Displacements of the mask's nodes under its unit forces, 3 #nodes by 3.
Eigen::MatrixXd maskResponse(const GreensFunctions& greens, const VertexMask& mask) {
  const int count = static_cast<int>(mask.nodes.size());
  const auto rows = nodeList(mask.nodes);
  Eigen::MatrixXd columns(3 * count, 3), sum = Eigen::MatrixXd::Zero(3 * count, 3);
  for (int j = 0; j < count; ++j) {
    greens.gather(rows, rows.segment(j, 1), columns.data());
    sum += mask.density[j] * columns;
  }
  return sum;
}

/// The symmetric S whose inverse moves the vertex most nearly as it is told to: the one that makes
/// |(B - S) M^-1|_F least.
Eigen::Matrix3d symmetrised(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& mean) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(mean);
  const Eigen::Matrix3d& axes = eigen.eigenvectors();
  const Eigen::Vector3d weight = eigen.eigenvalues().cwiseAbs2();
  const Eigen::Matrix3d b = axes.transpose() * compliance * axes;
  Eigen::Matrix3d s = b;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j) s(i, j) = (weight[i] * b(i, j) + weight[j] * b(j, i)) / (weight[i] + weight[j]);
  return symmetricPart(axes * s * axes.transpose());
}

}  // namespace

VertexStiffness maskedVertexStiffness(const GreensFunctions& greens, int vertex,
                                      const VertexMask& mask, DisplacementMeasure measure) {
  greens.requireColumns(nodeList(mask.nodes));
  const Eigen::MatrixXd response = maskResponse(greens, mask);
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero(), mean = compliance, apart = compliance;
  for (std::size_t i = 0; i < mask.nodes.size(); ++i) {
    const int node = mask.nodes[i];
    const double share = greens.vertexArea(node) * mask.density[i];
    mean += share * response.middleRows<3>(3 * i);
    if (node == vertex) compliance = response.middleRows<3>(3 * i);
    const Eigen::Map<const Eigen::VectorXi> self(&node, 1);
    Eigen::Matrix3d own;
    greens.gather(self, self, own.data());
    apart += share * mask.density[i] * own;
  }
  const bool isMean = measure == DisplacementMeasure::Mean;
  const Raised least = raisedTo(symmetricPart(apart), symmetricPart(mean));
  const Raised served =
      isMean ? least : raisedTo(kLeastShare * least.matrix, symmetrised(compliance, least.matrix));
  if (isMean) compliance = mean;
  const Eigen::Matrix3d stiffness = symmetricPart(served.matrix.inverse());
  const Eigen::Matrix3d astray = compliance * stiffness - Eigen::Matrix3d::Identity();
  const bool isPositive = Eigen::LLT<Eigen::Matrix3d>(served.matrix).info() == Eigen::Success;
  if (!isPositive || !(astray.operatorNorm() <= kFarthestAstray)) {
    const std::string place = "the compliance at vertex " + std::to_string(vertex);
    throw std::runtime_error(
        place + (isPositive ? " is that of no stiffness" : " is not positive definite") +
        ": the surface is inside out there, its walls are far thinner than its edges are long, or "
        "components of a shell are held there");
  }
  return {stiffness, (compliance - compliance.transpose()).norm() / compliance.norm(),
          !served.isAbove};
}

SurfaceStiffness::SurfaceStiffness(std::shared_ptr<const GreensFunctions> greens,
                                   std::shared_ptr<const SurfaceMesh> mesh, MaskShape shape,
                                   double radius, double rigidStiffness,
                                   const ProgressCallback& callback)
    : SurfaceStiffness(
          greens, mesh,
          PressureMasks(*requireFitting(*greens, mesh), greens->info().conditions, shape, radius),
          {rigidStiffness}, callback) {}

SurfaceStiffness::SurfaceStiffness(std::shared_ptr<const GreensFunctions> greens,
                                   std::shared_ptr<const SurfaceMesh> mesh,
                                   const VertexMasks& masks, const StiffnessOptions& options,
                                   const ProgressCallback& callback)
    : greens_(std::move(greens)), mesh_(std::move(mesh)), measure_(options.measure) {
  requireRigidStiffness(options.rigidStiffness);
  requireFitting(*greens_, mesh_);
  const int n = mesh_->vertexCount();
  const Progress progress(callback);
  elastic_.assign(n, Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::vector<VertexMask> vertexMasks(n);
  hapticRatio_.assign(n, 1);
  asymmetry_.assign(n, 0);
  limited_.assign(n, false);
  bool isServed = false;
  for (int v = 0; v < n; ++v) {
    if (v % 64 == 0) progress.report(double(v) / n, "stiffness");
    if (greens_->isFixed(v)) continue;
    vertexMasks[v] = masks.at(v);
    try {
      const VertexStiffness result = maskedVertexStiffness(*greens_, v, vertexMasks[v], measure_);
      elastic_[v] = result.stiffness;
      asymmetry_[v] = result.asymmetry;
      limited_[v] = result.limited;
      isServed = true;
    } catch (const std::exception&) {
      // requireServed says why to whoever asks for it.
    }
  }
  masks_ = std::make_shared<const std::vector<VertexMask>>(std::move(vertexMasks));
  const std::vector<int> free = greens_->info().conditions.freeNodes();
  if (!isServed && !free.empty()) requireServed(free.back());
  setRigidStiffness(options.rigidStiffness);
  progress.report(1, "stiffness");
}

void SurfaceStiffness::setRigidStiffness(double rigidStiffness) {
  givenRigidStiffness_ = rigidStiffness_ = rigidStiffness;
  const std::vector<int> free = greens_->info().conditions.freeNodes();
  // |K^R|_F = sqrt(3) k_Rigid. What is not served is NaN and never larger.
  if (rigidStiffness == 0)
    for (int v : free)
      rigidStiffness_ = std::max(rigidStiffness_, elastic_[v].norm() / std::sqrt(3.0));
  for (int v : greens_->info().conditions.fixedNodes())
    elastic_[v] = rigidStiffness_ * Eigen::Matrix3d::Identity();
  for (int v : free)
    if (!elastic_[v].hasNaN())
      hapticRatio_[v] = std::min(1.0, std::sqrt(3.0) * rigidStiffness_ / elastic_[v].norm());
}

std::shared_ptr<const SurfaceStiffness> SurfaceStiffness::withRigidStiffness(
    double rigidStiffness) const {
  requireRigidStiffness(rigidStiffness);
  const auto changed = std::make_shared<SurfaceStiffness>(*this);
  changed->setRigidStiffness(rigidStiffness);
  return changed;
}

std::shared_ptr<const SurfaceStiffness> SurfaceStiffness::withYoungsModulus(
    double youngsModulus) const {
  const auto changed = std::make_shared<SurfaceStiffness>(*this);
  changed->greens_ = greens_->withYoungsModulus(youngsModulus);
  const double factor = youngsModulus / greens_->info().material.youngsModulus();
  for (Eigen::Matrix3d& stiffness : changed->elastic_) stiffness *= factor;
  changed->setRigidStiffness(givenRigidStiffness_);
  return changed;
}

void SurfaceStiffness::requireServed(int vertex) const {
  if (elastic_[vertex].hasNaN()) maskedVertexStiffness(*greens_, vertex, mask(vertex), measure_);
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
