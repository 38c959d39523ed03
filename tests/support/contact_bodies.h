// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "contact/surface_stiffness.h"
#include "support/problems.h"

namespace palpate::test {

/// A body to touch: its surface and its Green's functions, with the columns of all nodes.
struct TouchedBody {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const GreensFunctions> greens;
};

/// Boundary element Green's functions of a surface taken as smooth (one patch), E = 2.5, nu = 0.3.
/// @param types  a BoundaryType a vertex.
inline TouchedBody touchedBody(const Shape& shape, const std::vector<unsigned char>& types,
                               bool reciprocal, Domain domain = Domain::Interior) {
  const auto mesh = shape.mesh();
  const ElasticModel model(mesh, Material(2.5, 0.3), BoundaryConditions(types),
                           Eigen::VectorXi::Zero(mesh->triangleCount()), domain);
  BoundaryElementOptions options = rawWithAllColumns(model);
  options.reciprocal = reciprocal;
  return {mesh, computeGreens(model, options)};
}

/// An irregular unit sphere (42, 162, 642 vertices at levels 1, 2, 3), fixed below z = -0.6.
inline TouchedBody touchedSphere(int level, bool reciprocal) {
  const Shape shape = jitteredSphere(level, 0.2);
  return touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() < -0.6; }),
                     reciprocal);
}

/// A body's stiffness under masks whose radius is so many mean edges.
inline std::shared_ptr<const SurfaceStiffness> maskedStiffness(const TouchedBody& body,
                                                               double radiusInEdges,
                                                               double rigid = 0) {
  return std::make_shared<SurfaceStiffness>(body.greens, body.mesh, MaskShape::Linear,
                                            radiusInEdges * body.mesh->meanEdgeLength(), rigid);
}

}  // namespace palpate::test
