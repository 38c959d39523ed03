// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Bodies that nothing holds.

#include "greens/rigid_motions.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "greens/gravity.h"
#include "mesh/tetrahedralization.h"
#include "support/problems.h"
#include "support/refusals.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

bool nowhere(const Eigen::Vector3d&) {
  return false;
}

ElasticModel loose(const Shape& shape, double poissonRatio) {
  return makeModel(shape, nowhere, 2, poissonRatio, 30, Domain::Unsupported);
}

Eigen::MatrixXd matrixOf(const GreensFunctions& greens) {
  const std::vector<int> nodes = greens.info().conditions.freeNodes();
  Eigen::MatrixXd matrix(3 * nodes.size(), 3 * nodes.size());
  greens.gather(nodeList(nodes), nodeList(nodes), matrix.data());
  return matrix;
}

struct Method {
  const char* name;
  std::shared_ptr<const GreensFunctions> (*greens)(const ElasticModel& model, bool reciprocal);
};

std::shared_ptr<const GreensFunctions> byBoundaryElements(const ElasticModel& model,
                                                          bool reciprocal) {
  BoundaryElementOptions options;
  options.reciprocal = reciprocal;
  return computeBoundaryElementGreensFunctions(model, options).take();
}

std::shared_ptr<const GreensFunctions> byFiniteElements(const ElasticModel& model,
                                                        bool reciprocal) {
  FiniteElementOptions options;
  options.reciprocal = reciprocal;
  const Tetrahedralization filled = tetrahedralize(model.mesh());
  const ElasticModel onIt = onBoundary(model, filled);
  return computeFiniteElementGreensFunctions(
             onIt, SolidBody(onIt.mesh(), filled.mesh, {Elasticity(model.material())}), options)
      .take();
}

const Method kMethods[] = {{"BoundaryElements", byBoundaryElements},
                           {"FiniteElements", byFiniteElements}};

class UnsupportedBodies : public testing::TestWithParam<Method> {};

/// On a sphere under the tractions of a uniform stress: error of displacements, which are linear.
double uniformStressError(int level, double poissonRatio, const Method& method, bool reciprocal) {
  const ElasticModel ball = loose(icosphere(level), poissonRatio);
  const auto greens = method.greens(ball, reciprocal);
  Eigen::Matrix3d stress;
  stress << 1, 0.4, -0.3, 0.4, -0.5, 0.2, -0.3, 0.2, 0.3;
  const Eigen::Matrix3d strain =
      ((1 + poissonRatio) * stress - poissonRatio * stress.trace() * Eigen::Matrix3d::Identity()) /
      2;
  const Eigen::Matrix3Xd& points = ball.mesh().points();  // their own normals
  const Eigen::Matrix3Xd exact = strain * points;
  const Eigen::Matrix3Xd found = solveReferenceProblem(*greens, stress * points);
  return relativeError(found, exact, ball, [](int) { return true; });
}

TEST_P(UnsupportedBodies, TakeOnAUniformStress) {
  for (double poissonRatio : {0.0, 0.3, 0.49}) {
    const double coarse = uniformStressError(1, poissonRatio, GetParam(), false),
                 fine = uniformStressError(2, poissonRatio, GetParam(), false);
    EXPECT_LT(fine, 0.06) << poissonRatio;
    EXPECT_GT(convergenceOrder(coarse, 42, fine, 162), 1.5) << poissonRatio;
  }
  EXPECT_LT(uniformStressError(2, 0.3, GetParam(), true), 0.08);
}

TEST_P(UnsupportedBodies, DoNotMoveOnTheWholeAndAnswerToNoRigidLoad) {
  for (bool reciprocal : {true, false}) {
    const ElasticModel ball = loose(jitteredSphere(2, 0.2), 0.3);
    const auto greens = GetParam().greens(ball, reciprocal);
    const Eigen::MatrixXd xi = matrixOf(*greens);
    // The smallest six singular values are rounding, the next ones a deformation's.
    const Eigen::VectorXd values = xi.bdcSvd().singularValues();
    const Eigen::Index count = values.size();
    EXPECT_LT(values[count - 6], 1e-11 * values[0]);
    EXPECT_GT(values[count - 7], 1e-4 * values[0]);
    if (!reciprocal) continue;
    Eigen::MatrixXd compliance = xi;
    for (int v = 0; v < greens->nodeCount(); ++v)
      compliance.middleCols<3>(3 * v) /= greens->vertexArea(v);
    EXPECT_LT((compliance - compliance.transpose()).norm(), 1e-12 * compliance.norm());
    EXPECT_GT(compliance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(),
              -1e-12 * compliance.norm());
  }
}

TEST_P(UnsupportedBodies, AreEachByThemselves) {
  const Shape one = icosphere(1);
  const ElasticModel two = loose(one.with(one.moved({5, 0, 0})), 0.3);
  const ElasticModel alone = loose(one, 0.3);
  const Eigen::MatrixXd both = matrixOf(*GetParam().greens(two, true)),
                        single = matrixOf(*GetParam().greens(alone, true));
  const Eigen::Index size = single.rows();
  EXPECT_LT(both.topRightCorner(size, size).norm(), 1e-12 * single.norm());
  if (GetParam().greens == byBoundaryElements) {  // two are not filled as one alone is
    EXPECT_LT((both.topLeftCorner(size, size) - single).norm(), 1e-9 * single.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, UnsupportedBodies, testing::ValuesIn(kMethods),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(UnsupportedBody, IsPressedAlikeByBothMethods) {
  // Two opposite pressures on caps about the poles: they balance each other.
  const ElasticModel ball = loose(icosphere(3), 0.3);
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, ball.mesh().vertexCount());
  for (int v = 0; v < given.cols(); ++v)
    if (const Eigen::Vector3d x = ball.mesh().points().col(v); std::abs(x.z()) > 0.8)
      given.col(v) = -x;
  const Eigen::Matrix3Xd a = solveReferenceProblem(*byBoundaryElements(ball, true), given),
                         b = solveReferenceProblem(*byFiniteElements(ball, true), given);
  EXPECT_LT((a - b).norm(), 0.03 * b.norm());
}

TEST(UnsupportedBody, HasNoWeightNoSupportAndNoSingleColumns) {
  const ElasticModel ball = loose(icosphere(1), 0.3);
  const auto greens = byBoundaryElements(ball, true);
  EXPECT_TRUE(isRefused(
      [&] {
        gravityDisplacement(*greens, ball.mesh(), ball.smoothPatches(), {0, 0, -1});
      },
      "falls freely"));
  EXPECT_TRUE(
      isRefused([] { makeModel(icosphere(1), cap, 1, 0.3, 30, Domain::Unsupported); }, "is fixed"));
  BoundaryElementOptions options;
  options.columns = {3};
  EXPECT_TRUE(isRefused([&] { computeBoundaryElementGreensFunctions(ball, options); },
                        "balanced at all of its vertices"));
  options.columns = {};
  options.patchColumns = true;
  EXPECT_TRUE(isRefused([&] { computeBoundaryElementGreensFunctions(ball, options); },
                        "no Green's functions of single patches"));
}

}  // namespace
}  // namespace palpate::test
