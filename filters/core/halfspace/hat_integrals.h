// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <vector>

namespace palpate {

/// What a half-space's surface needs of a vertex's hat function phi: with d = x - y and r = |d|,
/// integrals over y, each a length.
struct HatMoments {
  double inverse;  ///< of phi / r
  double xx, xy;   ///< of phi dx dx / r^3 and phi dx dy / r^3; dy dy / r^3 is what is left of 1 / r
  double x, y;     ///< of phi dx / r^2 and phi dy / r^2
};

/// The hat functions of a triangulated part of a plane, integrated against 1/r, d d^T / r^3 and
/// d / r^2 for points of that plane.
///
/// Nearby, in closed form: a hat is the sum over the edges of its triangles of what lies between
/// the point x and the edge. An affine function psi times a kernel g(direction) / r, integrated
/// over the triangle of x and an edge, whose line is at the distance h and on which s1 <= s <= s2,
/// is
///     h / 2  integral of (psi(x) + psi(s)) g / sqrt(h^2 + s^2) ds.
/// Edges between two triangles of the hat bear the difference of their affine functions, which is
/// zero on the edge, and outer edges a function that is: psi(x) = h c. So all that is left is
///     integral of  1/rho = ln((rho2 + s2) / (rho1 + s1)),  h^2/rho^3 = [s/rho],
///     h s/rho^3 = -h [1/rho],  h/rho^2 = [atan(s/h)],  s/rho^2 = [ln rho],  rho^2 = h^2 + s^2,
/// each computed without cancellation. The sum over the edges cancels far away, and over needles:
/// its relative error is about 1e-16 (distance / radius)^2 (radius^2 / area)^2, the radius that of
/// the hat's farthest vertex. So hats with needles (kNeedle) are summed triangle by triangle, and
/// triangles that are nearer than they are high in closed form, the others by line loads in closed
/// form and Gauss's rule across.
///
/// From kNear radii on, point loads at fixed places within the radius stand for the hat, which have
/// its moments up to degree 8, and from kFar radii on up to degree 5.
///
/// The errors, relative to the integral of phi / r, stay below 5e-12, and for hats with needles
/// below 1e-10 + 2e-12 (longest side / height) (distance / radius)^2.
///
/// Queries are const, allocate nothing and are safe from several threads.
class HatIntegrals {
 public:
  static constexpr double kNear = 14, kFar = 60;  ///< radii of the hat
  static constexpr double kNeedle = 6;            ///< a triangle's longest side over its height

  /// @param points     2 by #V, in any one unit of length.
  /// @param triangles  3 by #F, counter-clockwise, a manifold with or without rims.
  HatIntegrals(const Eigen::Matrix2Xd& points, const Eigen::Matrix3Xi& triangles);

  int vertexCount() const { return static_cast<int>(points_.cols()); }

  /// At a vertex.
  HatMoments at(int vertex, int hat) const noexcept { return at(points_.col(vertex), hat); }
  /// At any point of the plane.
  HatMoments at(const Eigen::Vector2d& x, int hat) const noexcept;

  /// Bytes held.
  std::size_t bytes() const;

 private:
  /// A triangle of a hat that has needles, its corners and height in units of the hat's radius.
  struct Needle {
    Eigen::Matrix<double, 2, 3> corners;
    double height;
    std::size_t edges, lines;  ///< in numbers_
  };
  struct Hat {
    double radius = 0, inverseRadius = 0;
    std::size_t edges = 0;  ///< in numbers_
    int edgeGroups = 0;
    int firstNeedle = 0, needleCount = 0;
  };
  void setHat(int vertex, const std::vector<Eigen::Vector2i>& ends);
  void addNeedles(const Hat& hat, double x, double y, double* moments) const noexcept;

  Eigen::Matrix2Xd points_;
  std::vector<Hat> hats_;  ///< #V
  std::vector<Needle> needles_;
  // In units of the hat's radius from its vertex, as addHatEdges, addLineLoads and addPointLoads
  // take them.
  std::vector<double> numbers_;
  Eigen::MatrixXd midLoads_, farLoads_;  ///< #loads by #V
};

}  // namespace palpate
