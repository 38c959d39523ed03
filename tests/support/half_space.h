// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "halfspace/half_space_greens_functions.h"
#include "support/shapes.h"

namespace palpate::test {

/// A flat surface, and the half-space below it.
struct HalfSpace {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const HalfSpaceGreensFunctions> greens;
};

inline ElasticModel halfSpaceModel(const std::shared_ptr<const SurfaceMesh>& mesh,
                                   double poissonRatio = 0.3, double youngsModulus = 1) {
  return ElasticModel(mesh, Material(youngsModulus, poissonRatio),
                      BoundaryConditions(std::vector<unsigned char>(mesh->vertexCount(), 0)),
                      Eigen::VectorXi::Zero(mesh->triangleCount()), Domain::HalfSpace);
}

inline HalfSpace halfSpace(const Shape& shape, double poissonRatio = 0.3, bool reciprocal = true,
                           double youngsModulus = 1) {
  const auto mesh = shape.sheet();
  HalfSpaceOptions options;
  options.reciprocal = reciprocal;
  return {mesh, computeHalfSpaceGreensFunctions(halfSpaceModel(mesh, poissonRatio, youngsModulus),
                                                options)};
}

/// Xi[row, column].
inline Eigen::Matrix3d blockOf(const GreensFunctions& greens, int row, int column) {
  Eigen::Matrix3d block;
  greens.gather(Eigen::VectorXi::Constant(1, row), Eigen::VectorXi::Constant(1, column),
                block.data());
  return block;
}

}  // namespace palpate::test
