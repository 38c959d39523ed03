// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/body_surface.h"

#include <cmath>

#include "model/elastic_model.h"

namespace palpate::bem {
namespace {

std::vector<int> verticesOfBody(const ElasticModel& model, int body) {
  std::vector<int> vertices;
  for (int v = 0; v < model.mesh().vertexCount(); ++v)
    if (model.domain() == Domain::Exterior || model.mesh().bodyOfVertex(v) == body)
      vertices.push_back(v);
  return vertices;
}

std::vector<int> trianglesOfBody(const ElasticModel& model, int body) {
  std::vector<int> triangles;
  for (int f = 0; f < model.mesh().triangleCount(); ++f)
    if (model.domain() == Domain::Exterior ||
        model.mesh().bodyOfVertex(model.mesh().triangles()(0, f)) == body)
      triangles.push_back(f);
  return triangles;
}

Eigen::Matrix3Xi localTriangles(const ElasticModel& model, const std::vector<int>& vertices,
                                const std::vector<int>& faces) {
  std::vector<int> local(model.mesh().vertexCount(), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) local[vertices[i]] = static_cast<int>(i);
  Eigen::Matrix3Xi triangles(3, faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) triangles(k, f) = local[model.mesh().triangles()(k, faces[f])];
  return triangles;
}

template <class Vector>
Vector pick(const Vector& values, const std::vector<int>& indices) {
  Vector picked(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) picked[i] = values[indices[i]];
  return picked;
}

}  // namespace

int BodySurface::bodyCount(const ElasticModel& model) {
  return model.domain() == Domain::Exterior ? 1 : model.mesh().bodyCount();
}

BodySurface::BodySurface(const ElasticModel& model, int body)
    : BodySurface(model, verticesOfBody(model, body), trianglesOfBody(model, body)) {}

BodySurface::BodySurface(const ElasticModel& model, std::vector<int> verticesOfModel,
                         const std::vector<int>& faces)
    : vertices(std::move(verticesOfModel)),
      length(std::sqrt(pick(model.mesh().triangleAreas(), faces).sum())),
      triangles(localTriangles(model, vertices, faces)),
      areas(pick(model.mesh().triangleAreas(), faces) / (length * length)),
      exterior(model.domain() == Domain::Exterior),
      poissonRatio(model.material().poissonRatio()),
      nodes(static_cast<int>(vertices.size()), triangles, areas,
            pick(model.smoothPatches(), faces)) {
  const SurfaceMesh& mesh = model.mesh();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int v : vertices) middle += mesh.points().col(v) / double(vertices.size());
  points.resize(3, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    points.col(i) = (mesh.points().col(vertices[i]) - middle) / length;
    fixed.push_back(model.conditions().isFixed(vertices[i]));
  }
  normals.resize(3, faces.size());
  std::vector<int> localShell(mesh.shellCount(), -1);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    normals.col(f) = mesh.triangleNormals().col(faces[f]);
    const int global = mesh.shellOfVertex(mesh.triangles()(0, faces[f]));
    if (localShell[global] < 0) {
      localShell[global] = static_cast<int>(shellIsCavity.size());
      shellIsCavity.push_back(exterior || mesh.isCavity(global));
    }
    shell.push_back(localShell[global]);
  }
}

}  // namespace palpate::bem
