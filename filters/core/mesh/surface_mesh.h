// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <vector>

#include "mesh/rims.h"

namespace palpate {

/// A closed, oriented triangle surface: the boundary of one or several elastic bodies. Where rims
/// are allowed it is a sheet of one or several pieces, open or closed, each a body of its own.
///
/// A *shell* is a connected component of the surface. A shell nested in another bounds a cavity and
/// points inwards (out of the material); a shell nested in a cavity is a body of its own. A *body*
/// is an outer shell with the cavities directly inside it.
///
/// Everything is computed by the constructor; queries are const and safe from several threads.
class SurfaceMesh {
 public:
  /// @param points     3 by #V, coordinates in metres (or any one unit of length).
  /// @param triangles  3 by #F, vertex indices, counter-clockwise seen from outside the material.
  /// @throws std::invalid_argument naming the first defect that `findMeshDefects` or, without rims,
  ///         `findOrientationDefects` reports.
  SurfaceMesh(Eigen::Matrix3Xd points, Eigen::Matrix3Xi triangles, Rims rims = Rims::Refused);

  /// As constructed.
  Rims rims() const { return rims_; }

  int vertexCount() const { return static_cast<int>(points_.cols()); }
  int triangleCount() const { return static_cast<int>(triangles_.cols()); }
  const Eigen::Matrix3Xd& points() const { return points_; }
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }

  /// #V, a_j = integral of vertex j's hat function ([JP01] eq. 5): a third of its triangles' area.
  const Eigen::VectorXd& vertexAreas() const { return vertexAreas_; }
  /// #F.
  const Eigen::VectorXd& triangleAreas() const { return triangleAreas_; }
  /// 3 by #F, unit normals out of the material.
  const Eigen::Matrix3Xd& triangleNormals() const { return triangleNormals_; }
  /// 3 by #V, unit area-weighted normals (zero where the triangles' normals cancel).
  const Eigen::Matrix3Xd& vertexNormals() const { return vertexNormals_; }
  /// Length of a triangle's longest edge.
  double longestEdge(int triangle) const;
  /// Mean length over the edges.
  double meanEdgeLength() const { return meanEdgeLength_; }
  /// Diagonal of the bounding box.
  double diagonal() const { return diagonal_; }

  int shellCount() const { return static_cast<int>(shellBody_.size()); }
  int bodyCount() const { return bodyCount_; }
  int shellOfVertex(int vertex) const { return vertexShell_[vertex]; }
  int bodyOfShell(int shell) const { return shellBody_[shell]; }
  int bodyOfVertex(int vertex) const { return shellBody_[vertexShell_[vertex]]; }
  /// True where the shell bounds a cavity of its body.
  bool isCavity(int shell) const { return shellIsCavity_[shell]; }

  /// The triangles around a vertex, as a range of triangle indices.
  struct TriangleRange {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
    int size() const { return static_cast<int>(last - first); }
  };
  TriangleRange trianglesOfVertex(int vertex) const {
    return {incident_.data() + incidentStart_[vertex],
            incident_.data() + incidentStart_[vertex + 1]};
  }

 private:
  void computeGeometry();
  void computeMeanEdgeLength();
  void computeShells();

  Rims rims_;
  Eigen::Matrix3Xd points_;
  Eigen::Matrix3Xi triangles_;
  Eigen::VectorXd vertexAreas_, triangleAreas_;
  Eigen::Matrix3Xd triangleNormals_, vertexNormals_;
  double meanEdgeLength_ = 0, diagonal_ = 0;
  std::vector<int> incident_, incidentStart_;
  std::vector<int> vertexShell_, shellBody_;
  std::vector<bool> shellIsCavity_;
  int bodyCount_ = 0;
};

/// 64-bit FNV-1a hash of a mesh and of integer data that belongs to it. Any change of a
/// coordinate's bits, of a triangle or of the data gives another value.
class Fingerprint {
 public:
  Fingerprint& add(const void* bytes, std::size_t count);
  Fingerprint& add(const SurfaceMesh& mesh);
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ull;
};

}  // namespace palpate
