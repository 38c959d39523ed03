// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_greens_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>

#include "contact/capacitance_solver.h"
#include "greens/elastic_foundation.h"
#include "greens/gravity.h"
#include "greens/rigid_motions.h"
#include "shell/shell_curvature.h"
#include "shell/shell_element.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

bool leftEdge(const Eigen::Vector3d& x) {
  return x.x() < -0.499;
}
bool frontAndBack(const Eigen::Vector3d& x) {
  return std::abs(x.y()) > 0.499;
}
bool cornersOfPlate(const Eigen::Vector3d& x) {
  return x.head<2>().cwiseAbs().minCoeff() > 0.499;
}

ShellOptions ofAllNodes(const ElasticModel& model) {
  ShellOptions options;
  for (int v = 0; v < model.mesh().vertexCount(); ++v) options.columns.push_back(v);
  options.reciprocal = false;
  return options;
}

Eigen::MatrixXd allOf(const ShellProblem& problem) {
  return denseMatrix(*problem.greens(ofAllNodes(problem.model)));
}

/// A square folded by a right angle along its middle.
Shape folded(int n) {
  return plate(1, n).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(std::min(x.x(), 0.), x.y(), std::max(x.x(), 0.));
  });
}

/// A saddle, curved both ways.
Shape saddle(int n) {
  return jitteredPlate(1, n, 0.3).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y(), 0.4 * x.x() * x.x() - 0.3 * x.y() * x.y());
  });
}

struct NamedShell {
  const char* name;
  ShellProblem problem;
};

std::vector<NamedShell> shells(double thickness) {
  const Place below = [](const Eigen::Vector3d& x) { return x.z() < -0.8; };
  return {{"plate", shellProblem(jitteredPlate(1, 6, 0.3), leftEdge, {thickness})},
          {"hinged plate", shellProblem(plate(1, 6), cornersOfPlate, {thickness}, false)},
          {"fold", shellProblem(folded(6), leftEdge, {thickness})},
          {"saddle", shellProblem(saddle(6), leftEdge, {thickness, 0.5})},
          {"ball", shellProblem(icosphere(2), below, {thickness, -0.5})},
          {"two pieces",
           shellProblem(plate(1, 4).with(plate(1, 4).moved({0, 0, 1})), leftEdge, {thickness})}};
}

TEST(ShellGreensFunctions, AreReciprocalWithoutBeingMadeSo) {
  for (const auto& [name, problem] : shells(0.01)) {
    ShellOptions options;
    options.reciprocal = false;
    const auto& info = problem.greens(options)->info();
    // Rounding: the solutions of one symmetric factorisation.
    EXPECT_LT(info.diagnostics.reciprocityDefect, 1e-12) << name;
    EXPECT_FALSE(info.reciprocal);
    EXPECT_TRUE(problem.greens()->info().reciprocal);
  }
}

TEST(ShellGreensFunctions, RigidMotionsOfTheSupportMoveAllRigidly) {
  for (const auto& [name, problem] : shells(0.01)) {
    const double defect = problem.greens()->info().diagnostics.rotationDefect;
    EXPECT_GE(defect, 0);
    EXPECT_LT(defect, 1e-9) << name;  // rounding times a condition number like (size / t)^2
  }
}

