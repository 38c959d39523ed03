// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/rigid_motions.h"

#include <Eigen/Cholesky>
#include <stdexcept>

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

template void removeRigidMotions(double*, const Eigen::VectorXd&, const Eigen::MatrixXd&,
                                 const Eigen::MatrixXd&);
template void removeRigidMotions(float*, const Eigen::VectorXd&, const Eigen::MatrixXd&,
                                 const Eigen::MatrixXd&);

}  // namespace palpate
