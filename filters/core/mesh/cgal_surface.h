// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// For the sources of this room that use CGAL only.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>

namespace palpate {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;
using CgalSurface = CGAL::Surface_mesh<CgalPoint>;

inline CgalPoint toCgal(const Eigen::Vector3d& x) {
  return CgalPoint(x.x(), x.y(), x.z());
}

/// Vertices and triangles keep their numbers. The triangles must form a manifold.
inline CgalSurface toCgal(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  CgalSurface surface;
  for (Eigen::Index v = 0; v < points.cols(); ++v) surface.add_vertex(toCgal(points.col(v)));
  using Vertex = CgalSurface::Vertex_index;
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
    surface.add_face(Vertex(triangles(0, f)), Vertex(triangles(1, f)), Vertex(triangles(2, f)));
  return surface;
}

}  // namespace palpate
