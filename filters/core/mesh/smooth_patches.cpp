// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/smooth_patches.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

/// The triangle on the other side of the edge from corner k to corner k + 1 of triangle f.
int neighbourAcross(const SurfaceMesh& mesh, int f, int k) {
  const int from = mesh.triangles()(k, f), to = mesh.triangles()((k + 1) % 3, f);
  for (int other : mesh.trianglesOfVertex(from))
    for (int j = 0; j < 3; ++j)
      if (mesh.triangles()(j, other) == to && mesh.triangles()((j + 1) % 3, other) == from)
        return other;
  return f;
}

}  // namespace

Eigen::VectorXi findSmoothPatches(const SurfaceMesh& mesh, double smoothAngle) {
  if (!(smoothAngle >= 0 && smoothAngle <= 180))
    throw std::invalid_argument("the smooth angle must be 0 to 180 degrees, not " +
                                std::to_string(smoothAngle));
  // At 0 degrees a plane is smooth, at 180 every edge, even where a cosine is rounded.
  constexpr double rounding = 1e-12;
  const double smallestCosine = std::cos(smoothAngle * 3.14159265358979323846 / 180) - rounding;
  Eigen::VectorXi patch = Eigen::VectorXi::Constant(mesh.triangleCount(), -1);
  int count = 0;
  std::vector<int> front;
  for (int seed = 0; seed < mesh.triangleCount(); ++seed) {
    if (patch[seed] >= 0) continue;
    patch[seed] = count;
    front.assign(1, seed);
    while (!front.empty()) {
      const int f = front.back();
      front.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int other = neighbourAcross(mesh, f, k);
        const double cosine = mesh.triangleNormals().col(f).dot(mesh.triangleNormals().col(other));
        if (patch[other] >= 0 || cosine < smallestCosine) continue;
        patch[other] = count;
        front.push_back(other);
      }
    }
    ++count;
  }
  return patch;
}

}  // namespace palpate
