// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/modulus_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/refusals.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

/// A cube, stiffer towards one corner, pressed at two vertices.
struct Cube {
  TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {3, 3, 3}).mesh();
  ElasticModel model = makeModel(boundaryOf(mesh), base, 1, 0.3);
  Eigen::VectorXd modulus{mesh.cellCount()};
  Eigen::MatrixXd modes{mesh.cellCount(), 2};
  Eigen::MatrixXd forces;

  Cube() {
    for (int c = 0; c < mesh.cellCount(); ++c) {
      const Eigen::Vector3d x =
          mesh.points()(Eigen::all, mesh.tetrahedra().col(c)).rowwise().mean();
      modulus[c] = 1e4 * std::exp(x.sum());
      modes.row(c) << 1, std::sin(5 * x.x()) * x.z();
    }
    forces.setZero(3 * model.mesh().vertexCount(), 2);
    forces.col(0).segment<3>(3 * top(0)) << 1, 2, -5;
    forces.col(1).segment<3>(3 * top(7)) << 0, 3, 4;
  }
  int top(int which) const {
    for (int v = 0;; ++v)
      if (model.mesh().points()(2, v) > 0.99 && which-- == 0) return v;
  }
};

class Moduli : public ::testing::TestWithParam<double> {};

TEST_P(Moduli, DisplaceAsTheGreensFunctionsOfTheSameBody) {
  const Cube cube;
  const ModulusResponse response(cube.model, cube.mesh, cube.modes, cube.forces);
  const auto answer = response.at(cube.modulus, GetParam(), false);
  EXPECT_TRUE(answer.byModes.empty());
  const auto greens = SolidProblem{cube.model, response.body(cube.modulus, GetParam())}.greens();
  const Eigen::VectorXd areas = cube.model.mesh().vertexAreas();
  for (int load = 0; load < 2; ++load) {
    Eigen::Matrix3Xd tractions = cube.forces.col(load).reshaped(3, areas.size());
    tractions *= areas.cwiseInverse().asDiagonal();
    Eigen::Matrix3Xd expected = solveReferenceProblem(*greens, tractions);
    for (int v : cube.model.conditions().fixedNodes()) expected.col(v).setZero();
    EXPECT_LE((answer.displacements.col(load) - expected.reshaped()).norm(),
              1e-9 * expected.norm());
  }
}

TEST_P(Moduli, DerivativesAreThoseOfDifferences) {
  constexpr double kStep = 1e-4;
  const Cube cube;
  const ModulusResponse response(cube.model, cube.mesh, cube.modes, cube.forces);
  const auto answer = response.at(cube.modulus, GetParam(), true);
  ASSERT_EQ(answer.byModes.size(), 2u);
  for (int mode = 0; mode < 2; ++mode) {
    const Eigen::VectorXd factor = (kStep * cube.modes.col(mode)).array().exp();
    const Eigen::MatrixXd
        up = response.at(cube.modulus.cwiseProduct(factor), GetParam(), false).displacements,
        down = response.at(cube.modulus.cwiseQuotient(factor), GetParam(), false).displacements;
    for (int load = 0; load < 2; ++load) {
      const Eigen::VectorXd expected = (up - down).col(load) / (2 * kStep);
      EXPECT_LE((answer.byModes[load].col(mode) - expected).norm(), 1e-6 * expected.norm());
    }
  }
  // All moduli by the same factor: displacements fall as much.
  EXPECT_LE((answer.byModes[0].col(0) + answer.displacements.col(0)).norm(),
            1e-9 * answer.displacements.col(0).norm());
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, Moduli, ::testing::Values(-0.3, 0.3, 0.48));

TEST(ModulusResponse, WhatDoesNotGoTogetherIsRefused) {
  const Cube cube;
  EXPECT_TRUE(
      isRefused([&] { ModulusResponse(cube.model, cube.mesh, cube.modes.topRows(5), cube.forces); },
                "modes have 5 rows for 162 tetrahedra"));
  EXPECT_TRUE(
      isRefused([&] { ModulusResponse(cube.model, cube.mesh, cube.modes, cube.forces.topRows(4)); },
                "forces have 4 rows"));
  std::vector<unsigned char> types(cube.model.mesh().vertexCount(), 0);
  const ElasticModel loose(cube.model.sharedMesh(), cube.model.material(),
                           BoundaryConditions(types), cube.model.smoothPatches(),
                           Domain::Unsupported);
  EXPECT_TRUE(isRefused([&] { ModulusResponse(loose, cube.mesh, cube.modes, cube.forces); },
                        "must be held"));
}

}  // namespace
}  // namespace palpate::test
