// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/coarsening.h"

#include <algorithm>
#include <cmath>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <stdexcept>

#include "mesh/mesh_defects.h"
#include "mesh/open_mesh_surface.h"

namespace palpate {
namespace {

using Mesh = OpenMeshSurface;
using Vertex = Mesh::VertexHandle;
using Face = Mesh::FaceHandle;
using Halfedge = Mesh::HalfedgeHandle;
using Vector = Mesh::Point;

constexpr double kCorner = -0.2;       // cosine; rims that turn by more than 102 degrees stay
constexpr double kTurn = 0.5;          // cosine of the most that a triangle turns
constexpr double kLongestEdge = 3;     // of the edges before; 2 are aimed at
constexpr double kLeastQuality = 0.3;  // 1 for an equilateral triangle

/// What of a surface must be kept, and how long its edges were.
struct Features {
  OpenMesh::FPropHandleT<int> patch;
  OpenMesh::FPropHandleT<bool> support;  ///< all three corners fixed
  OpenMesh::VPropHandleT<int> origin;    ///< number in the surface
  OpenMesh::VPropHandleT<double> size;   ///< mean length of the edges before
  OpenMesh::VPropHandleT<bool> fixed, kept;
};

/// Between two smooth patches, or the support and the rest.
bool isRim(const Mesh& mesh, const Features& features, Halfedge edge) {
  const Face one = mesh.face_handle(edge), other = mesh.opposite_face_handle(edge);
  return mesh.property(features.patch, one) != mesh.property(features.patch, other) ||
         mesh.property(features.support, one) != mesh.property(features.support, other);
}

/// Corners of rims, where other than two rim edges meet or these turn sharply; and fixed vertices
/// that hold no triangle.
bool isCorner(const Mesh& mesh, const Features& features, Vertex vertex) {
  std::vector<Vector> rims;
  bool holds = !mesh.property(features.fixed, vertex);
  for (const auto edge : mesh.voh_range(vertex)) {
    holds = holds || mesh.property(features.support, mesh.face_handle(edge));
    if (isRim(mesh, features, edge)) rims.push_back(mesh.calc_edge_vector(edge).normalized());
  }
  if (!holds) return true;
  if (rims.empty()) return false;
  return rims.size() != 2 || -dot(rims[0], rims[1]) < kCorner;
}

class ModNeighbourhood : public OpenMesh::Decimater::ModBaseT<Mesh> {
 public:
  using Base = OpenMesh::Decimater::ModBaseT<Mesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<ModNeighbourhood>;
  explicit ModNeighbourhood(Mesh& mesh) : Base(mesh, false) {}

  const std::string& name() const override {
    static const std::string kName = "Neighbourhood";
    return kName;
  }

  void setFeatures(const Features* features) { features_ = features; }

  /// The longest edge that the collapse would make, in edges of before.
  float collapse_priority(const CollapseInfo& collapse) override {
    const Mesh& mesh = collapse.mesh;
    if (!mayVanish(collapse)) return Base::ILLEGAL_COLLAPSE;
    double longest = 0;
    for (const Halfedge out : mesh.voh_range(collapse.v0)) {
      const Face face = mesh.face_handle(out);
      const Vertex a = mesh.to_vertex_handle(out),
                   b = mesh.to_vertex_handle(mesh.next_halfedge_handle(out));
      if (a != collapse.v1) {
        const double size = mesh.property(features_->size, a) +
                            mesh.property(features_->size, collapse.v1) +
                            mesh.property(features_->size, collapse.v0);
        longest = std::max(longest, 3 * (mesh.point(a) - collapse.p1).norm() / size);
      }
      if (a != collapse.v1 && b != collapse.v1 && !mayBecome(collapse, face, a, b))
        return Base::ILLEGAL_COLLAPSE;
    }
    return longest > kLongestEdge ? float(Base::ILLEGAL_COLLAPSE) : float(longest);
  }

 private:
  bool isFixed(Vertex v) const { return mesh_->property(features_->fixed, v); }

  /// Vertices of rims move along them, fixed ones within the support.
  bool mayVanish(const CollapseInfo& collapse) {
    mesh_ = &collapse.mesh;
    if (mesh_->property(features_->kept, collapse.v0)) return false;
    if (isFixed(collapse.v0) && !isFixed(collapse.v1)) return false;
    bool onRim = false;
    for (const Halfedge out : mesh_->voh_range(collapse.v0))
      onRim = onRim || isRim(*mesh_, *features_, out);
    return !onRim || isRim(*mesh_, *features_, collapse.v0v1);
  }

