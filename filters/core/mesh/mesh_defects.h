// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/rims.h"

namespace palpate {

class SurfaceMesh;

enum class MeshDefectKind {
  Empty,
  NonFiniteCoordinate,
  IndexOutOfRange,
  DegenerateTriangle,
  DuplicateTriangle,
  UnusedVertex,
  DuplicateVertex,
  NonManifoldEdge,
  OpenBoundary,
  InconsistentOrientation,
  NonManifoldVertex,
  InwardOrientation,
  NoVolume,
  SelfIntersection,
};

/// One thing that keeps a triangle soup from bounding elastic bodies.
struct MeshDefect {
  MeshDefectKind kind;
  int index;             ///< the vertex or triangle at fault, -1 for none
  std::string sentence;  ///< for the user: names the index and the value
};

/// The usual name of a kind of defect, such as "open boundary".
const char* nameOf(MeshDefectKind kind);

/// A defect with a sentence that begins with the name of its kind.
MeshDefect describeDefect(MeshDefectKind kind, int index, const std::string& text);

/// Vertices closer than this, as a part of the bounding box's diagonal, are duplicates.
constexpr double kDuplicateDistance = 1e-9;

/// Finite and small enough (1e60) for areas and volumes to be finite, too.
bool isUsablePoint(const Eigen::Vector3d& point);

/// True if a triangle's height is below 1e-10 of its longest edge, or that edge below 1e-70 (where
/// squared areas vanish).
bool isDegenerateTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c);

/// Finds what keeps triangles from being a closed, oriented manifold without degenerate triangles,
/// or one with rims where these are allowed.
/// The check stops after the first kind of defect that later kinds depend on.
/// @param points         3 by #V.
/// @param triangles      3 by #F.
/// @param largestCount   at most so many defects are listed.
std::vector<MeshDefect> findMeshDefects(const Eigen::Matrix3Xd& points,
                                        const Eigen::Matrix3Xi& triangles,
                                        std::size_t largestCount = 16, Rims rims = Rims::Refused);

struct Shells;

/// Shells that enclose nothing or whose triangles point into the material.
std::vector<MeshDefect> findOrientationDefects(const Shells& shells, std::size_t largestCount = 16);

/// @throws std::invalid_argument with the first defect's sentence, if there is any.
void requireNoDefect(const std::vector<MeshDefect>& defects);

/// For every vertex the lowest-numbered vertex within `distance` of it (itself if there is none).
/// @param points  3 by #V, finite.
std::vector<int> nearestDuplicates(const Eigen::Matrix3Xd& points, double distance);

/// Triangles that cross each other or touch beyond a shared vertex or edge (CGAL). Empty when the
/// library was built without CGAL.
/// @param largestCount  at most so many pairs are listed, those of the lowest triangles.
std::vector<MeshDefect> findSelfIntersections(const SurfaceMesh& mesh,
                                              std::size_t largestCount = 16);

}  // namespace palpate
