// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/gravity.h"

#include <gtest/gtest.h>

#include "mesh/smooth_patches.h"
#include "support/problems.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

constexpr double kModulus = 3;

struct Hung {
  ElasticModel model;
  std::shared_ptr<const GreensFunctions> greens;

  Hung(const Shape& shape, const Place& fixed, double poissonRatio, bool allColumns = false)
      : model(makeModel(shape, fixed, kModulus, poissonRatio)) {
    BoundaryElementOptions options = allColumns ? rawWithAllColumns(model) : raw();
    options.patchColumns = true;
    greens = computeGreens(model, options);
  }
  Eigen::Matrix3Xd under(const Eigen::Vector3d& weight) const {
    return gravityDisplacement(*greens, model.mesh(), model.smoothPatches(), weight);
  }
};

/// A column of height H that does not contract sideways, on its base or hung from it:
/// u_z = -b (H z - z^2 / 2) / E, all else zero.
TEST(Gravity, ShortensAColumn) {
  constexpr double weight = 0.4;
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    const int n = level ? 4 : 2;
    const Hung column(
        box({1, 1, 2}, {n, n, 2 * n}), [](const auto& x) { return x.z() < 1e-9; }, 0);
    const Eigen::Matrix3Xd u = column.under({0, 0, -weight});
    Eigen::Matrix3Xd exact = Eigen::Matrix3Xd::Zero(3, u.cols());
    for (int v = 0; v < u.cols(); ++v) {
      const double z = column.model.mesh().points()(2, v);
      exact(2, v) = -weight / kModulus * (2 * z - z * z / 2);
    }
    errors[level] = (u - exact).norm() / exact.norm();
    EXPECT_LE((column.under({0, 0, weight}) + u).norm(), 1e-12 * u.norm());
  }
  EXPECT_LT(errors[1], 0.02);
  EXPECT_LT(errors[1], errors[0] / 2);
}

/// By Betti's theorem or by the columns of fixed nodes: two ways to the same.
TEST(Gravity, AgreesWithDisplacedSupports) {
  const Eigen::Vector3d weight(0.1, 0.2, -0.5);
  double differences[2];
  for (int level = 2; level <= 3; ++level) {
    const Hung ball(icosphere(level), cap, 0.3, true);
    const SurfaceMesh& mesh = ball.model.mesh();
    const Eigen::Vector3d c = -0.4 / kModulus * weight;
    Eigen::Matrix3Xd given(3, mesh.vertexCount()), particular = given;
    for (int v = 0; v < mesh.vertexCount(); ++v) {
      const Eigen::Vector3d x = mesh.points().col(v);
      particular.col(v) = c.dot(x) * x - x.squaredNorm() / 2 * c;
      given.col(v) = ball.greens->isFixed(v) ? Eigen::Vector3d(-particular.col(v))
                                             : Eigen::Vector3d(weight.dot(x) * x);
    }
    Eigen::Matrix3Xd exact = solveReferenceProblem(*ball.greens, given) + particular;
    for (int v = 0; v < mesh.vertexCount(); ++v)
      if (ball.greens->isFixed(v)) exact.col(v).setZero();
    differences[level - 2] = (ball.under(weight) - exact).norm() / exact.norm();
  }
  EXPECT_LT(differences[1], 0.05);
  EXPECT_LT(differences[1], differences[0] / 1.5);
}

TEST(Gravity, RefusesWhatItCannotKnow) {
  const Shape shape = icosphere(1);
  const ElasticModel model = makeModel(shape, cap, kModulus, 0.3);
  BoundaryElementOptions one = raw();
  one.columns = {model.conditions().freeNodes().front()};
  const auto greens = computeGreens(model, one);
  const Eigen::Vector3d weight(0, 0, -1);
  EXPECT_TRUE(
      isRefused([&] { gravityDisplacement(*greens, model.mesh(), model.smoothPatches(), weight); },
                "were not computed"));
  const Hung ball(shape, cap, 0.3);
  EXPECT_TRUE(isRefused([&] { gravityDisplacement(*ball.greens, ball.model.mesh(), {}, weight); },
                        "0 patch numbers for 80"));
  const ElasticModel space = makeModel(
      shape, [](const auto&) { return false; }, kModulus, 0.3, 30, Domain::Exterior);
  const auto around = computeGreens(space, raw());
  EXPECT_TRUE(
      isRefused([&] { gravityDisplacement(*around, space.mesh(), space.smoothPatches(), weight); },
                "has no weight"));
  SyntheticBody given;
  GreensFunctionsInfo info = given.info();
  info.domain = Domain::Given;
  const auto imported = denseGreens(info, given.matrix());
  EXPECT_TRUE(isRefused([&] { gravityDisplacement(*imported, model.mesh(), {}, weight); },
                        "the weight of what a given matrix is of is not known"));
}

}  // namespace
}  // namespace palpate::test
