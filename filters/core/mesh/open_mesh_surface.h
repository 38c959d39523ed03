// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// Included by this room's OpenMesh sources alone.

#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace palpate {

struct OpenMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMeshSurface = OpenMesh::TriMesh_ArrayKernelT<OpenMeshTraits>;

/// Vertices and faces keep their numbers.
inline OpenMeshSurface toOpenMesh(const Eigen::Matrix3Xd& points,
                                  const Eigen::Matrix3Xi& triangles) {
  OpenMeshSurface mesh;
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    mesh.add_vertex({points(0, v), points(1, v), points(2, v)});
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
    mesh.add_face(mesh.vertex_handle(triangles(0, f)), mesh.vertex_handle(triangles(1, f)),
                  mesh.vertex_handle(triangles(2, f)));
  return mesh;
}

}  // namespace palpate
