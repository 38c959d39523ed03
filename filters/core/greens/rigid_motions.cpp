// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/rigid_motions.h"

#include <Eigen/Cholesky>
#include <stdexcept>

#include "mesh/surface_locator.h"
#include "model/support.h"

namespace palpate {

Eigen::MatrixXd meanRigidMotion(const Eigen::VectorXd& areas, const Eigen::MatrixXd& motions) {
  Eigen::MatrixXd weighted = motions;
  for (Eigen::Index v = 0; v < areas.size(); ++v) weighted.middleRows<3>(3 * v) *= areas[v];
  return (weighted.transpose() * motions).ldlt().solve(weighted.transpose());
}

void requireAllColumns(const std::vector<int>& columns, bool patchColumns) {
  if (!columns.empty())
    throw std::invalid_argument(
        "loads on an unsupported body are balanced at all of its vertices: leave the columns out");
  if (patchColumns)
    throw std::invalid_argument(
        "of an unsupported body there are no Green's functions of single patches: leave patch "
        "columns out");
}

Eigen::MatrixXd rigidMotionsOfBodies(const SurfaceMesh& mesh) {
  const Eigen::MatrixXd all =
      rigidMotions(mesh.points(), mesh.points().rowwise().mean(), mesh.diagonal());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(all.rows(), 6 * mesh.bodyCount());
  for (int v = 0; v < mesh.vertexCount(); ++v)
    motions.block<3, 6>(3 * v, 6 * mesh.bodyOfVertex(v)) = all.middleRows<3>(3 * v);
  return motions;
}

Eigen::MatrixXd rigidMotionsInside(const std::shared_ptr<const SurfaceMesh>& mesh,
                                   const Eigen::Matrix3Xd& points) {
  const SurfaceLocator locator(mesh);
  const Eigen::MatrixXd all =
      rigidMotions(points, mesh->points().rowwise().mean(), mesh->diagonal());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(13 * points.cols(), 6 * mesh->bodyCount());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const int vertex = mesh->triangles()(0, locator.nearest(points.col(i)).triangle);
    auto block = motions.block<13, 6>(13 * i, 6 * mesh->bodyOfVertex(vertex));
    block.topRows<3>() = all.middleRows<3>(3 * i);
    for (int k = 0; k < 3; ++k)  // du_i / dx_l = e_i . (axis x e_l) over the diagonal
      for (int l = 0; l < 3; ++l) {
        const Eigen::Vector3d turned = Eigen::Vector3d::Unit(k).cross(Eigen::Vector3d::Unit(l));
        for (int row = 0; row < 3; ++row)
          block(3 + 3 * row + l, 3 + k) = turned[row] / mesh->diagonal();
      }
  }
  return motions;
}

template <class Scalar>
void removeRigidMotions(Scalar* matrix, const Eigen::VectorXd& areas,
                        const Eigen::MatrixXd& displaced, const Eigen::MatrixXd& loaded) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index size = 3 * areas.size();
  Eigen::Map<Matrix> xi(matrix, size, size);
  const Matrix mean = meanRigidMotion(areas, displaced).cast<Scalar>() * xi;
  xi.noalias() -= displaced.cast<Scalar>() * mean;
  const Matrix balance = meanRigidMotion(areas, loaded).cast<Scalar>();
  const Matrix ofBalance = xi * loaded.cast<Scalar>();
  xi.noalias() -= ofBalance * balance;
}

Eigen::MatrixXd balancedWeight(const Eigen::Ref<const Eigen::MatrixXd>& held,
                               const Eigen::MatrixXd& weight, const Eigen::MatrixXd& resultants,
                               const Eigen::VectorXd& areas, const Eigen::MatrixXd& displaced,
                               const Eigen::MatrixXd& loaded) {
  Eigen::MatrixXd weighted = loaded;
  for (Eigen::Index v = 0; v < areas.size(); ++v) weighted.middleRows<3>(3 * v) *= areas[v];
  Eigen::MatrixXd sunk =
      weight - held * (loaded * (weighted.transpose() * loaded).ldlt().solve(resultants));
  sunk -= displaced * (meanRigidMotion(areas, displaced) * sunk).eval();
  Eigen::MatrixXd result(weight.rows() + resultants.rows(), weight.cols());
  result << sunk, resultants;
  return result;
}

template void removeRigidMotions(double*, const Eigen::VectorXd&, const Eigen::MatrixXd&,
                                 const Eigen::MatrixXd&);
template void removeRigidMotions(float*, const Eigen::VectorXd&, const Eigen::MatrixXd&,
                                 const Eigen::MatrixXd&);

}  // namespace palpate
