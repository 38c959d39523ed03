// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/gravity.h"

#include <stdexcept>

#include "greens/rigid_motions.h"

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
        "model on springs, unless these were put under one of finite elements, a shell, or an "
        "unsupported one without sharp edges";
  else if (info.domain == Domain::HalfSpace)
    reason = "the weight of a half-space is infinite: it sinks without end under its own";
  else if (info.domain == Domain::Exterior)
    reason = "the space around a surface has no weight that it could bear";
  else if (info.domain == Domain::Unsupported ||
           info.weightResponse.rows() > 3 * greens.nodeCount())
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

/// The field u_p that is in equilibrium with the weight of a homogeneous body (see weightResponse).
class ParticularField {
 public:
  ParticularField(const Material& material, const Eigen::Vector3d& weight,
                  const Eigen::Vector3d& origin)
      : c_(-(1 - 2 * material.poissonRatio()) / material.youngsModulus() * weight),
        weight_(weight),
        origin_(origin) {}

  Eigen::Vector3d displacement(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d x = place - origin_;
    return c_.dot(x) * x - x.squaredNorm() / 2 * c_;
  }

  /// What is left to bear of a body whose surface is free: minus its tractions, 3 by #F.
  Eigen::Matrix3Xd tractionsLeft(const SurfaceMesh& mesh) const {
    Eigen::Matrix3Xd tractions(3, mesh.triangleCount());
    for (int f = 0; f < mesh.triangleCount(); ++f) {
      Eigen::Vector3d middle = -origin_;
      for (int k = 0; k < 3; ++k) middle += mesh.points().col(mesh.triangles()(k, f)) / 3;
      tractions.col(f) = weight_.dot(middle) * mesh.triangleNormals().col(f);
    }
    return tractions;
  }

 private:
  Eigen::Vector3d c_, weight_, origin_;
};

/// Under one weight; zero where fixed.
Eigen::Matrix3Xd displacementUnder(const Eigen::Vector3d& weight, const GreensFunctions& greens,
                                   const SurfaceMesh& mesh, const Eigen::VectorXi& patches) {
  const GreensFunctionsInfo& info = greens.info();
  const std::vector<int> fixed = info.conditions.fixedNodes(), free = info.conditions.freeNodes();
  const Eigen::Vector3d origin = middleOf(greens, mesh, fixed);
  const ParticularField particular(info.material, weight, origin);
  Eigen::Matrix3Xd applied;
  Eigen::Matrix3Xd displacement =
      solveFaceTractions(greens, mesh, patches, particular.tractionsLeft(mesh), applied);

  Eigen::VectorXd moved(3 * fixed.size());  // areas times displacements
  for (std::size_t k = 0; k < fixed.size(); ++k)
    moved.segment<3>(3 * k) =
        -greens.vertexArea(fixed[k]) * particular.displacement(mesh.points().col(fixed[k]));
  Eigen::MatrixXd reactions(3 * fixed.size(), 3);
  for (int node : free) {
    greens.gather(nodeList(fixed), Eigen::Map<const Eigen::VectorXi>(&node, 1), reactions.data());
    displacement.col(node) += particular.displacement(mesh.points().col(node)) -
                              reactions.transpose() * moved / greens.vertexArea(node);
  }
  for (int node : fixed) displacement.col(node).setZero();
  return displacement;
}

}  // namespace

Eigen::MatrixXd weightResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                               const Eigen::VectorXi& patches) {
  const GreensFunctionsInfo& info = greens.info();
  if (info.weightResponse.rows() == 3 * greens.nodeCount()) return info.weightResponse;
  requireKnown(greens, mesh, patches);
  Eigen::MatrixXd response(3 * mesh.vertexCount(), 3);
  for (int k = 0; k < 3; ++k)
    response.col(k) = displacementUnder(Eigen::Vector3d::Unit(k), greens, mesh, patches).reshaped();
  return response;
}

Eigen::MatrixXd looseWeightResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                    const Eigen::VectorXi& patches) {
  const GreensFunctionsInfo& info = greens.info();
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(mesh);
  if (info.weightResponse.rows() == motions.rows() + motions.cols()) return info.weightResponse;
  if (info.domain != Domain::Unsupported || !info.homogeneous || hasSharpEdges(info, mesh, patches))
    return {};
  const Eigen::Index size = motions.rows();
  Eigen::MatrixXd response(size + motions.cols(), 3);
  for (int k = 0; k < 3; ++k) {
    const ParticularField particular(info.material, Eigen::Vector3d::Unit(k),
                                     mesh.points().rowwise().mean());
    Eigen::Matrix3Xd applied;
    Eigen::Matrix3Xd displacement =
        solveFaceTractions(greens, mesh, patches, particular.tractionsLeft(mesh), applied);
    for (int v = 0; v < mesh.vertexCount(); ++v)
      displacement.col(v) += particular.displacement(mesh.points().col(v));
    response.col(k) << displacement.reshaped(), motions.transpose() * applied.reshaped();
  }
  return response;
}

Eigen::Matrix3Xd gravityDisplacement(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                     const Eigen::VectorXi& patches,
                                     const Eigen::Vector3d& weight) {
  const GreensFunctionsInfo& info = greens.info();
  if (info.weightResponse.rows() != 3 * greens.nodeCount()) {
    requireKnown(greens, mesh, patches);
    return displacementUnder(weight, greens, mesh, patches);
  }
  Eigen::Matrix3Xd displacement = (info.weightResponse * weight).reshaped(3, mesh.vertexCount());
  for (int node : info.conditions.fixedNodes()) displacement.col(node).setZero();
  return displacement;
}

}  // namespace palpate
