// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/boundary_element_method.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact/capacitance_solver.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool nowhere(const Eigen::Vector3d&) {
  return false;
}

class PoissonRatio : public testing::TestWithParam<double> {};

/// A2: the field of a point force outside the body.
double kelvinSourceError(int levels, double nu) {
  return pointSourceError(makeModel(icosphere(levels), cap, 1, nu));
}

TEST_P(PoissonRatio, PointSourceOutsideTheBodyConvergesWithOrderTwo) {
  const double coarse = kelvinSourceError(2, GetParam()), fine = kelvinSourceError(3, GetParam());
  EXPECT_LT(fine, 0.005);
  EXPECT_GT(convergenceOrder(coarse, 162, fine, 642), 1.8);
}

INSTANTIATE_TEST_SUITE_P(Materials, PoissonRatio,
                         testing::Values(-0.5, 0.0, 0.3, 0.45, 0.499, 0.5));

class ExteriorPoissonRatio : public testing::TestWithParam<double> {};

/// A6, A7: a rigid sphere in infinite space, moved and turned.
std::pair<double, double> rigidSphereErrors(int levels, double nu) {
  const ElasticModel model = makeModel(icosphere(levels), nowhere, 1, nu, 30, Domain::Exterior);
  const auto greens = computeGreens(model, raw());
  const auto mesh = icosphere(levels).mesh();
  CapacitanceSolver solver(greens, mesh);
  std::vector<int> nodes;
  for (int v = 0; v < mesh->vertexCount(); ++v) nodes.push_back(v);
  const double g = model.material().shearModulus();
  Eigen::Matrix3Xd shift = Eigen::Matrix3Xd::Zero(3, nodes.size()), turn = shift;
  for (int v : nodes) {
    shift.col(v) = Eigen::Vector3d::UnitX();
    turn.col(v) = Eigen::Vector3d::UnitZ().cross(mesh->points().col(v));
  }
  const auto wrench = [&](const Eigen::Matrix3Xd& values) {
    return wrenchOf(*greens, mesh->points(), nodes,
                    solver.solve(switchWholeNodes(nodes, values)).traction,
                    Eigen::Vector3d::Zero());
  };
  const double force = 24 * kPi * g * (1 - nu) / (5 - 6 * nu), torque = 8 * kPi * g;
  return {wrench(shift).force.x() / force - 1, wrench(turn).torque.z() / torque - 1};
}

TEST_P(ExteriorPoissonRatio, RigidSphereInInfiniteSpaceResistsAsInClosedForm) {
  const auto [forceCoarse, torqueCoarse] = rigidSphereErrors(2, GetParam());
  const auto [forceFine, torqueFine] = rigidSphereErrors(3, GetParam());
  EXPECT_LT(std::abs(forceFine), 0.005);
  EXPECT_LT(std::abs(torqueFine), 0.01);
  EXPECT_GT(convergenceOrder(std::abs(forceCoarse), 162, std::abs(forceFine), 642), 1.8);
}

/// A9, A10: radial displacement of a pressurised cavity; surface displacement of a cavity under
/// remote tension along z.
std::pair<double, double> cavityErrors(int levels, double nu) {
  const ElasticModel model = makeModel(icosphere(levels), nowhere, 1, nu, 30, Domain::Exterior);
  const auto greens = computeGreens(model, raw());
  const Eigen::Matrix3Xd& x = model.mesh().points();
  const double g = model.material().shearModulus();
  const Eigen::Matrix3Xd pressurised = solveReferenceProblem(*greens, x);
  // Removing the stress S e_z e_z from an infinite body leaves the traction S n_z e_z on the
  // cavity's wall; the normal out of the material is -x. The remote field's own displacement is
  // added back.
  Eigen::Matrix3Xd relief = Eigen::Matrix3Xd::Zero(3, x.cols()), remote = x, exact = x;
  relief.row(2) = x.row(2);
  remote.topRows(2) *= -nu;
  const Eigen::Matrix3Xd tension = solveReferenceProblem(*greens, relief) + remote;
  const double cx = -3 * (1 - nu) * (5 * nu + 1) / (2 * (7 - 5 * nu));
  const double cz = 3 * (1 - nu) * (5 * nu + 9) / (2 * (7 - 5 * nu));
  exact.topRows(2) *= cx;
  exact.row(2) *= cz;
  const auto all = [](int) { return true; };
  return {relativeError(pressurised, x / (4 * g), model, all),
          relativeError(tension, exact, model, all)};
}

TEST_P(ExteriorPoissonRatio, CavitiesUnderPressureAndTensionOpenAsInClosedForm) {
  const auto [pressureCoarse, tensionCoarse] = cavityErrors(2, GetParam());
  const auto [pressureFine, tensionFine] = cavityErrors(3, GetParam());
  EXPECT_LT(pressureFine, 0.02);
  EXPECT_LT(tensionFine, 0.01);
  EXPECT_GT(convergenceOrder(pressureCoarse, 162, pressureFine, 642), 1.8);
  EXPECT_GT(convergenceOrder(tensionCoarse, 162, tensionFine, 642), 1.8);
}

INSTANTIATE_TEST_SUITE_P(Materials, ExteriorPoissonRatio,
                         testing::Values(-0.5, 0.0, 0.3, 0.45, 0.499, 0.5));

/// A8: a thick sphere under inner pressure.
class ThickSphere : public testing::TestWithParam<double> {};
TEST_P(ThickSphere, InnerPressureOpensBothSurfacesAsInClosedForm) {
  const double nu = GetParam();
  const Shape outer = icosphere(3).scaled(2), inner = icosphere(3).flipped();
  const Shape shape = outer.with(inner);
  // Held at three points of the outer surface against rigid motion only; the exact displacement is
  // prescribed there.
  const auto held = [&](const Eigen::Vector3d& x) { return x.z() > 1.999 || x.x() > 1.95; };
  const ElasticModel model = makeModel(shape, held, 1, nu);
  const auto greens = computeGreens(model, rawWithAllColumns(model));
  const auto [exact, given] = thickSphere(model);
  const Eigen::Matrix3Xd solved = solveReferenceProblem(*greens, given);
  const double error =
      relativeError(solved, exact, model, [&](int v) { return !model.conditions().isFixed(v); });
  EXPECT_LT(error, 0.02);
}
INSTANTIATE_TEST_SUITE_P(Materials, ThickSphere, testing::Values(0.0, 0.3, 0.45, 0.499, 0.5));

}  // namespace
}  // namespace palpate::test
