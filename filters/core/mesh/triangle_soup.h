// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate {

/// Triangles on the way to becoming a surface, which remember where they come from.
struct TriangleSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<int> vertexOrigin;  ///< a vertex of the input for each point
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangleOrigin;  ///< a triangle of the input for each triangle

  Eigen::Map<const Eigen::Matrix3Xi> triangleMatrix() const {
    return {triangles.empty() ? nullptr : triangles.front().data(), 3,
            static_cast<Eigen::Index>(triangles.size())};
  }
};

/// Sentences about what was changed, such as "dropped unused vertices: 3, 17".
class ChangeList {
 public:
  /// Adds nothing if nothing was touched; lists the first few if much was.
  void add(const std::string& what, std::vector<int> which);
  void add(const std::string& sentence) { changes_.push_back(sentence); }
  const std::vector<std::string>& changes() const { return changes_; }

 private:
  std::vector<std::string> changes_;
};

/// The usable, distinct and not collapsed triangles, with their vertices welded where they lie
/// within kDuplicateDistance of each other, and no vertex besides, all in the input's order.
/// @param points     3 by #V, any numbers.
/// @param triangles  3 by #F, any numbers.
TriangleSoup cleanSoup(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                       ChangeList& changes);

/// Drops open pieces that hang from an edge which a surface passes without them; and flat pieces
/// that share no edge with the rest: they enclose nothing.
void dropLooseTriangles(TriangleSoup& soup, ChangeList& changes);

/// Gives the pieces of the surface that only touch at vertices or edges vertices of their own. A
/// piece is what hangs together across edges of two triangles.
/// @throws std::invalid_argument naming an edge or a vertex where it is not clear which triangles
///         belong together.
void separatePieces(TriangleSoup& soup);

/// @throws std::invalid_argument naming two triangles of a one-sided surface.
/// @param merged  #soup.points, equal for points that are copies of each other.
void requireTwoSided(const TriangleSoup& soup, const std::vector<int>& merged);

}  // namespace palpate
