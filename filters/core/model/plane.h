// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

class SurfaceMesh;

/// A plane with axes, right-handed: normal = first x second.
struct Plane {
  Eigen::Vector3d origin, first, second, normal;

  /// The coordinates along the axes of a point's projection.
  Eigen::Vector2d of(const Eigen::Vector3d& point) const {
    return {first.dot(point - origin), second.dot(point - origin)};
  }
};

/// How far, as a part of its bounding box's diagonal, a surface may be off the plane that it is
/// taken for: what is left of a plane in single precision, with some room.
constexpr double kFlatness = 1e-6;

/// The plane that a flat surface lies in, through its centroid, its normal the triangles'. Where
/// the normal is along a coordinate axis to rounding, all axes are coordinate axes.
/// @throws std::invalid_argument naming the vertex farthest off and by how much, or a triangle that
///         faces the other way.
Plane planeOf(const SurfaceMesh& mesh);

}  // namespace palpate
