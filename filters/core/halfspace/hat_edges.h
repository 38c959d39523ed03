// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpate {

/// A triangle of a hat function, counter-clockwise: the hat is 1 in the corner at the origin, 0 at
/// a and b, whose vertices have numbers.
struct HatSector {
  Eigen::Vector2d a, b;
  int aVertex, bVertex;

  double doubleArea() const;
  /// The corner opposite to the longest side: 0 the origin, 1 a, 2 b.
  int apex() const;
  Eigen::Vector2d corner(int k) const;
  double longestSide() const;
  /// Over the longest side.
  double height() const { return doubleArea() / longestSide(); }
};

/// The numbers of hat edges (hat_integrals_kernel.h) in groups: those of a whole hat, on whose
/// outer edges it is zero, and whose spokes bear the differences of the affine functions on both
/// sides.
std::vector<double> hatEdges(const std::vector<HatSector>& sectors);

/// Those of one of its triangles alone; and its line loads: from both ends of its longest side to
/// points of the height over it, as many as one group has, by Gauss's rule. Where a point is
/// farther off than the triangle is high, they give its integrals to 1e-12.
std::vector<double> needleEdges(const HatSector& sector);
std::vector<double> needleLines(const HatSector& sector);

}  // namespace palpate
