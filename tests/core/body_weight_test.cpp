// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a body's weight does, where the method knows what is inside.

#include <gtest/gtest.h>

#include <cmath>

#include "greens/gravity.h"
#include "support/refusals.h"
#include "support/solids.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

bool onBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

/// A column of height 2 that does not contract sideways, of two layers: moduli and densities of
/// the lower and the upper half.
struct Layers {
  double lowerModulus, upperModulus, lowerDensity, upperDensity;
};
SolidProblem layeredColumn(const Layers& layers) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 2}, {2, 2, 4}).mesh();
  std::vector<int> number;
  Eigen::VectorXd densities(mesh.cellCount());
  for (int cell = 0; cell < mesh.cellCount(); ++cell) {
    const bool isUpper = mesh.points()(2, Eigen::all)(mesh.tetrahedra().col(cell)).mean() > 1;
    number.push_back(isUpper);
    densities[cell] = isUpper ? layers.upperDensity : layers.lowerDensity;
  }
  const ElasticModel model = makeModel(boundaryOf(mesh), onBase, layers.lowerModulus, 0);
  return {model, SolidBody(model.mesh(), mesh,
                           {Elasticity(Material(layers.lowerModulus, 0)),
                            Elasticity(Material(layers.upperModulus, 0))},
                           number, densities)};
}

Eigen::Matrix3Xd under(const Eigen::Vector3d& weight, const ElasticModel& model,
                       const GreensFunctions& greens) {
  return gravityDisplacement(greens, model.mesh(), model.smoothPatches(), weight);
}

/// The force on the support under a weight.
Eigen::Vector3d reactionTo(const Eigen::Vector3d& weight, const ElasticModel& model,
                           const GreensFunctions& greens) {
  const Eigen::Matrix3Xd response =
      (weightResponse(greens, model.mesh(), model.smoothPatches()) * weight)
          .reshaped(3, greens.nodeCount());
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int node : model.conditions().fixedNodes())
    force += greens.vertexArea(node) * response.col(node);
  return force;
}

TEST(BodyWeight, ShortensAColumnOfTwoLayersAsItShould) {
  // Below z the column bears what is above: quadratic in each layer, which quadratic tetrahedra
  // hold. Displacements that are means under hats are those at vertices for raw models, within a
  // side; at sharp edges they are the nearest linear field.
  const Layers layers{2, 5, 1, 3};
  const SolidProblem column = layeredColumn(layers);
  FiniteElementOptions raw;
  raw.reciprocal = false;
  const auto greens = column.greens(raw);
  constexpr double acceleration = 0.1;
  EXPECT_NEAR(greens->info().density, 2, 1e-12);
  const Eigen::Matrix3Xd u =
      under({0, 0, -acceleration * greens->info().density}, column.model, *greens);
  double atMiddle = 0, atTop = 0;
  {
    const double upper = acceleration * layers.upperDensity,
                 lower = acceleration * layers.lowerDensity;
    atMiddle = -(upper * 1 + lower / 2) / layers.lowerModulus;
    atTop = atMiddle - upper / 2 / layers.upperModulus;
  }
  double top = 0, area = 0;
  for (int f = 0; f < column.model.mesh().triangleCount(); ++f)
    if (column.model.mesh().triangleNormals()(2, f) > 0.5) {
      const auto corners = column.model.mesh().triangles().col(f);
      area += column.model.mesh().triangleAreas()[f];
      top += column.model.mesh().triangleAreas()[f] * u(2, corners).mean();
    }
  EXPECT_NEAR(top / area, atTop, 0.01 * std::abs(atTop));
}

