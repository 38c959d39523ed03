// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/loop_limit.h"

#include <cmath>
#include <stdexcept>

#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// What the mean of a vertex' neighbours weighs in the place that it tends to, by its valence: of
/// the matrix of one step, on the vertex and that mean, the left eigenvector of the eigenvalue 1.
double neighbourShare(int valence) {
  const double alpha = 0.625 - std::pow(0.375 + std::cos(2 * kPi / valence) / 4, 2);
  return alpha / (alpha + 0.375);
}

}  // namespace

Eigen::Matrix3Xd loopLimit(const SurfaceMesh& mesh) {
  if (mesh.rims() != Rims::Refused)
    throw std::invalid_argument("only a closed surface has the limit of Loop's scheme");
  // Around a closed surface's vertex each neighbour is in two triangles.
  Eigen::Matrix3Xd twice = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount());
  for (const auto& t : mesh.triangles().colwise())
    for (int k = 0; k < 3; ++k)
      twice.col(t[k]) += mesh.points().col(t[(k + 1) % 3]) + mesh.points().col(t[(k + 2) % 3]);
  Eigen::Matrix3Xd limit(3, mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    const int valence = mesh.trianglesOfVertex(v).size();
    const double share = neighbourShare(valence);
    limit.col(v) = (1 - share) * mesh.points().col(v) + share / (2 * valence) * twice.col(v);
  }
  return limit;
}

Eigen::Matrix3Xd towardsLoopLimit(const SurfaceMesh& mesh, double share) {
  return (1 - share) * mesh.points() + share * loopLimit(mesh);
}

}  // namespace palpate
