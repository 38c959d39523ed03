// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_system.h"

#include "shell/shell_curvature.h"
#include "shell/shell_element.h"

namespace palpate::shell {

ShellSystem::ShellSystem(const ElasticModel& model, const ThinShell& shell)
    : length(model.mesh().diagonal()), place(6, model.mesh().vertexCount()) {
  const SurfaceMesh& mesh = model.mesh();
  int free = 0, held = 0;
  for (int v = 0; v < mesh.vertexCount(); ++v)
    for (int k = 0; k < 6; ++k) place(k, v) = shell.held()(k, v) ? -1 - held++ : free++;

  entries.size = free;
  volumes = Eigen::VectorXd::Zero(mesh.vertexCount());
  const Eigen::VectorXd inclined = inclinations(mesh);
  std::vector<Eigen::Triplet<double>> ofHeldFree, ofHeldHeld;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    Eigen::Matrix3d corners;
    Eigen::Matrix<int, 18, 1> places;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles()(k, f);
      corners.col(k) = mesh.points().col(v) / length;
      places.segment<6>(6 * k) = place.col(v);
    }
    const Eigen::Vector3d thickness = shell.thickness().col(f) / length;
    const double area = mesh.triangleAreas()[f] / (length * length);
    for (int k = 0; k < 3; ++k)  // of a linear thickness times a hat
      volumes[mesh.triangles()(k, f)] += area / 12 * (thickness.sum() + thickness[k]);
    const Matrix18d stiffness =
        shellStiffness(corners, thickness, model.material().poissonRatio(), inclined[f]);
    for (int i = 0; i < 18; ++i)
      for (int j = 0; j < 18; ++j) {
        const int row = places[i], column = places[j];
        if (row >= 0 && column >= 0) {
          if (i <= j) entries.add(row, column, stiffness(i, j));
        } else if (row < 0) {
          (column < 0 ? ofHeldHeld : ofHeldFree)
              .emplace_back(-1 - row, column < 0 ? -1 - column : column, stiffness(i, j));
        }
      }
  }
  heldFree.resize(held, free);
  heldFree.setFromTriplets(ofHeldFree.begin(), ofHeldFree.end());
  heldHeld.resize(held, held);
  heldHeld.setFromTriplets(ofHeldHeld.begin(), ofHeldHeld.end());
}

}  // namespace palpate::shell
