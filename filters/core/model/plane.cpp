// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/plane.h"

#include <cmath>
#include <Eigen/Geometry>
#include <sstream>
#include <stdexcept>

#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

constexpr double kAxisRounding = 1e-15;

/// A unit vector at right angles to the normal: a coordinate axis where that can be.
Eigen::Vector3d firstAxis(const Eigen::Vector3d& normal) {
  int most;
  normal.cwiseAbs().maxCoeff(&most);
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit((most + 1) % 3);
  return (axis - normal.dot(axis) * normal).normalized();
}

void requireOneSide(const SurfaceMesh& mesh, const Eigen::Vector3d& normal) {
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (mesh.triangleNormals().col(f).dot(normal) <= 0)
      throw std::invalid_argument("triangle " + std::to_string(f) +
                                  " faces away from the side that most of the surface faces: the "
                                  "normals of a half-space's surface all point out of it");
}

void requireFlat(const SurfaceMesh& mesh, const Plane& plane) {
  Eigen::Index farthest;
  const double off = (plane.normal.transpose() * (mesh.points().colwise() - plane.origin))
                         .cwiseAbs()
                         .maxCoeff(&farthest);
  if (off <= kFlatness * mesh.diagonal()) return;
  std::ostringstream text;
  text.precision(3);
  text << "vertex " << farthest << " lies " << off
       << " off the plane of the surface: only a flat one, to " << kFlatness
       << " of its size (here " << kFlatness * mesh.diagonal() << "), bounds a half-space";
  throw std::invalid_argument(text.str());
}

}  // namespace

Plane planeOf(const SurfaceMesh& mesh) {
  Eigen::Vector3d area = mesh.triangleNormals() * mesh.triangleAreas();
  const Eigen::Vector3d start = mesh.points().col(0);
  Plane plane;
  plane.origin =
      start + (mesh.points().colwise() - start) * mesh.vertexAreas() / mesh.vertexAreas().sum();
  // A surface that is far from flat may have no normal at all: then any will do to name a vertex.
  plane.normal = area.norm() > 1e-9 * mesh.triangleAreas().sum()
                     ? area.normalized()
                     : Eigen::Vector3d(mesh.triangleNormals().col(0));
  int most;
  plane.normal.cwiseAbs().maxCoeff(&most);
  const Eigen::Vector3d axis = std::copysign(1., plane.normal[most]) * Eigen::Vector3d::Unit(most);
  if ((plane.normal - axis).norm() < kAxisRounding) plane.normal = axis;
  requireFlat(mesh, plane);
  requireOneSide(mesh, plane.normal);
  plane.first = firstAxis(plane.normal);
  plane.second = plane.normal.cross(plane.first);
  return plane;
}

}  // namespace palpate