/// The same columns from the whole dense system.
Eigen::MatrixXd denseSolution(const ShellProblem& problem) {
  const SurfaceMesh& mesh = problem.mesh();
  const int n = mesh.vertexCount();
  const Eigen::VectorXd inclined = shell::inclinations(mesh);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh.points().col(mesh.triangles()(k, f));
    const shell::Matrix18d own =
        problem.model.material().youngsModulus() *
        shell::shellStiffness(corners, problem.shell.thickness().col(f),
                              problem.model.material().poissonRatio(), inclined[f]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        whole.block<6, 6>(6 * mesh.triangles()(i, f), 6 * mesh.triangles()(j, f)) +=
            own.block<6, 6>(6 * i, 6 * j);
  }
  Eigen::MatrixXd system = whole, right = Eigen::MatrixXd::Zero(6 * n, 3 * n);
  for (int v = 0; v < n; ++v) {
    const bool isFixed = problem.model.conditions().isFixed(v);
    for (int k = 0; k < 6; ++k) {
      const bool isHeld = problem.shell.held()(k, v);
      if (isHeld) system.row(6 * v + k) = Eigen::RowVectorXd::Unit(6 * n, 6 * v + k);
      if (k < 3 && (isFixed || !isHeld))
        right(6 * v + k, 3 * v + k) = isFixed ? 1 : mesh.vertexAreas()[v];
    }
  }
  const Eigen::MatrixXd solution = system.partialPivLu().solve(right), forces = whole * solution;
  Eigen::MatrixXd columns(3 * n, 3 * n);
  for (int v = 0; v < n; ++v)
    if (problem.model.conditions().isFixed(v))
      columns.middleRows<3>(3 * v) = forces.middleRows<3>(6 * v) / mesh.vertexAreas()[v];
    else
      columns.middleRows<3>(3 * v) = solution.middleRows<3>(6 * v);
  return columns;
}

TEST(ShellGreensFunctions, AreTheSolutionsOfTheWholeDenseSystem) {
  const auto symmetric = heldShell(saddle(4),
                                   [](const Eigen::Vector3d& x) {
                                     return (leftEdge(x) ? kUx | kUy | kUz | kTurnY : 0) |
                                            (x.x() > 0.499 ? kMirrorX : 0);
                                   },
                                   {0.05, 0.3, 7});
  for (const ShellProblem& problem :
       {shellProblem(saddle(4), leftEdge, {0.05, 0.3, 7}),
        shellProblem(folded(4), frontAndBack, {0.05, -0.4, 0.2}, false), symmetric}) {
    const Eigen::MatrixXd exact = denseSolution(problem), found = allOf(problem);
    for (Eigen::Index c = 0; c < exact.cols(); ++c)
      EXPECT_LT((found.col(c) - exact.col(c)).norm(), 1e-9 * exact.col(c).norm() + 1e-300)
          << "column " << c;
  }
}

TEST(ShellGreensFunctions, ReactionsOfAHingedShellBalanceForceAndTorque) {
  const ShellProblem problem = shellProblem(
      saddle(6), [](const Eigen::Vector3d& x) { return x.x() > 0.499 || leftEdge(x); }, {0.02},
      false);
  const Eigen::MatrixXd columns = allOf(problem);
  const Eigen::VectorXd& areas = problem.mesh().vertexAreas();
  for (int v : problem.model.conditions().freeNodes())
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d force = areas[v] * Eigen::Vector3d::Unit(k);
      Eigen::Vector3d torque = Eigen::Vector3d(problem.mesh().points().col(v)).cross(force);
      for (int s : problem.model.conditions().fixedNodes()) {
        const Eigen::Vector3d reaction = areas[s] * columns.block<3, 1>(3 * s, 3 * v + k);
        force += reaction;
        torque += Eigen::Vector3d(problem.mesh().points().col(s)).cross(reaction);
      }
      EXPECT_LT(force.norm(), 1e-9 * areas[v]);
      EXPECT_LT(torque.norm(), 1e-9 * areas[v]);
    }
}

TEST(ShellGreensFunctions, WhatASupportsMotionDoesGoesByItsReactions) {
  // Betti: a_v u_v of a unit displacement at s is - a_s times the reaction there to a traction at
  // v.
  const ShellProblem problem = shellProblem(saddle(5), leftEdge, {0.03});
  const Eigen::MatrixXd columns = allOf(problem);
  const Eigen::VectorXd& areas = problem.mesh().vertexAreas();
  for (int v : problem.model.conditions().freeNodes())
    for (int s : problem.model.conditions().fixedNodes()) {
      const Eigen::Matrix3d moved = areas[v] * columns.block<3, 3>(3 * v, 3 * s),
                            borne = areas[s] * columns.block<3, 3>(3 * s, 3 * v);
      EXPECT_LT((moved + borne.transpose()).norm(), 1e-9 * areas[v]);
    }
}

