// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "progress.h"

namespace palpate {

/// A mended surface, where its parts come from, and what was done to it.
struct RepairedSurface {
  Eigen::Matrix3Xd points;            ///< 3 by #V
  Eigen::Matrix3Xi triangles;         ///< 3 by #F
  std::vector<int> originalVertex;    ///< #V, vertex of the input, -1 for a new one
  std::vector<int> originalTriangle;  ///< #F, triangle of the input, -1 for a new one
  std::vector<std::string> changes;  ///< a sentence for each kind of change, naming what it touched
};

/// Mends a triangle soup into a surface that SurfaceMesh accepts, as far as that can be done
/// without guessing (CGAL): drops unusable, collapsed and repeated triangles, dangling and flat
/// pieces and unused vertices, welds vertices within 1e-9 of the diagonal, parts sheets that touch
/// at vertices or edges, fills holes, flips triangles without height, rebuilds the surface where it
/// cuts through itself, and turns triangles to point out of the material. A sound surface comes
/// back unchanged, with no changes reported.
/// @param points     3 by #V.
/// @param triangles  3 by #F.
/// @throws std::invalid_argument "the surface cannot be mended: ..." with the first defect that is
///         left, or with what would have to be guessed; std::runtime_error when CGAL gives up or
///         the library was built without it; Aborted.
RepairedSurface repairSurface(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                              const ProgressCallback& progress = {});

}  // namespace palpate
