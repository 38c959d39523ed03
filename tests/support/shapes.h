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
  /// One with rims.
  std::shared_ptr<const SurfaceMesh> sheet() const {
    return std::make_shared<SurfaceMesh>(points, triangles, Rims::Allowed);
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

Shape fromLists(const std::vector<Eigen::Vector3d>& points,
                const std::vector<Eigen::Vector3i>& triangles);

/// Unit sphere: an icosahedron whose edges are halved `levels` times, new vertices projected
/// outwards: 12, 42, 162, 642, 2562 vertices. One vertex is the north pole.
Shape icosphere(int levels);

/// The same with every vertex moved along the surface by up to `amount` of an edge, at random.
Shape jitteredSphere(int levels, double amount, unsigned seed = 1);

/// Box [0, size], each face a grid of squares cut in two, along alternating diagonals.
/// @param divisions  squares along x, y, z.
Shape box(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions);

/// Flat disc about the origin, its normal z: six triangles round the middle, rings of 6 k vertices.
Shape disc(double radius, int rings);

/// A grid of squares cut in two along alternating diagonals; points count along x first.
std::vector<Eigen::Vector3i> alternatingSquares(int alongX, int alongY);

/// Flat square about the origin, its normal z, cut in squares and these along alternating
/// diagonals.
Shape plate(double side, int divisions);

/// The same with every vertex within it moved by up to `amount` of an edge, at random.
Shape jitteredPlate(double side, int divisions, double amount, unsigned seed = 1);

/// Unit cube with 4 divisions whose grid lines at x = 1/2 stand this far beside those at 1/4:
/// between them are needles.
Shape boxWithNeedles(double width);

/// Torus around the z axis.
Shape torus(double majorRadius, double minorRadius, int aroundMajor, int aroundMinor);

/// Unit sphere of rings of vertices around the z axis with a vertex at each pole.
/// @param edgeLength  wanted at a polar angle (radians from the north pole).
/// @param lines       polar angles, ascending, at which a ring must lie.
Shape ringedSphere(const std::function<double(double)>& edgeLength,
                   const std::vector<double>& lines);

/// Vertices for which a predicate holds, as boundary types.
std::vector<unsigned char> fixedWhere(const Shape& shape,
                                      const std::function<bool(const Eigen::Vector3d&)>& predicate);

}  // namespace palpate::test
