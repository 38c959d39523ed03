// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/shells.h"

#include <cmath>
#include <Eigen/Geometry>
#include <numeric>

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 1e-14;  // of a shell's area times its diagonal

int findRoot(std::vector<int>& parent, int v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

std::vector<std::vector<int>> trianglesByShell(const Eigen::Matrix3Xi& triangles,
                                               const Shells& shells) {
  std::vector<std::vector<int>> byShell(shells.count());
  for (int f = 0; f < triangles.cols(); ++f) byShell[shells.ofVertex[triangles(0, f)]].push_back(f);
  return byShell;
}

}  // namespace

double enclosedVolume(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  const std::vector<double> volumes = findShells(points, triangles).volume;
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

double solidAngle(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c) {
  const Eigen::Vector3d p = a - x, q = b - x, r = c - x;
  const double lp = p.norm(), lq = q.norm(), lr = r.norm();
  const double numerator = p.dot(q.cross(r));
  const double denominator = lp * lq * lr + p.dot(q) * lr + p.dot(r) * lq + q.dot(r) * lp;
  return 2 * std::atan2(numerator, denominator);
}

Shells findShells(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  std::vector<int> root(points.cols());
  std::iota(root.begin(), root.end(), 0);
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 1; k < 3; ++k)
      root[findRoot(root, triangles(k, f))] = findRoot(root, triangles(0, f));

  Shells shells;
  shells.ofVertex.assign(points.cols(), -1);
  std::vector<int> numberOfRoot(points.cols(), -1), someVertex;
  for (int v = 0; v < points.cols(); ++v) {
    int& number = numberOfRoot[findRoot(root, v)];
    if (number < 0) {
      number = static_cast<int>(someVertex.size());
      someVertex.push_back(v);
    }
    shells.ofVertex[v] = number;
  }
  const int count = static_cast<int>(someVertex.size());
  shells.volume.assign(count, 0);
  shells.parent.assign(count, -1);
  shells.depth.assign(count, 0);
  const std::vector<std::vector<int>> byShell = trianglesByShell(triangles, shells);

  std::vector<Eigen::AlignedBox3d> box(count);
  for (int s = 0; s < count; ++s) {
    const Eigen::Vector3d origin = points.col(someVertex[s]);
    shells.firstTriangle.push_back(byShell[s].front());
    double area = 0;
    for (int f : byShell[s]) {
      const Eigen::Vector3d a = points.col(triangles(0, f)) - origin;
      const Eigen::Vector3d b = points.col(triangles(1, f)) - origin;
      const Eigen::Vector3d c = points.col(triangles(2, f)) - origin;
      shells.volume[s] += a.dot(b.cross(c)) / 6;
      area += (b - a).cross(c - a).norm() / 2;
      for (int k = 0; k < 3; ++k) box[s].extend(points.col(triangles(k, f)));
    }
    if (std::abs(shells.volume[s]) <= kRounding * area * box[s].diagonal().norm())
      shells.volume[s] = 0;
  }
  for (int inner = 0; inner < count; ++inner) {
    const Eigen::Vector3d x = points.col(someVertex[inner]);
    for (int outer = 0; outer < count; ++outer) {
      if (outer == inner || !box[outer].contains(x)) continue;
      double angle = 0;
      for (int f : byShell[outer])
        angle += solidAngle(x, points.col(triangles(0, f)), points.col(triangles(1, f)),
                            points.col(triangles(2, f)));
      if (std::abs(angle) < 2 * kPi) continue;  // winding number 0: outside
      ++shells.depth[inner];
      int& parent = shells.parent[inner];
      if (parent < 0 || std::abs(shells.volume[outer]) < std::abs(shells.volume[parent]))
        parent = outer;
    }
  }
  return shells;
}

}  // namespace palpate
