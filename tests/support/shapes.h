// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "mesh/surface_mesh.h"

namespace palpate::test {

/// A triangle soup on its way to a SurfaceMesh.
struct Shape {
  Eigen::Matrix3Xd points;
  Eigen::Matrix3Xi triangles;

  std::shared_ptr<const SurfaceMesh> mesh() const {
    return std::make_shared<SurfaceMesh>(points, triangles);
  }
  Shape scaled(double factor) const { return {points * factor, triangles}; }
  Shape moved(const Eigen::Vector3d& by) const { return {points.colwise() + by, triangles}; }
  Shape flipped() const;
  /// The two as one soup.
  Shape with(const Shape& other) const;
  /// Vertices within `tolerance` made one, numbered in the order of their first appearance.
  Shape welded(double tolerance = 1e-9) const;
  Shape mapped(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) const;
};

/// Unit sphere: each triangle of an icosahedron in `divisions`^2, vertices projected outwards:
/// 10 divisions^2 + 2 vertices (42 for 2, 162 for 4, 642 for 8, 2562 for 16).
Shape icosphere(int divisions);

/// The same with every vertex moved along the surface by up to `amount` of an edge, at random.
Shape jitteredSphere(int divisions, double amount, unsigned seed = 1);

/// Box [0, size], each face a grid of squares cut in two, along alternating diagonals.
/// @param divisions  squares along x, y, z.
Shape box(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions);

/// Torus around the z axis.
Shape torus(double majorRadius, double minorRadius, int aroundMajor, int aroundMinor);

/// Unit sphere whose mesh is as fine as a wanted edge length asks near each place (by repeated
/// bisection of the longest edges, new vertices on the sphere).
Shape gradedSphere(const std::function<double(const Eigen::Vector3d&)>& edgeLength);

/// Vertices for which a predicate holds, as boundary types.
std::vector<unsigned char> fixedWhere(const Shape& shape,
                                      const std::function<bool(const Eigen::Vector3d&)>& predicate);

}  // namespace palpate::test
