// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_mesh.h"

#include <algorithm>
#include <Eigen/Geometry>

#include "mesh/mesh_defects.h"
#include "mesh/shells.h"
#include "mesh/triangle_sides.h"

namespace palpate {

SurfaceMesh::SurfaceMesh(Eigen::Matrix3Xd points, Eigen::Matrix3Xi triangles, Rims rims)
    : rims_(rims), points_(std::move(points)), triangles_(std::move(triangles)) {
  requireNoDefect(findMeshDefects(points_, triangles_, 1, rims));
  computeGeometry();
  if (rims == Rims::Allowed) computeMeanEdgeLength();
  computeShells();
}

void SurfaceMesh::computeGeometry() {
  const int vertexTotal = vertexCount(), triangleTotal = triangleCount();
  diagonal_ = (points_.rowwise().maxCoeff() - points_.rowwise().minCoeff()).norm();
  vertexAreas_ = Eigen::VectorXd::Zero(vertexTotal);
  triangleAreas_.resize(triangleTotal);
  triangleNormals_.resize(3, triangleTotal);
  vertexNormals_ = Eigen::Matrix3Xd::Zero(3, vertexTotal);
  std::vector<int> valence(vertexTotal, 0);
  for (int f = 0; f < triangleTotal; ++f) {
    const Eigen::Vector3i t = triangles_.col(f);
    const Eigen::Vector3d a = points_.col(t[0]), b = points_.col(t[1]), c = points_.col(t[2]);
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    triangleAreas_[f] = cross.norm() / 2;
    triangleNormals_.col(f) = cross.normalized();
    // Each edge of a closed surface is met from both its sides.
    meanEdgeLength_ += ((b - a).norm() + (c - b).norm() + (a - c).norm()) / (3.0 * triangleTotal);
    for (int k = 0; k < 3; ++k) {
      vertexAreas_[t[k]] += triangleAreas_[f] / 3;
      vertexNormals_.col(t[k]) += cross;
      ++valence[t[k]];
    }
  }
  vertexNormals_.colwise().normalize();

  incidentStart_.assign(vertexTotal + 1, 0);
  for (int v = 0; v < vertexTotal; ++v) incidentStart_[v + 1] = incidentStart_[v] + valence[v];
  incident_.resize(incidentStart_.back());
  std::vector<int> fill(incidentStart_.begin(), incidentStart_.end() - 1);
  for (int f = 0; f < triangleTotal; ++f)
    for (int k = 0; k < 3; ++k) incident_[fill[triangles_(k, f)]++] = f;
}

/// Where edges of rims are met from one side alone.
void SurfaceMesh::computeMeanEdgeLength() {
  double sum = 0;
  int count = 0;
  forEachEdge(sortedSides(triangles_), [&](auto first, auto) {
    sum += (points_.col(first->high) - points_.col(first->low)).norm();
    ++count;
  });
  meanEdgeLength_ = sum / count;
}

double SurfaceMesh::longestEdge(int triangle) const {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const int from = triangles_(k, triangle), to = triangles_((k + 1) % 3, triangle);
    longest = std::max(longest, (points_.col(from) - points_.col(to)).norm());
  }
  return longest;
}

void SurfaceMesh::computeShells() {
  const Shells shells = findShells(points_, triangles_);
  if (rims_ == Rims::Refused) requireNoDefect(findOrientationDefects(shells, 1));
  vertexShell_ = shells.ofVertex;
  for (int s = 0; s < shells.count(); ++s) {
    const bool cavity = rims_ == Rims::Refused && shells.depth[s] % 2 == 1;
    shellIsCavity_.push_back(cavity);
    shellBody_.push_back(cavity ? -1 : bodyCount_++);
  }
  for (int s = 0; s < shells.count(); ++s)
    if (shellIsCavity_[s]) shellBody_[s] = shellBody_[shells.parent[s]];
}

Fingerprint& Fingerprint::add(const void* bytes, std::size_t count) {
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) hash_ = (hash_ ^ byte[i]) * 1099511628211ull;
  return *this;
}

Fingerprint& Fingerprint::add(const SurfaceMesh& mesh) {
  return add(mesh.points().data(), sizeof(double) * mesh.points().size())
      .add(mesh.triangles().data(), sizeof(int) * mesh.triangles().size());
}

}  // namespace palpate