TEST(ShellGreensFunctions, AreTheSameInAnyPositionAndUnit) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Shape shape = saddle(5);
  const Eigen::MatrixXd unit = allOf(shellProblem(shape, leftEdge, {0.02}));
  const auto types = fixedWhere(shape, leftEdge);
  for (double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    const Shape moved = shape.mapped([&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
      return scale * (turn * x + Eigen::Vector3d(3, 4, -5));
    });
    int next = 0;  // places are asked for in the order of vertices
    const ShellProblem there =
        shellProblem(moved, [&](const Eigen::Vector3d&) { return types[next++] != 0; },
                     {0.02 * scale, 0.3, 1e6});
    const Eigen::MatrixXd found = allOf(there);
    for (int i : {10, 20, 33})
      for (int j : {9, 22, 35}) {
        const Eigen::Matrix3d expected =
            scale * 1e-6 * turn * unit.block<3, 3>(3 * i, 3 * j) * turn.transpose();
        EXPECT_LT((found.block<3, 3>(3 * i, 3 * j) - expected).norm(),
                  1e-8 * scale * 1e-6 * unit.norm());
      }
  }
}

TEST(ShellGreensFunctions, OfAPlateGoByTheThicknessWithinItAndItsCubeAcross) {
  const auto columns = [](double thickness) {
    return allOf(shellProblem(plate(1, 4), leftEdge, {thickness}));
  };
  const Eigen::MatrixXd thin = columns(0.01), thick = columns(0.02);
  const int v = 24;  // a corner away from the support
  EXPECT_NEAR(thin(3 * v + 2, 3 * v + 2) / thick(3 * v + 2, 3 * v + 2), 8, 1e-9);
  EXPECT_NEAR(thin(3 * v, 3 * v) / thick(3 * v, 3 * v), 2, 1e-9);
  EXPECT_EQ(thin(3 * v, 3 * v + 2), 0);  // neither pulls at the other
}

TEST(ShellGreensFunctions, AreThoseOfTheThicknessWhereItVaries) {
  // A tapered cantilever, t = t0 (1 - x / 2), nu = 0, force at its end:
  // w = F / (E I0) integral of (1 - x)^2 / (1 - x / 2)^3 dx = (8 ln 2 - 5) F / (E I0).
  const double width = 0.1, t0 = 0.01;
  const Shape strip =
      sheetOf(40, 4, [&](double a, double b) { return Eigen::Vector3d(a, width * b, 0); });
  const ElasticModel model =
      shellModel(strip, [](const Eigen::Vector3d& x) { return x.x() < 1e-9; }, {t0, 0});
  Eigen::VectorXd thickness(strip.points.cols());
  for (Eigen::Index v = 0; v < thickness.size(); ++v)
    thickness[v] = t0 * (1 - strip.points(0, v) / 2);
  const ShellProblem problem{model,
                             ThinShell(model, thicknessOfVertices(model.mesh(), thickness), true)};
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, thickness.size());
  double tip = 0;
  for (int v = 0; v < thickness.size(); ++v)
    if (strip.points(0, v) > 0.999) forces(2, v) = 0.2;
  const Eigen::Matrix3Xd moved = displacementUnder(problem, forces);
  for (int v = 0; v < thickness.size(); ++v) tip += moved(2, v) * forces(2, v);
  // Forty squares along, each of one mean stiffness: a defect of (1 / 40)^2 and what ends cost.
  EXPECT_NEAR(tip * width * std::pow(t0, 3) / 12 / (8 * std::log(2.) - 5), 1, 0.004);
}

TEST(ShellGreensFunctions, SayWhatTheyAre) {
  const auto greens = shellProblem(plate(1, 4), leftEdge, {0.01}).greens();
  EXPECT_EQ(greens->info().source,
            "thin shell (DKT and OPT triangles, 32 of them, thickness 0.01, "
            "clamped)");
  EXPECT_EQ(greens->info().domain, Domain::Shell);
  EXPECT_TRUE(greens->info().rotationsHeld);
  EXPECT_FALSE(
      shellProblem(plate(1, 4), cornersOfPlate, {0.01}, false).greens()->info().rotationsHeld);
}

