// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/gravity.h"

#include <stdexcept>

namespace palpate {
namespace {

/// From where places are measured: the middle of the support, where u_p then is small.
Eigen::Vector3d middleOf(const GreensFunctions& greens, const SurfaceMesh& mesh,
                         const std::vector<int>& nodes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (int node : nodes) {
    sum += greens.vertexArea(node) * mesh.points().col(node);
    area += greens.vertexArea(node);
  }
  return area > 0 ? Eigen::Vector3d(sum / area) : sum;
}

/// Whether a free vertex is on several patches.
bool hasSharpEdges(const GreensFunctionsInfo& info, const SurfaceMesh& mesh,
                   const Eigen::VectorXi& patches) {
  if (patches.size() != mesh.triangleCount()) return false;  // which solveFaceTractions refuses
  for (int v : info.conditions.freeNodes())
    for (int f : mesh.trianglesOfVertex(v))
      if (patches[f] != patches[*mesh.trianglesOfVertex(v).begin()]) return true;
  return false;
}

/// @throws if the weight cannot be told from the surface.
void requireKnown(const GreensFunctions& greens, const SurfaceMesh& mesh,
                  const Eigen::VectorXi& patches) {
  const GreensFunctionsInfo& info = greens.info();
  const char* reason = nullptr;
  if (info.domain == Domain::Given)
    reason =
        "the weight of what a given matrix is of is not known from its surface, nor that of a "
        "model on springs, unless these were put under one of finite elements with a support, or "
        "a shell";
  else if (info.domain == Domain::HalfSpace)
    reason = "the weight of a half-space is infinite: it sinks without end under its own";
  else if (info.domain == Domain::Exterior)
    reason = "the space around a surface has no weight that it could bear";
  else if (info.domain == Domain::Unsupported)
    reason = "what nothing holds falls freely, and its weight does not deform it";
  else if (info.domain == Domain::Shell || !info.homogeneous)
    reason = "this model does not know what its weight does: compute its Green's functions again";
  if (reason) throw std::invalid_argument(reason);
  if (info.patchColumns.empty() && hasSharpEdges(info, mesh, patches))
    throw std::invalid_argument(
        "under its weight the sides of a sharp edge bear different tractions: precompute with "
        "--patch-columns (in Python patch_columns=True), or by finite elements");
  greens.requireColumns(nodeList(info.conditions.freeNodes()));
}

/// Under one weight; zero where fixed.
Eigen::Matrix3Xd displacementUnder(const Eigen::Vector3d& weight, const GreensFunctions& greens,
                                   const SurfaceMesh& mesh, const Eigen::VectorXi& patches) {
  const GreensFunctionsInfo& info = greens.info();
  const std::vector<int> fixed = info.conditions.fixedNodes(), free = info.conditions.freeNodes();
  const Eigen::Vector3d origin = middleOf(greens, mesh, fixed);
  const Eigen::Vector3d c =
      -(1 - 2 * info.material.poissonRatio()) / info.material.youngsModulus() * weight;
  const auto particular = [&](int node) -> Eigen::Vector3d {
    const Eigen::Vector3d x = mesh.points().col(node) - origin;
    return c.dot(x) * x - x.squaredNorm() / 2 * c;
  };

  Eigen::Matrix3Xd tractions(3, mesh.triangleCount()), applied;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    Eigen::Vector3d middle = -origin;
    for (int k = 0; k < 3; ++k) middle += mesh.points().col(mesh.triangles()(k, f)) / 3;
    tractions.col(f) = weight.dot(middle) * mesh.triangleNormals().col(f);
  }
  Eigen::Matrix3Xd displacement = solveFaceTractions(greens, mesh, patches, tractions, applied);

  Eigen::VectorXd moved(3 * fixed.size());  // areas times displacements
  for (std::size_t k = 0; k < fixed.size(); ++k)
    moved.segment<3>(3 * k) = -greens.vertexArea(fixed[k]) * particular(fixed[k]);
  Eigen::MatrixXd reactions(3 * fixed.size(), 3);
  for (int node : free) {
    greens.gather(nodeList(fixed), Eigen::Map<const Eigen::VectorXi>(&node, 1), reactions.data());
    displacement.col(node) +=
        particular(node) - reactions.transpose() * moved / greens.vertexArea(node);
  }
  for (int node : fixed) displacement.col(node).setZero();
  return displacement;
}

}  // namespace

Eigen::MatrixXd weightResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                               const Eigen::VectorXi& patches) {
  const GreensFunctionsInfo& info = greens.info();
  if (info.weightResponse.size() > 0) return info.weightResponse;
  requireKnown(greens, mesh, patches);
  Eigen::MatrixXd response(3 * mesh.vertexCount(), 3);
  for (int k = 0; k < 3; ++k)
    response.col(k) = displacementUnder(Eigen::Vector3d::Unit(k), greens, mesh, patches).reshaped();
  return response;
}

Eigen::Matrix3Xd gravityDisplacement(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                     const Eigen::VectorXi& patches,
                                     const Eigen::Vector3d& weight) {
  const GreensFunctionsInfo& info = greens.info();
  if (info.weightResponse.size() == 0) {
    requireKnown(greens, mesh, patches);
    return displacementUnder(weight, greens, mesh, patches);
  }
  Eigen::Matrix3Xd displacement = (info.weightResponse * weight).reshaped(3, mesh.vertexCount());
  for (int node : info.conditions.fixedNodes()) displacement.col(node).setZero();
  return displacement;
}

}  // namespace palpate
