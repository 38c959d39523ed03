// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/pressure_mask.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

// Rounding, as under a rotation of the mesh, must not decide what belongs to a mask: vertices just
// at the radius and normals at right angles (the edges of a box) do not.
constexpr double kEdgeOfRadius = 1 - 1e-9;
constexpr double kSmallestCosine = 1e-6;

}  // namespace

MaskShape maskShapeFromName(const std::string& name) {
  if (name == "linear") return MaskShape::Linear;
  if (name == "uniform") return MaskShape::Uniform;
  if (name == "gaussian") return MaskShape::Gaussian;
  if (name == "hertzian") return MaskShape::Hertzian;
  throw std::invalid_argument("there is no mask '" + name +
                              "': choose linear, uniform, gaussian or hertzian");
}

double maskValue(MaskShape shape, double t) {
  if (t >= 1) return 0;
  switch (shape) {
    case MaskShape::Linear:
      return 1 - t;
    case MaskShape::Uniform:
      return 1;
    case MaskShape::Gaussian:
      return std::exp(-4.5 * t * t);
    case MaskShape::Hertzian:
      return std::sqrt(1 - t * t);
  }
  return 0;
}

PressureMasks::PressureMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             MaskShape shape, double radius)
    : mesh_(mesh), conditions_(conditions), shape_(shape), radius_(radius) {
  if (!(radius >= 0) || !std::isfinite(radius))
    throw std::invalid_argument("the radius of a pressure mask must be at least 0, not " +
                                std::to_string(radius));
  if (conditions.nodeCount() != mesh.vertexCount())
    throw std::invalid_argument("there are boundary types of " +
                                std::to_string(conditions.nodeCount()) +
                                " vertices for a surface of " + std::to_string(mesh.vertexCount()));
}

VertexMask PressureMasks::at(int vertex) const {
  if (vertex < 0 || vertex >= mesh_.vertexCount())
    throw std::invalid_argument("there is no vertex " + std::to_string(vertex) +
                                " to put a pressure mask on");
  if (conditions_.isFixed(vertex))
    throw std::invalid_argument("vertex " + std::to_string(vertex) +
                                " is fixed: a pressure mask needs a free node");
  const Eigen::Vector3d centre = mesh_.points().col(vertex);
  const Eigen::Vector3d normal = mesh_.vertexNormals().col(vertex);
  std::vector<int> reached{vertex};
  std::vector<bool> seen(mesh_.vertexCount(), false);
  seen[vertex] = true;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int f : mesh_.trianglesOfVertex(reached[i]))
      for (int k = 0; k < 3; ++k) {
        const int v = mesh_.triangles()(k, f);
        if (seen[v]) continue;
        seen[v] = true;
        if ((mesh_.points().col(v) - centre).norm() < kEdgeOfRadius * radius_ &&
            mesh_.vertexNormals().col(v).dot(normal) > kSmallestCosine)
          reached.push_back(v);
      }
  VertexMask mask;
  std::vector<double> values;
  double total = 0;
  for (int v : reached) {
    const double t = v == vertex ? 0 : (mesh_.points().col(v) - centre).norm() / radius_;
    const double value = maskValue(shape_, t);
    if (conditions_.isFixed(v) || value <= 0) continue;
    mask.nodes.push_back(v);
    values.push_back(value);
    total += mesh_.vertexAreas()[v] * value;
  }
  mask.density = Eigen::Map<Eigen::VectorXd>(values.data(), values.size()) / total;
  return mask;
}

}  // namespace palpate
