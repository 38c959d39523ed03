// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What boundary_element_method_test leaves open: precisions, columns, several bodies, progress,
// refusals.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "bem/boundary_element_method.h"
#include "contact/capacitance_solver.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

Eigen::MatrixXd matrixOf(const ComputedGreensFunctions& result) {
  const Eigen::Index rows = 3 * result.info.conditions.nodeCount();
  const Eigen::Index columns = 3 * result.info.columnNodes.size();
  if (result.floatMatrix.size() > 0)
    return Eigen::Map<const Eigen::MatrixXf>(result.floatMatrix.data(), rows, columns)
        .cast<double>();
  return Eigen::Map<const Eigen::MatrixXd>(result.matrix.data(), rows, columns);
}

Eigen::MatrixXd computeWith(const ElasticModel& model, const BoundaryElementOptions& options) {
  return matrixOf(computeBoundaryElementGreensFunctions(model, options));
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

TEST(Precision, MixedAgreesWithDoubleToTenDigitsAndFloatToFour) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  BoundaryElementOptions options = raw();
  const Eigen::MatrixXd exact = computeWith(model, options);
  options.precision = Precision::Mixed;
  EXPECT_LT(difference(computeWith(model, options), exact), 1e-10);
  options.precision = Precision::Float;
  EXPECT_LT(difference(computeWith(model, options), exact), 1e-4);  // condition 1e3 times 6e-8
}

TEST(Precision, FloatServesOrdinaryBodiesAndRefusesSlenderOnes) {
  BoundaryElementOptions options = raw();
  options.columns = {0};
  const ElasticModel sphere = makeModel(icosphere(3), cap, 1, 0.3);
  const Eigen::MatrixXd exact = computeWith(sphere, options);
  options.precision = Precision::Float;
  EXPECT_LT(difference(computeWith(sphere, options), exact), 1e-4);
  const ElasticModel rod = makeModel(
      box({1, 1, 24}, {1, 1, 24}), [](const Eigen::Vector3d& x) { return x.z() < 1e-9; }, 1, 0.3);
  EXPECT_TRUE(isRefused<std::runtime_error>(
      [&] { computeBoundaryElementGreensFunctions(rod, options); }, "use double or mixed"));
}

TEST(Columns, ComputedAloneAreThoseOfTheWhole) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  const Eigen::MatrixXd whole = computeWith(model, rawWithAllColumns(model));
  BoundaryElementOptions options = raw();
  options.columns = {0, 17, 80, model.conditions().fixedNodes().front()};
  const ComputedGreensFunctions few = computeBoundaryElementGreensFunctions(model, options);
  ASSERT_EQ(few.info.columnNodes.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_LT(difference(matrixOf(few).middleCols(3 * c, 3),
                         whole.middleCols(3 * few.info.columnNodes[c], 3)),
              1e-12);
}

TEST(SeveralBodies, ArrangeThemselvesWithoutTouchingEachOther) {
  for (const double gap : {1e-1, 1e-5}) {
    const Shape one = icosphere(2), two = one.with(one.moved({0, 0, 2 + gap}));
    const auto caps = [&](const Eigen::Vector3d& x) {
      return x.z() < 1 + gap / 2 ? cap(x) : cap(x - Eigen::Vector3d(0, 0, 2 + gap));
    };
    const ElasticModel single = makeModel(one, cap, 1, 0.3), pair = makeModel(two, caps, 1, 0.3);
    const Eigen::MatrixXd alone = computeWith(single, raw()), both = computeWith(pair, raw());
    EXPECT_LT(difference(both.topLeftCorner(alone.rows(), alone.cols()), alone), 1e-12);
    EXPECT_LT(difference(both.bottomRightCorner(alone.rows(), alone.cols()), alone), 1e-9);
    EXPECT_EQ(both.bottomLeftCorner(alone.rows(), alone.cols()).norm(), 0);
  }
}

TEST(Equilibrium, ReactionsBalanceEveryLoadToRounding) {
  const ElasticModel model = makeModel(jitteredSphere(2, 0.3), cap, 1, 0.3);
  const auto greens = computeGreens(model, raw());
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Random(3, greens->nodeCount());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int v : model.conditions().fixedNodes()) given.col(v).setZero();
  for (int v = 0; v < greens->nodeCount(); ++v) sum += greens->vertexArea(v) * given.col(v);
  const Eigen::Matrix3Xd solved = solveReferenceProblem(*greens, given);
  for (int v : model.conditions().fixedNodes()) sum += greens->vertexArea(v) * solved.col(v);
  EXPECT_LT(sum.norm(), 1e-12 * given.norm());
}