  /// Whether the triangle (v0, a, b) may become (v1, a, b).
  bool mayBecome(const CollapseInfo& collapse, Face face, Vertex a, Vertex b) const {
    const Vector pa = mesh_->point(a), pb = mesh_->point(b);
    const Vector before = cross(pa - collapse.p0, pb - collapse.p0);
    const Vector after = cross(pa - collapse.p1, pb - collapse.p1);
    if (dot(before, after) <= kTurn * before.norm() * after.norm()) return false;
    const auto quality = [&](const Vector& apex, const Vector& normal) {
      return 2 * std::sqrt(3.0) * normal.norm() /
             ((pa - apex).sqrnorm() + (pb - apex).sqrnorm() + (pa - pb).sqrnorm());
    };
    const double least = std::min(kLeastQuality, quality(collapse.p0, before));
    if (quality(collapse.p1, after) < least) return false;
    // A triangle with three fixed corners would join the support.
    return mesh_->property(features_->support, face) ||
           !(isFixed(collapse.v1) && isFixed(a) && isFixed(b));
  }

  const Mesh* mesh_ = nullptr;
  const Features* features_ = nullptr;
};

Features addFeatures(Mesh& mesh, const std::vector<unsigned char>& boundaryTypes,
                     const Eigen::VectorXi& smoothPatches) {
  Features features;
  mesh.add_property(features.patch);
  mesh.add_property(features.support);
  mesh.add_property(features.origin);
  mesh.add_property(features.size);
  mesh.add_property(features.fixed);
  mesh.add_property(features.kept);
  for (const auto v : mesh.vertices()) {
    mesh.property(features.origin, v) = v.idx();
    mesh.property(features.fixed, v) = boundaryTypes[v.idx()] != 0;
    double sum = 0;
    for (const auto edge : mesh.voh_range(v)) sum += mesh.calc_edge_length(edge);
    mesh.property(features.size, v) = sum / mesh.valence(v);
  }
  for (const auto f : mesh.faces()) {
    bool support = true;
    for (const auto v : mesh.fv_range(f)) support = support && mesh.property(features.fixed, v);
    mesh.property(features.support, f) = support;
    mesh.property(features.patch, f) = smoothPatches[f.idx()];
  }
  for (const auto v : mesh.vertices())
    mesh.property(features.kept, v) = isCorner(mesh, features, v);
  return features;
}

CoarsenedSurface toSurface(const Mesh& mesh, const Features& features) {
  CoarsenedSurface surface;
  surface.points.resize(3, mesh.n_vertices());
  for (const auto v : mesh.vertices())
    surface.vertices.push_back(mesh.property(features.origin, v));
  std::sort(surface.vertices.begin(), surface.vertices.end());
  std::vector<int> number(mesh.n_vertices());
  surface.boundaryTypes.resize(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    const auto at = std::lower_bound(surface.vertices.begin(), surface.vertices.end(),
                                     mesh.property(features.origin, v));
    number[v.idx()] = static_cast<int>(at - surface.vertices.begin());
    surface.points.col(number[v.idx()]) = Eigen::Map<const Eigen::Vector3d>(mesh.point(v).data());
    surface.boundaryTypes[number[v.idx()]] = mesh.property(features.fixed, v);
  }
  surface.triangles.resize(3, mesh.n_faces());
  surface.smoothPatches.resize(mesh.n_faces());
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.fv_range(f)) surface.triangles(k++, f.idx()) = number[v.idx()];
    surface.smoothPatches[f.idx()] = mesh.property(features.patch, f);
  }
  return surface;
}

}  // namespace

CoarsenedSurface coarsen(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                         const std::vector<unsigned char>& boundaryTypes,
                         const Eigen::VectorXi& smoothPatches, int vertices) {
  requireNoDefect(findMeshDefects(points, triangles, 1));
  if (boundaryTypes.size() != std::size_t(points.cols()) ||
      smoothPatches.size() != triangles.cols() || vertices < 4)
    throw std::invalid_argument(
        "coarsening takes a boundary type for each vertex, a smooth patch for each triangle and at "
        "least 4 vertices that are wanted");
  Mesh mesh = toOpenMesh(points, triangles);
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  const Features features = addFeatures(mesh, boundaryTypes, smoothPatches);

  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  ModNeighbourhood::Handle module;
  decimater.add(module);
  decimater.module(module).setFeatures(&features);
  decimater.initialize();
  decimater.decimate_to(vertices);
  mesh.garbage_collection();
  return toSurface(mesh, features);
}

}  // namespace palpate