TEST(ShellGreensFunctions, OfColumnsThatWereAskedForAlone) {
  const ShellProblem problem = shellProblem(plate(1, 4), leftEdge);
  ShellOptions options;
  options.columns = {7, 3, 7};
  const auto greens = problem.greens(options);
  EXPECT_EQ(greens->info().columnNodes, (std::vector<int>{3, 7}));
  const Eigen::MatrixXd all = allOf(problem);
  Eigen::Matrix3d block;
  greens->gather(Eigen::VectorXi::Constant(1, 12), Eigen::VectorXi::Constant(1, 7), block.data());
  EXPECT_LT((block - all.block<3, 3>(36, 21)).norm(), 1e-12 * block.norm());
  options.columns = {25};
  EXPECT_TRUE(isRefused([&] { problem.greens(options); }, "there is no node 25"));
}

TEST(ShellGreensFunctions, CanBeAbortedAndReportProgress) {
  const ShellProblem problem = shellProblem(plate(1, 8), leftEdge);
  double last = 0;
  computeShellGreensFunctions(problem.model, problem.shell, {}, [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_THROW(
      computeShellGreensFunctions(problem.model, problem.shell, {},
                                  [](double fraction, const char*) { return fraction < 0.5; }),
      Aborted);
}

TEST(ShellGreensFunctions, OfAClampedEdgeLetOneOfItsVerticesGo) {
  // All fixed vertices are on one line, which hinged would turn.
  const ShellProblem problem = shellProblem(plate(1, 4), leftEdge, {0.05});
  const auto greens = problem.greens(ofAllNodes(problem.model));
  CapacitanceSolver solver(greens, problem.model.sharedMesh());
  std::vector<unsigned char> types = problem.model.conditions().types();
  types[0] = 0;
  const ElasticModel released(problem.model.sharedMesh(), problem.model.material(),
                              BoundaryConditions(types), problem.model.smoothPatches(),
                              Domain::Shell);
  HeldComponents held = problem.shell.held();
  held.col(0).head<3>() = false;
  const ShellProblem anew{released, ThinShell(released, problem.shell.thickness(), held)};
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, 25);
  forces.col(0) << 0, 0, 1;
  forces.col(24) << 1, 0, 2;
  const Eigen::Matrix3Xd expected = displacementUnder(anew, forces);
  BoundaryValues values = switchWholeNodes(
      {0}, forces.col(0) / problem.mesh().vertexAreas()[0]);  // its traction instead
  values.given = Eigen::Matrix3Xd::Zero(3, 25);
  values.given.col(24) = forces.col(24) / problem.mesh().vertexAreas()[24];
  const BoundarySolution solution = solver.solve(values);
  EXPECT_LT((solution.displacement - expected).norm(), 1e-8 * expected.norm());
}

/// Loads that balance each other, and any.
Eigen::MatrixXd someLoads(const ElasticModel& model, bool isBalanced) {
  const SurfaceMesh& mesh = model.mesh();
  Eigen::MatrixXd tractions = Eigen::MatrixXd::Zero(3 * mesh.vertexCount(), 2);
  for (int v = 0; v < mesh.vertexCount(); ++v)
    for (int k = 0; k < 3; ++k)
      for (int load = 0; load < 2; ++load)
        tractions(3 * v + k, load) = std::sin(1.7 * v + 2.3 * k + load);
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(mesh);
  if (isBalanced)
    tractions -= motions * (meanRigidMotion(mesh.vertexAreas(), motions) * tractions).eval();
  return tractions;
}

TEST(FreeShell, DeformsAsOneThatIsHeldAnywhereUnderLoadsThatBalance) {
  const Shape shape = saddle(5);
  const ElasticModel loose = shellModel(shape, [](const auto&) { return false; });
  const ShellProblem held = shellProblem(shape, [&](const Eigen::Vector3d& x) {
    return x == shape.points.col(7);  // clamped there
  });
  const Eigen::Matrix3Xd thickness = thicknessOfVertices(
      loose.mesh(), Eigen::VectorXd::Constant(loose.mesh().vertexCount(), 0.01));
  const auto greens = computeFreeShellGreensFunctions(loose, thickness).take();
  EXPECT_TRUE(greens->info().conditions.fixedNodes().empty());
  EXPECT_LT(greens->info().diagnostics.reciprocityDefect, 1e-8);
  const Eigen::VectorXd& areas = loose.mesh().vertexAreas();
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(loose.mesh()),
                        loads = someLoads(loose, true);
  Eigen::MatrixXd expected = allOf(held);
  for (int k = 0; k < 3; ++k) expected.row(3 * 7 + k).setZero();  // reactions
  Eigen::MatrixXd driven = loads;
  driven.middleRows<3>(3 * 7).setZero();  // forces there are borne by the clamp
  expected = (expected * driven).eval();
  expected -= motions * (meanRigidMotion(areas, motions) * expected).eval();
  const Eigen::MatrixXd xi = denseMatrix(*greens), found = xi * loads;
  EXPECT_LT((found - expected).norm(), 1e-7 * expected.norm());
  EXPECT_LT((xi * motions).norm(), 1e-8 * found.norm());  // rigid loads do nothing
  EXPECT_LT((xi * someLoads(loose, false) - found).norm(), 1e-8 * found.norm());
}

TEST(FreeShell, OnSpringsBearsItsWeight) {
  const Shape shape = saddle(5);
  const ElasticModel loose = shellModel(shape, [](const auto&) { return false; });
  const SurfaceMesh& mesh = loose.mesh();
  const Eigen::Matrix3Xd thickness =
      thicknessOfVertices(mesh, Eigen::VectorXd::Constant(mesh.vertexCount(), 0.01));
  const auto greens = computeFreeShellGreensFunctions(loose, thickness).take();
  Eigen::Matrix3Xd springs = Eigen::Matrix3Xd::Zero(3, 3 * mesh.vertexCount());
  for (int v : {0, 3, 20, 35}) springs.middleCols<3>(3 * v).diagonal().setConstant(1e-4);
  const auto founded = onElasticFoundation(*greens, loose, springs).greens.take();
  const Eigen::Vector3d weight(0.1, 0.2, -1);
  const Eigen::Matrix3Xd sunk = gravityDisplacement(*founded, mesh, loose.smoothPatches(), weight);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force, load = force, turn = force;
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d at = springs.middleCols<3>(3 * v) * sunk.col(v),
                          own = 0.01 * mesh.vertexAreas()[v] * weight;
    force += at;
    load += own;
    moment += mesh.points().col(v).cross(at);
    turn += mesh.points().col(v).cross(own);
  }
  EXPECT_LT((force - load).norm(), 1e-8 * load.norm());
  EXPECT_LT((moment - turn).norm(), 1e-8 * load.norm());
  EXPECT_TRUE(isRefused([&] { gravityDisplacement(*greens, mesh, loose.smoothPatches(), weight); },
                        "falls freely"));
}

TEST(FreeShell, IsRefusedWhatItCannotHave) {
  const Shape shape = saddle(3);
  const ElasticModel loose = shellModel(shape, [](const auto&) { return false; });
  const Eigen::Matrix3Xd thickness = thicknessOfVertices(
      loose.mesh(), Eigen::VectorXd::Constant(loose.mesh().vertexCount(), 0.01));
  const auto refused = [&](const ShellOptions& options, const char* sentence) {
    return isRefused([&] { computeFreeShellGreensFunctions(loose, thickness, options); }, sentence);
  };
  EXPECT_TRUE(refused({{1, 2}, true, false}, "leave the columns out"));
  EXPECT_TRUE(refused({{}, true, true}, "leave the estimate out"));
  const ElasticModel held = shellModel(shape, leftEdge);
  EXPECT_TRUE(isRefused([&] { computeFreeShellGreensFunctions(held, thickness); },
                        "leave all vertices free"));
}

}  // namespace
}  // namespace palpate::test
