// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/subdivision.h"

#include <stdexcept>
#include <string>

#include "mesh/edge_subdivision.h"
#include "mesh/loop_subdivision.h"
#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

constexpr long kMostTriangles = 10'000'000;

}  // namespace

SubdivisionLevel subdivide(const SurfaceMesh& mesh, const Eigen::VectorXi& smoothPatches,
                           Subdivision subdivision) {
  if (4L * mesh.triangleCount() > kMostTriangles)
    throw std::invalid_argument("refining " + std::to_string(mesh.triangleCount()) +
                                " triangles once more would give more than ten million");
  if (subdivision == Subdivision::Loop) return subdivideLoop(mesh);
  return subdivision == Subdivision::Flat ? subdivideFlat(mesh)
                                          : subdivideCurved(mesh, smoothPatches);
}

std::vector<unsigned char> refineBoundaryTypes(const SubdivisionLevel& level,
                                               const std::vector<unsigned char>& types) {
  const int oldCount = level.parents.size() ? level.parents.maxCoeff() + 1 : 0;
  if (static_cast<int>(types.size()) != oldCount)
    throw std::invalid_argument("there are " + std::to_string(types.size()) +
                                " boundary types for " + std::to_string(oldCount) +
                                " old vertices");
  std::vector<unsigned char> fine;
  for (Eigen::Index v = 0; v < level.parents.cols(); ++v)
    fine.push_back(types[level.parents(0, v)] && types[level.parents(1, v)]);
  return fine;
}

Eigen::VectorXi refineSmoothPatches(const SubdivisionLevel& level, const Eigen::VectorXi& patches) {
  Eigen::VectorXi fine(level.parentTriangle.size());
  for (Eigen::Index f = 0; f < fine.size(); ++f) fine[f] = patches[level.parentTriangle[f]];
  return fine;
}

SurfacePoint parentPoint(const SubdivisionLevel& level, const Eigen::Matrix3Xi& coarse,
                         const SurfacePoint& point) {
  SurfacePoint parent{level.parentTriangle[point.triangle], Eigen::Vector3d::Zero()};
  for (int k = 0; k < 3; ++k)
    for (int ancestor : level.parents.col(level.triangles(k, point.triangle)))
      for (int corner = 0; corner < 3; ++corner)
        if (coarse(corner, parent.triangle) == ancestor)
          parent.barycentric[corner] += 0.5 * point.barycentric[k];
  return parent;
}

}  // namespace palpate
