// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/remeshing.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mesh/cgal_surface.h"
#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

constexpr double kMostTriangles = 1e7;

using Face = CgalSurface::Face_index;
using Vertex = CgalSurface::Vertex_index;
using FaceNumbers = CgalSurface::Property_map<Face, int>;

/// @throws std::invalid_argument unless the surface is one, and the edge length makes sense on it.
void requireSensible(const SurfaceMesh& mesh, const std::vector<unsigned char>& types,
                     const Eigen::VectorXi& patches, double edgeLength, int iterations) {
  if (static_cast<int>(types.size()) != mesh.vertexCount() ||
      patches.size() != mesh.triangleCount())
    throw std::invalid_argument("remeshing takes a boundary type for each of the " +
                                std::to_string(mesh.vertexCount()) +
                                " vertices and a smooth patch for each of the " +
                                std::to_string(mesh.triangleCount()) + " triangles");
  std::ostringstream length;
  length << edgeLength;
  if (!(edgeLength > 0) || !(edgeLength < mesh.diagonal()))
    throw std::invalid_argument(
        "the edge length must be above 0 and below the surface's diagonal, " +
        std::to_string(mesh.diagonal()) + ", not " + length.str());
  if (mesh.triangleAreas().sum() / (std::sqrt(3.) / 4 * edgeLength * edgeLength) > kMostTriangles)
    throw std::invalid_argument("edges of " + length.str() +
                                " would make more than ten million triangles: choose longer ones");
  if (iterations < 1 || iterations > 100)
    throw std::invalid_argument("remeshing takes 1 to 100 iterations, not " +
                                std::to_string(iterations));
}

/// Smooth patch and support of a triangle as one number.
int regionOf(int patch, bool isFixed) {
  return 2 * patch + isFixed;
}

RemeshedSurface fromCgal(const CgalSurface& surface, const FaceNumbers& regions) {
  RemeshedSurface result;
  result.points.resize(3, surface.number_of_vertices());
  result.triangles.resize(3, surface.number_of_faces());
  result.smoothPatches.resize(surface.number_of_faces());
  result.boundaryTypes.assign(surface.number_of_vertices(), 0);
  for (Vertex v : surface.vertices())
    result.points.col(v.idx()) << surface.point(v).x(), surface.point(v).y(), surface.point(v).z();
  for (Face f : surface.faces()) {
    int k = 0;
    for (Vertex v : surface.vertices_around_face(surface.halfedge(f)))
      result.triangles(k++, f.idx()) = static_cast<int>(v.idx());
    const bool isFixed = regions[f] & 1;
    result.smoothPatches[f.idx()] = (regions[f] - isFixed) / 2;
    if (isFixed)
      for (k = 0; k < 3; ++k) result.boundaryTypes[result.triangles(k, f.idx())] = 1;
  }
  return result;
}

}  // namespace

RemeshedSurface remeshIsotropic(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                                const std::vector<unsigned char>& boundaryTypes,
                                const Eigen::VectorXi& smoothPatches, double edgeLength,
                                int iterations, const ProgressCallback& callback) {
  const SurfaceMesh mesh(points, triangles);
  requireSensible(mesh, boundaryTypes, smoothPatches, edgeLength, iterations);
  const Progress progress(callback);
  CgalSurface surface = toCgal(points, triangles);
  FaceNumbers regions = surface.add_property_map<Face, int>("f:region", 0).first;
  std::vector<bool> isHeld(points.cols(), false);
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    bool isFixed = true;
    for (int k = 0; k < 3; ++k) isFixed = isFixed && boundaryTypes[triangles(k, f)] != 0;
    regions[Face(f)] = regionOf(smoothPatches[f], isFixed);
    for (int k = 0; k < 3; ++k)
      if (isFixed) isHeld[triangles(k, f)] = true;
  }
  for (int v = 0; v < mesh.vertexCount(); ++v)
    if (boundaryTypes[v] != 0 && !isHeld[v])
      throw std::invalid_argument("vertex " + std::to_string(v) +
                                  " is fixed, but no triangle with all its corners fixed holds it, "
                                  "so that another mesh would lose it");
  // One call an iteration would restart the projection from the remeshed surface; the old one is
  // what all of them project onto.
  progress.report(0, "remesh");
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      surface.faces(), edgeLength, surface,
      CGAL::parameters::number_of_iterations(iterations).face_patch_map(regions));
  progress.report(0.9, "remesh");
  surface.collect_garbage();
  RemeshedSurface result = fromCgal(surface, regions);
  try {
    const SurfaceMesh sound(result.points, result.triangles);
  } catch (const std::invalid_argument& defect) {
    std::ostringstream sentence;
    sentence << "edges of " << edgeLength << " are too long for this surface: " << defect.what();
    throw std::runtime_error(sentence.str());
  }
  progress.report(1, "remesh");
  return result;
}

}  // namespace palpate