TEST(Equilibrium, ReactionsOfAClampedBeamBearItsMoment) {
  const auto base = [](const Eigen::Vector3d& x) { return x.z() < 1e-9; };
  for (const int divisions : {2, 3}) {
    const Shape shape = box({1, 1, 4}, {divisions, divisions, 4 * divisions});
    const ElasticModel model = makeModel(shape, base, 1, 0.3);
    const auto greens = computeGreens(model, raw());
    // A shear on every patch of the end's inner vertices, where it has one patch only.
    Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, greens->nodeCount());
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
    for (int v : model.conditions().freeNodes()) {
      const Eigen::Vector3d x = shape.points.col(v);
      if (x.z() < 4 - 1e-9 || x.head<2>().minCoeff() < 1e-9 || x.head<2>().maxCoeff() > 1 - 1e-9)
        continue;
      given.col(v) = Eigen::Vector3d(1, 0.3, -0.2);
      Eigen::Vector3d arm = Eigen::Vector3d::Zero();
      for (int f : model.mesh().trianglesOfVertex(v))
        arm += model.mesh().triangleAreas()[f] / 12 *
               (shape.points(Eigen::all, shape.triangles.col(f)).rowwise().sum() + x);
      force += greens->vertexArea(v) * given.col(v);
      torque += arm.cross(Eigen::Vector3d(given.col(v)));
    }
    const Eigen::Matrix3Xd solved = solveReferenceProblem(*greens, given);
    const Eigen::Matrix3Xd points =
        forcePoints(model.mesh(), model.conditions(), model.smoothPatches());
    const Wrench reaction =
        wrenchOf(*greens, points, model.conditions().fixedNodes(), solved, Eigen::Vector3d::Zero());
    EXPECT_LT((reaction.force + force).norm(), 1e-12 * force.norm());
    EXPECT_LT((reaction.torque + torque).norm(), 1e-10 * torque.norm()) << divisions;
  }
}

TEST(Reciprocity, DefectOfTheRawMatrixFallsWithRefinementAndIsGoneWhenServed) {
  const auto defect = [](int levels) {
    const ElasticModel model = makeModel(icosphere(levels), cap, 1, 0.3);
    return computeBoundaryElementGreensFunctions(model, raw()).info.diagnostics.reciprocityDefect;
  };
  const double coarse = defect(2), fine = defect(3);
  EXPECT_GT(fine, 1e-4);          // the raw matrix is not symmetric: there is something to measure
  EXPECT_LT(fine, 0.6 * coarse);  // first order in the mesh size
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  const auto served = computeBoundaryElementGreensFunctions(model).take();
  const std::vector<int>& nodes = served->info().columnNodes;
  Eigen::MatrixXd blocks(3 * nodes.size(), 3 * nodes.size());
  served->gather(nodeList(nodes), nodeList(nodes), blocks.data());
  for (std::size_t j = 0; j < nodes.size(); ++j)
    blocks.middleCols(3 * j, 3) /= served->vertexArea(nodes[j]);
  EXPECT_LT(difference(blocks, blocks.transpose()), 1e-15);
}

TEST(Progress, RisesToTheEndAndMayAbort) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  double last = -1;
  std::vector<std::string> stages;
  computeBoundaryElementGreensFunctions(model, {}, [&](double fraction, const char* stage) {
    EXPECT_GE(fraction, last);
    last = fraction;
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(stages, (std::vector<std::string>{"assemble", "factor", "solve", "done"}));
  for (const std::string& when : stages) {
    const auto stopThere = [&](double, const char* stage) { return stage != when; };
    EXPECT_THROW(computeBoundaryElementGreensFunctions(model, {}, stopThere), Aborted) << when;
  }
}

TEST(Refusals, NameWhatIsWrong) {
  const ElasticModel model = makeModel(icosphere(1), cap, 1, 0.3);
  for (const double tolerance : {-1.0, 1.0, std::nan("")}) {
    BoundaryElementOptions options;
    options.tolerance = tolerance;
    EXPECT_THROW(computeBoundaryElementGreensFunctions(model, options), std::invalid_argument);
  }
  // Two bodies, one incompressible and fixed all over, whose columns are asked for.
  const Shape two = icosphere(1).with(icosphere(1).moved({5, 0, 0}));
  const auto fixed = [](const Eigen::Vector3d& x) { return cap(x) || x.x() > 2; };
  const ElasticModel enclosed = makeModel(two, fixed, 1, 0.5);
  BoundaryElementOptions options;
  options.columns = {0, 50};
  EXPECT_TRUE(isRefused<std::invalid_argument>(
      [&] { computeBoundaryElementGreensFunctions(enclosed, options); }, "incompressible"));
  EXPECT_EQ(computeBoundaryElementGreensFunctions(enclosed).info.columnNodes.size(),
            enclosed.conditions().freeNodes().size());
}

TEST(Memory, PeakStaysWithinTwoMatrices) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  const double n = 3.0 * model.mesh().vertexCount();
  const auto result = computeBoundaryElementGreensFunctions(model);
  EXPECT_LT(double(result.info.diagnostics.peakBytes), 2.2 * 8 * n * n);
  EXPECT_GT(double(result.info.diagnostics.peakBytes), 8 * n * n);
}

}  // namespace
}  // namespace palpate::test
