// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What is estimated against what is true: closed forms, and answers of much finer meshes.

#include "greens/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/support.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

bool below(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

std::shared_ptr<const GreensFunctions> greensOf(const ElasticModel& model, bool estimated) {
  BoundaryElementOptions options;
  options.estimateError = estimated;
  options.precision = estimated ? Precision::Double : Precision::Float;
  return computeGreens(model, options);
}

struct TrueError {
  double field, contact;
};

/// Two refinements on the same surface, and the error by the difference from the second, continued
/// with the order that the three show. Where that is too much, one refinement and the order 5/4.
TrueError trueError(const ElasticModel& model, const GreensFunctions& greens) {
  SpreadLoads loads = errorLoads(model);
  loads.length = greens.info().diagnostics.error.loadLength;
  const auto differenceFrom = [&](const ElasticModel& finer) {
    return compareUnderLoads(*greensOf(finer, false), finer.mesh(), greens, model.mesh(), loads);
  };
  const auto once = refinedModel(model);
  const LoadDifferences first = differenceFrom(once->model);
  if (model.mesh().vertexCount() > 200) {
    const double left = 1 - std::pow(2, -1.25);
    return {LoadDifferences::mean(first.field) / left, LoadDifferences::mean(first.contact) / left};
  }
  const LoadDifferences second = differenceFrom(refinedModel(once->model)->model);
  const auto limit = [](double one, double two) {
    // one = e (1 - q), two = e (1 - q^2) with q = 2^-order, between 1/4 and 3/5
    const double q = std::clamp(two / one - 1, 0.25, 0.6);
    return two / (1 - q * q);
  };
  return {limit(LoadDifferences::mean(first.field), LoadDifferences::mean(second.field)),
          limit(LoadDifferences::mean(first.contact), LoadDifferences::mean(second.contact))};
}

struct Body {
  const char* name;
  ElasticModel model;
};

std::ostream& operator<<(std::ostream& stream, const Body& body) {
  return stream << body.name;
}

std::vector<Body> bodies() {
  const ElasticModel sphere = makeModel(icosphere(2), cap, 1, 0.3),
                     finer = makeModel(icosphere(3), cap, 1, 0.3);
  return {{"SphereSharingItsPatch", sphere},
          {"SphereOnASupportPatch", withSupportPatch(sphere)},
          {"JitteredSphere", withSupportPatch(makeModel(jitteredSphere(2, 0.2), cap, 1e6, 0.45))},
          {"Cube", makeModel(box({1, 1, 1}, {5, 5, 5}), below, 1, 0.3)},
          {"Cantilever", makeModel(box({1, 1, 4}, {3, 3, 12}), below, 1, 0.3)},
          {"FinerSphereSharingItsPatch", finer},
          {"FinerSphereOnASupportPatch", withSupportPatch(finer)},
          {"FinerCube", makeModel(box({1, 1, 1}, {8, 8, 8}), below, 1, 0.45)},
          {"FinerCantilever", makeModel(box({1, 1, 4}, {4, 4, 16}), below, 1, 0.3)}};
}

class ErrorEstimates : public testing::TestWithParam<Body> {};

/// Never below half of the true error, nor above three times. The first five are estimated on a
/// finer mesh, the others on a coarser one.
TEST_P(ErrorEstimates, AreWithinAFactorThreeOfTheTruth) {
  const ElasticModel& model = GetParam().model;
  const auto greens = greensOf(model, true);
  const ErrorEstimate& estimate = greens->info().diagnostics.error;
  const TrueError truth = trueError(model, *greens);
  RecordProperty("field", std::to_string(estimate.total() / truth.field));
  RecordProperty("contact", std::to_string(estimate.contactTotal() / truth.contact));
  EXPECT_GT(estimate.total() / truth.field, 0.5) << estimate.total();
  EXPECT_LT(estimate.total() / truth.field, 3) << estimate.total();
  EXPECT_GT(estimate.contactTotal() / truth.contact, 0.5) << estimate.contactTotal();
  EXPECT_LT(estimate.contactTotal() / truth.contact, 3) << estimate.contactTotal();
}

INSTANTIATE_TEST_SUITE_P(Bodies, ErrorEstimates, testing::ValuesIn(bodies()),
                         [](const auto& test) { return test.param.name; });

/// A pressurised spherical cavity in infinite space: u = p r / (4 G), the same on every mesh.
TEST(ErrorEstimatesInClosedForm, HoldForACavityUnderPressure) {
  const double nu = 0.3;
  const auto displacement = [](const ElasticModel& model, const GreensFunctions& greens) {
    return Eigen::Matrix3Xd(solveReferenceProblem(greens, model.mesh().points()));
  };
  for (int levels : {2, 3}) {
    const ElasticModel model = makeModel(
        icosphere(levels), [](const Eigen::Vector3d&) { return false; }, 1, nu, 30,
        Domain::Exterior);
    const auto coarser = coarsenedModel(model, 30);
    ASSERT_TRUE(coarser);
    const auto greens = computeGreens(model, raw());
    const Eigen::Matrix3Xd fine = displacement(model, *greens);
    const Eigen::Matrix3Xd coarse =
        displacement(coarser->model, *computeGreens(coarser->model, raw()));
    const Eigen::Matrix3Xd exact = model.mesh().points() * (1 + nu) / 2;
    double difference = 0, error = 0;
    for (std::size_t v = 0; v < coarser->vertices.size(); ++v) {
      const int i = coarser->vertices[v];
      difference += (fine.col(i) - coarse.col(v)).squaredNorm();
      error += (fine.col(i) - exact.col(i)).squaredNorm();
    }
    const double estimate =
        std::sqrt(difference) / (std::pow(coarser->ratio, discretizationOrder(*greens)) - 1);
    EXPECT_GT(estimate / std::sqrt(error), 0.5) << levels;
    EXPECT_LT(estimate / std::sqrt(error), 3) << levels;
  }
}

TEST(ErrorEstimate, IsTheSameInAnyUnit) {
  const auto estimate = [](double length, double youngsModulus) {
    return greensOf(makeModel(
                        icosphere(2).scaled(length),
                        [length](const Eigen::Vector3d& x) { return cap(x / length); },
                        youngsModulus, 0.3),
                    true)
        ->info()
        .diagnostics.error;
  };
  const ErrorEstimate metres = estimate(1, 1), millimetres = estimate(1e-3, 1e9);
  EXPECT_NEAR(millimetres.discretization / metres.discretization, 1, 1e-6);
  EXPECT_NEAR(millimetres.contact / metres.contact, 1, 1e-6);
  EXPECT_NEAR(millimetres.loadLength / metres.loadLength, 1e-3, 1e-12);
}

/// Columns of a patch say nothing about forces elsewhere: other meshes do.
TEST(ErrorEstimate, IsMadeForFewColumnsToo) {
  for (int levels : {2, 3}) {  // one with a finer mesh, one with coarser ones
    const ElasticModel model = makeModel(icosphere(levels), cap, 1, 0.3);
    BoundaryElementOptions options;
    options.estimateError = true;
    const double whole = computeGreens(model, options)->info().diagnostics.error.discretization;
    options.columns = {0, 1, 2};
    const double few = computeGreens(model, options)->info().diagnostics.error.discretization;
    EXPECT_GT(few / whole, 0.5) << levels;
    EXPECT_LT(few / whole, 3) << levels;
  }
}

TEST(ErrorEstimate, TellsItsCausesApart) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  BoundaryElementOptions options;
  options.estimateError = true;
  options.precision = Precision::Float;
  options.tolerance = 1e-2;
  const auto rough = computeGreens(model, options);
  options.precision = Precision::Double;
  options.tolerance = 1e-8;
  const auto exact = computeGreens(model, options);
  const ErrorEstimate &a = rough->info().diagnostics.error, &b = exact->info().diagnostics.error;
  EXPECT_LT(b.integration, 1e-3 * a.integration);
  EXPECT_LT(b.solver, 1e-6 * a.solver);
  EXPECT_LT(b.storage, 1e-6 * a.storage);
  EXPECT_NEAR(a.total(), a.discretization + a.integration + a.solver + a.storage, 1e-15);
  // On one mesh: what rough integrals and arithmetic change is within what they are said to.
  const SpreadLoads loads = errorLoads(model);
  const double changed = LoadDifferences::mean(
      compareUnderLoads(*exact, model.mesh(), *rough, model.mesh(), loads).field);
  EXPECT_LT(changed, a.integration + a.solver + a.storage);
  EXPECT_GT(changed, 0.01 * (a.integration + a.solver + a.storage));
}

TEST(ErrorEstimate, IsAbsentUnlessAskedForAndCostsNothingThen) {
  const auto greens = greensOf(makeModel(icosphere(2), cap, 1, 0.3), false);
  EXPECT_LT(greens->info().diagnostics.error.total(), 0);
  for (const auto& [stage, seconds] : greens->info().diagnostics.seconds)
    EXPECT_NE(stage, "estimate");
}

TEST(SupportPatches, EndAtTheSupport) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1, 0.3);
  const Eigen::VectorXi patches =
      splitAtSupport(model.mesh(), model.conditions(), model.smoothPatches());
  EXPECT_EQ(patches.maxCoeff(), 1);
  for (int f = 0; f < model.mesh().triangleCount(); ++f) {
    bool held = true;
    for (int v : model.mesh().triangles().col(f)) held = held && model.conditions().isFixed(v);
    EXPECT_EQ(patches[f] == patches[0], !held) << f;
  }
}

}  // namespace
}  // namespace palpate::test
