// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mesh/surface_point.h"

namespace palpate {

/// Where points are on another mesh of the surface that they are of.
struct SurfaceMap {
  std::vector<SurfacePoint> places;  ///< one a point
  double largestDistance = 0;        ///< of a point from its place, m
};

/// Maps points onto the nearest places, of triangles that do not face the other way: across a thin
/// wall or a narrow gap the other side may be nearer than the point's own coarse triangle. Between
/// such places a field is linear in each triangle, so that one that is linear where the surface is
/// flat is carried to points there exactly.
/// @param points   3 by any, finite, m.
/// @param normals  3 by any, out of the material; zero for points that may face anywhere.
/// @throws std::invalid_argument if sizes differ.
SurfaceMap mapOnto(const std::shared_ptr<const SurfaceMesh>& mesh, const Eigen::Matrix3Xd& points,
                   const Eigen::Matrix3Xd& normals);

}  // namespace palpate
