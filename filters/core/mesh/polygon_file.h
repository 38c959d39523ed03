// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate {

/// Polygons as they stand in a file, without any claim to be a surface.
struct PolygonSoup {
  Eigen::Matrix3Xd points;                 ///< 3 by #V
  std::vector<std::vector<int>> polygons;  ///< corners of each
};

/// Reads an Object File Format file (.off; CGAL).
/// @throws std::runtime_error if the file cannot be opened or read, or when the library was built
///         without CGAL.
PolygonSoup readOffFile(const std::string& path);

/// The same for a Polygon File Format file, text or binary (.ply; CGAL).
PolygonSoup readPlyFile(const std::string& path);

}  // namespace palpate