TEST(BodyWeight, RestsOnTheSupport) {
  const SolidProblem column = layeredColumn({2, 5, 1, 3});
  const Eigen::Vector3d weight(0.3, -0.2, -1);
  for (bool reciprocal : {true, false}) {
    FiniteElementOptions options;
    options.reciprocal = reciprocal;
    const auto greens = column.greens(options);
    // 2 m^3 of the mean density; the elements are in equilibrium to rounding.
    EXPECT_LT((reactionTo(weight, column.model, *greens) + 2 * weight).norm(), 1e-10);
  }
  const ShellProblem sheet = shellProblem(
      sheetOf(6, [](double a, double b) { return Eigen::Vector3d(2 * a, b, 0.3 * a * b); }),
      [](const Eigen::Vector3d& x) { return x.x() < 1e-9; }, {0.02, 0.3, 1});
  const auto greens = sheet.greens();
  const double volume = 0.02 * sheet.mesh().triangleAreas().sum();
  EXPECT_LT((reactionTo(weight, sheet.model, *greens) + volume * weight).norm(), 1e-8 * volume);
}

TEST(BodyWeight, IsTheSameByBoundaryAndByFiniteElements) {
  double differences[2];
  for (int level = 0; level < 2; ++level) {
    const int n = level ? 4 : 2;
    const TetrahedralMesh mesh = kuhnBox({1, 1, 2}, {n, n, 2 * n}).mesh();
    const SolidProblem block = solidProblem(mesh, onBase, 3, 0.3);
    BoundaryElementOptions options = raw();
    options.patchColumns = true;
    const auto boundary = computeGreens(block.model, options);
    FiniteElementOptions rawOptions;
    rawOptions.reciprocal = false;
    const auto finite = block.greens(rawOptions);
    const Eigen::Vector3d weight(0.5, 0.1, -1);
    const Eigen::Matrix3Xd a = under(weight, block.model, *boundary),
                           b = under(weight, block.model, *finite);
    differences[level] = (a - b).norm() / b.norm();
  }
  EXPECT_LT(differences[1], 0.03);
  EXPECT_LT(differences[1], differences[0] / 1.5);
}

TEST(BodyWeight, BendsACantileveredSheet) {
  // q L^4 / (8 D) of a beam, D = E t^3 / 12 without contraction.
  const double length = 2, thickness = 0.01;
  const ShellProblem sheet = shellProblem(
      sheetOf(16, 4, [&](double a, double b) { return Eigen::Vector3d(length * a, b, 0); }),
      [](const Eigen::Vector3d& x) { return x.x() < 1e-9; }, {thickness, 0, 1});
  const auto greens = sheet.greens();
  const Eigen::Matrix3Xd u = under({0, 0, -1}, sheet.model, *greens);
  const double expected = -thickness * std::pow(length, 4) / 8 / (std::pow(thickness, 3) / 12);
  EXPECT_NEAR(u(2, vertexNear(sheet.mesh(), {length, 0.5, 0})), expected,
              0.005 * std::abs(expected));
}

TEST(BodyWeight, ScalesWithYoungsModulusAndItsDirectionTurns) {
  const SolidProblem column = layeredColumn({2, 5, 1, 3});
  const auto greens = column.greens();
  const auto stiffer = greens->withYoungsModulus(3 * greens->info().material.youngsModulus());
  const Eigen::Vector3d weight(0.3, -0.2, -1);
  const Eigen::Matrix3Xd u = under(weight, column.model, *greens);
  EXPECT_LT((3 * under(weight, column.model, *stiffer) - u).norm(), 1e-12 * u.norm());
  EXPECT_LT((reactionTo(weight, column.model, *stiffer) - reactionTo(weight, column.model, *greens))
                .norm(),
            1e-12);
  const Eigen::Matrix3Xd sum =
      under({0.3, 0, 0}, column.model, *greens) + under({0, -0.2, -1}, column.model, *greens);
  EXPECT_LT((sum - u).norm(), 1e-12 * u.norm());
}

TEST(BodyWeight, RefusesDensitiesThatAreNone) {
  EXPECT_TRUE(isRefused([] { layeredColumn({1, 1, 1, -3}); }, "must be positive, not -3"));
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {1, 1, 1}).mesh();
  const ElasticModel model = makeModel(boundaryOf(mesh), onBase, 1, 0);
  EXPECT_TRUE(isRefused(
      [&] {
        SolidBody(model.mesh(), mesh, {Elasticity(Material(1, 0))}, {}, Eigen::VectorXd::Ones(2));
      },
      "2 densities for 6 tetrahedra"));
}

}  // namespace
}  // namespace palpate::test
