// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/response_interpolation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/material_model.h"
#include "support/refusals.h"
#include "support/rigs.h"

namespace palpate::test {
namespace {

TEST(LejaPoints, LieAsDenselyAsChebyshevs) {
  const std::vector<double> points = lejaPoints(15);
  // The share of Chebyshev's points within |x| < a is 2 asin(a) / pi.
  for (double a : {0.3, 0.7, 0.95}) {
    int inside = 0;
    for (double x : points) inside += std::abs(x) < a;
    EXPECT_NEAR(inside / 15.0, 2 * std::asin(a) / M_PI, 2.0 / 15) << a;
  }
}

/// A sphere and measurements of it.
struct Sphere {
  ElasticModel model = makeModel(icosphere(1), cap, 1e4, 0.3);
  Measurements measurements = [this] {
    RigSettings rig;
    rig.probes = 3;
    rig.radius = 0.7;
    return measuredOn(computeGreens(model, {}), model.mesh(), rig);
  }();
  RigSetup rig = setupOn(model, measurements);

  MeasuredResponse exact(double poisson) const {
    const ElasticModel here(model.sharedMesh(), Material(1, poisson), model.conditions(),
                            model.smoothPatches());
    return MeasuredResponse(*computeGreens(here, {}), rig.setup, false);
  }
  ResponseInterpolation interpolation(double tolerance) const {
    ResponseInterpolation::Options options;
    options.tolerance = tolerance;
    return ResponseInterpolation(
        [this](const Eigen::VectorXd& place, const Progress&) { return exact(place[0]); },
        Eigen::VectorXd::Constant(1, 0), Eigen::VectorXd::Constant(1, 0.499), rig.setup, options);
  }
};

TEST(ResponseInterpolation, IsAsExactInPoissonsRatioAsItSays) {
  const Sphere sphere;
  int samples = 0;
  for (double tolerance : {1e-2, 1e-3, 1e-4}) {
    const ResponseInterpolation response = sphere.interpolation(tolerance);
    EXPECT_LE(response.error(), tolerance);
    EXPECT_GT(response.sampleCount(), samples) << "more is asked of it";
    samples = response.sampleCount();
    for (double poisson : {0.01, 0.07, 0.19, 0.33, 0.41, 0.47, 0.497}) {
      const Eigen::MatrixXd exact = sphere.exact(poisson).rows();
      const Eigen::MatrixXd rows =
          response.at(Eigen::VectorXd::Constant(1, poisson), 0, false).rows;
      EXPECT_LE((rows - exact).cwiseAbs().maxCoeff(), tolerance * exact.cwiseAbs().maxCoeff())
          << poisson;
    }
  }
  EXPECT_LE(samples, 11);
}

TEST(ResponseInterpolation, SlopesAreThoseOfDifferences) {
  const Sphere sphere;
  const ResponseInterpolation response = sphere.interpolation(1e-4);
  const auto at = [&](double poisson) {
    return response.at(Eigen::VectorXd::Constant(1, poisson), 0, true);
  };
  for (double poisson : {0.1, 0.31, 0.45}) {
    const Eigen::MatrixXd differences = (at(poisson + 1e-5).rows - at(poisson - 1e-5).rows) / 2e-5;
    EXPECT_LE((at(poisson).byCoordinate[0] - differences).norm(), 1e-7 * differences.norm());
  }
}

TEST(ResponseInterpolation, TakesNoMoreSamplesThanAllowed) {
  const Sphere sphere;
  ResponseInterpolation::Options options;
  options.tolerance = 1e-9;
  options.mostSamples = 4;
  const auto make = [&] {
    ResponseInterpolation(
        [&](const Eigen::VectorXd& place, const Progress&) { return sphere.exact(place[0]); },
        Eigen::VectorXd::Constant(1, 0), Eigen::VectorXd::Constant(1, 0.49), sphere.rig.setup,
        options);
  };
  EXPECT_TRUE(isRefused(make, "takes more than 4 computations of Green's functions"));
}

TEST(MaterialModel, DerivativesAreThoseOfDifferences) {
  const Sphere sphere;
  MaterialUnknowns unknowns;
  const MaterialModel model(unknowns, 2, sphere.interpolation(1e-4), sphere.rig.setup.probeOf);
  Eigen::Matrix3Xd forces(3, sphere.measurements.probes.size());
  for (Eigen::Index p = 0; p < forces.cols(); ++p)
    forces.col(p) = sphere.measurements.probes[p].force;
  const Eigen::Vector2d at(9, 0.3);
  Eigen::MatrixXd jacobian;
  model.displacements(at, forces, &jacobian);
  for (int i = 0; i < 2; ++i) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(2, i);
    const Eigen::VectorXd differences = (model.displacements(at + step, forces, nullptr) -
                                         model.displacements(at - step, forces, nullptr)) /
                                        2e-5;
    EXPECT_LE((jacobian.col(i) - differences).norm(), 1e-7 * differences.norm()) << i;
  }
}

TEST(MaterialModel, RangesThatHoldNothingAreRefused) {
  Eigen::VectorXd lower, upper;
  const auto box = [&](const MaterialUnknowns& unknowns) { boxOf(unknowns, lower, upper); };
  MaterialUnknowns unknowns;
  unknowns.poissonLower = -1;
  EXPECT_TRUE(isRefused([&] { box(unknowns); }, "within -1 < lower < upper < 0.5, not from -1"));
  unknowns.poissonLower = 0.4;
  unknowns.poissonUpper = 0.3;
  EXPECT_TRUE(isRefused([&] { box(unknowns); }, "not from 0.4 to 0.3"));
  unknowns = {};
  unknowns.regions = 9;
  EXPECT_TRUE(isRefused([&] { box(unknowns); }, "not of 9"));
  unknowns = {};
  unknowns.largestRatio = 1;
  EXPECT_TRUE(isRefused([&] { box(unknowns); }, "must be above 1"));
}

}  // namespace
}  // namespace palpate::test
