// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/measured_response.h"

#include <gtest/gtest.h>

#include "contact/capacitance_solver.h"
#include "support/refusals.h"
#include "support/rigs.h"

namespace palpate::test {
namespace {

constexpr double kYoung = 2e4;

/// A sphere on a cap with all columns, and measurements of it.
struct Sphere {
  ElasticModel model = makeModel(icosphere(2), cap, kYoung, 0.3);
  std::shared_ptr<const GreensFunctions> greens = [this] {
    BoundaryElementOptions options;
    options.columns = allNodes(model);
    return computeGreens(model, options);
  }();
  Measurements measurements = [this] {
    RigSettings rig;
    rig.probes = 3;
    rig.markers = 20;
    rig.radius = 0.5;
    rig.noise = 0;
    Measurements m = measuredOn(greens, model.mesh(), rig);
    m.displacements[5].marker = {model.conditions().fixedNodes()[2],
                                 Eigen::Vector3d::Zero()};  // on the support, too
    return m;
  }();
  RigSetup rig = setupOn(model, measurements);
};

/// Displacements of the markers by the contact's own solver.
Eigen::VectorXd byCapacitance(const Sphere& s, double stiffnessPerArea) {
  CapacitanceSolver solver(s.greens, s.model.sharedMesh());
  const int markers = s.rig.setup.markerCount();
  Eigen::VectorXd seen(3 * markers);
  for (int p = 0; p < s.rig.setup.probeCount(); ++p) {
    BoundaryValues values;
    values.given.setZero(3, s.greens->nodeCount());
    const SpreadForce& load = s.rig.setup.loads[p];
    for (std::size_t j = 0; j < load.nodes.size(); ++j)
      values.given.col(load.nodes[j]) = load.density[j] * s.measurements.probes[p].force;
    if (stiffnessPerArea > 0) {
      values.switches = switchesOfNodes(s.model.conditions().fixedNodes());
      for (ConstraintSwitch& change : values.switches) change.yield = stiffnessPerArea;
      values.prescribed.setZero(values.switches.size());
    }
    const Eigen::Matrix3Xd displacement = solver.solve(values).displacement;
    for (int i = 0; i < markers; ++i)
      if (s.rig.setup.probeOf[i] == p)
        seen.segment<3>(3 * i) =
            displacement(Eigen::all, s.rig.setup.nodes[i]) * s.rig.setup.weights[i];
  }
  return seen;
}

Eigen::VectorXd timesForces(const Sphere& s, const Eigen::MatrixXd& rows) {
  Eigen::VectorXd seen(rows.rows());
  for (int i = 0; i < s.rig.setup.markerCount(); ++i)
    seen.segment<3>(3 * i) =
        rows.middleRows<3>(3 * i) * s.measurements.probes[s.rig.setup.probeOf[i]].force;
  return seen;
}

TEST(MeasuredResponse, OnAFirmSupportIsThatOfTheReferenceProblem) {
  const Sphere s;
  const MeasuredResponse response(*s.greens, s.rig.setup, false);
  const Eigen::VectorXd exact = byCapacitance(s, 0);
  EXPECT_LE((timesForces(s, response.rows()) - exact).norm(), 1e-12 * exact.norm());
  EXPECT_EQ(response.onFoundation(0.3, nullptr), response.rows()) << "none was prepared";
}

TEST(MeasuredResponse, OnAFoundationIsWhatReleasedSpringsGive) {
  const Sphere s;
  const MeasuredResponse response(*s.greens, s.rig.setup, true);
  EXPECT_EQ(response.onFoundation(0, nullptr), response.rows());
  for (double length : {1e-3, 0.1, 3.0}) {
    const Eigen::VectorXd exact = byCapacitance(s, kYoung / length);
    // What the capacitance's inverse leaves.
    EXPECT_LE((timesForces(s, response.onFoundation(length, nullptr)) - exact).norm(),
              1e-9 * exact.norm())
        << length;
  }
}

TEST(MeasuredResponse, ItsDerivativeIsThatOfDifferences) {
  const Sphere s;
  const MeasuredResponse response(*s.greens, s.rig.setup, true);
  for (double length : {1e-2, 1.0}) {
    const double step = 1e-4 * length;
    Eigen::MatrixXd slope;
    response.onFoundation(length, &slope);
    const Eigen::MatrixXd differences = (response.onFoundation(length + step, nullptr) -
                                         response.onFoundation(length - step, nullptr)) /
                                        (2 * step);
    EXPECT_LE((slope - differences).norm(), 1e-6 * slope.norm()) << length;
  }
}

TEST(MeasuredResponse, AFoundationNeedsTheSupportsColumns) {
  const Sphere s;
  const auto free = computeGreens(s.model, {});
  EXPECT_TRUE(isRefused([&] { MeasuredResponse(*free, s.rig.setup, true); }, "column"));
}

TEST(PointLoad, IsThePointContacts) {
  const Sphere s;
  const SpreadForce& load = s.rig.setup.loads[0];
  double total = 0;
  for (std::size_t j = 0; j < load.nodes.size(); ++j)
    total += load.density[j] * s.greens->vertexArea(load.nodes[j]);
  EXPECT_NEAR(total, 1, 1e-13);
}

}  // namespace
}  // namespace palpate::test
