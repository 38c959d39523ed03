// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/capacitance_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>

#include "support/contact_bodies.h"
#include "support/fresh_solve.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

// What the capacitance matrix algorithm must keep to against a fresh solve. The systems' condition
// numbers are about 1e3, so rounding alone is a thousandth of it.
constexpr double kFresh = 1e-10;

/// Compares whole-node switches, with random values at all nodes whether switched or not, with the
/// fresh solve.
void expectFresh(const Shape& shape, const TouchedBody& body, CapacitanceSolver& solver,
                 const std::vector<int>& nodes, std::mt19937& random) {
  const Eigen::Matrix3Xd given = randomVectors(body.mesh->vertexCount(), random);
  const Eigen::Matrix3Xd prescribed = randomVectors(static_cast<int>(nodes.size()), random);
  BoundaryValues values = switchWholeNodes(nodes, prescribed);
  values.given = given;
  const BoundarySolution solution = solver.solve(values);
  Eigen::Matrix3Xd exchangedGiven = given;
  for (std::size_t i = 0; i < nodes.size(); ++i) exchangedGiven.col(nodes[i]) = prescribed.col(i);
  const Nodal fresh = solveAfresh(shape, *body.greens, nodes, exchangedGiven);
  EXPECT_LE(relativeDifference(solution.displacement, fresh.displacement), kFresh);
  EXPECT_LE(relativeDifference(solution.traction, fresh.traction), kFresh);
  for (std::size_t i = 0; i < nodes.size(); ++i) {  // whole nodes: the unknown vector itself
    const Eigen::Matrix3Xd& unknown =
        body.greens->isFixed(nodes[i]) ? fresh.displacement : fresh.traction;
    EXPECT_LE((solution.switchedValues.segment<3>(3 * i) - unknown.col(nodes[i])).norm(),
              kFresh * unknown.norm());
  }
}

class CapacitanceSolverOfASphere : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shape_ = new Shape(jitteredSphere(1, 0.2));
    body_ = new TouchedBody(touchedSphere(1, false));
  }
  static void TearDownTestSuite() {
    delete shape_;
    delete body_;
  }

  int nodeCount() const { return body_->mesh->vertexCount(); }

  /// Values to prescribe, random at every node whether switched or not.
  Eigen::Matrix3Xd randomValues() { return randomVectors(nodeCount(), random_); }

  void expectFresh(CapacitanceSolver& solver, const std::vector<int>& nodes) {
    palpate::test::expectFresh(*shape_, *body_, solver, nodes, random_);
  }

  static Shape* shape_;
  static TouchedBody* body_;
  std::mt19937 random_{11};
};
Shape* CapacitanceSolverOfASphere::shape_ = nullptr;
TouchedBody* CapacitanceSolverOfASphere::body_ = nullptr;

TEST_F(CapacitanceSolverOfASphere, AnySetOfNodesGivesWhatAFreshSolveOfTheExchangedSystemGives) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  for (int count : {1, 2, 3, 6, 11, 20, 29, 35, nodeCount() - 1, nodeCount()}) {
    SCOPED_TRACE(count);
    expectFresh(solver, randomSubset(nodeCount(), count, random_));
  }
}

TEST_F(CapacitanceSolverOfASphere, ReleasesDownToThreeNodesGiveWhatAFreshSolveGives) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  const std::vector<int> fixed = body_->greens->info().conditions.fixedNodes();
  ASSERT_GE(fixed.size(), 6u);
  for (std::size_t left = fixed.size() - 1; left >= 3; --left) {
    SCOPED_TRACE(left);
    expectFresh(solver, {fixed.begin() + left, fixed.end()});
  }
}

TEST_F(CapacitanceSolverOfASphere, ContactsMayHoldABodyWhoseWholeSupportIsReleased) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  std::vector<int> nodes = body_->greens->info().conditions.fixedNodes();
  const std::vector<int> free = body_->greens->info().conditions.freeNodes();
  for (std::size_t i : {std::size_t(0), free.size() / 2, free.size() - 1}) nodes.push_back(free[i]);
  expectFresh(solver, nodes);
}

TEST(CapacitanceSolver, AnExteriorDomainMayLoseItsWholeSupport) {
  const Shape shape = jitteredSphere(1, 0.2);
  const TouchedBody body =
      touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() < -0.6; }), false,
                  Domain::Exterior);
  CapacitanceSolver solver(body.greens, body.mesh);
  std::mt19937 random(12);
  expectFresh(shape, body, solver, body.greens->info().conditions.fixedNodes(), random);
}

TEST_F(CapacitanceSolverOfASphere, MixedDirectionsSolveTheBoundaryIntegralEquations) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  for (int count : {1, 4, 12, 30, 42}) {
    SCOPED_TRACE(count);
    BoundaryValues values;
    values.switches = flat(randomSwitches(randomSubset(nodeCount(), count, random_), random_));
    values.prescribed =
        randomVectors(static_cast<int>(values.switches.size()), random_).row(0).transpose();
    values.given = randomValues();
    const BoundarySolution solution = solver.solve(values);
    // What was switched is as prescribed,
    for (std::size_t k = 0; k < values.switches.size(); ++k) {
      const int node = values.switches[k].node;
      const Eigen::Vector3d direction = values.switches[k].direction;
      const bool released = body_->greens->isFixed(node);
      const Eigen::Matrix3Xd& nowGiven = released ? solution.traction : solution.displacement;
      EXPECT_NEAR(direction.dot(nowGiven.col(node)), values.prescribed[k],
                  kFresh * nowGiven.norm());
    }
    // what they do not touch is as given, and along them is what they made unknown,
    for (int node = 0; node < nodeCount(); ++node) {
      Eigen::Matrix3Xd switched(3, 0);
      Eigen::Vector3d added = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < values.switches.size(); ++k) {
        if (values.switches[k].node != node) continue;
        switched.conservativeResize(3, switched.cols() + 1);
        switched.rightCols<1>() = values.switches[k].direction;
        added += solution.switchedValues[k] * values.switches[k].direction;
      }
      const Eigen::Vector3d after =
          (body_->greens->isFixed(node) ? solution.displacement : solution.traction).col(node);
      const Eigen::Vector3d before = values.given.col(node);
      Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
      if (switched.cols() > 0)
        across -= switched * switched.completeOrthogonalDecomposition().pseudoInverse();
      EXPECT_LE((after - across * before - added).norm(), kFresh * (1 + after.norm()));
    }
    // and all of it solves another boundary value problem of the same body.
    const std::vector<int> exchanged = randomSubset(nodeCount(), 15, random_);
    Eigen::Matrix3Xd given = solution.traction;
    std::vector<unsigned char> types = body_->greens->info().conditions.types();
    for (int node : exchanged) types[node] = !types[node];
    for (int node = 0; node < nodeCount(); ++node)
      if (types[node]) given.col(node) = solution.displacement.col(node);
    const Nodal fresh = solveAfresh(*shape_, *body_->greens, exchanged, given);
    EXPECT_LE(relativeDifference(solution.displacement, fresh.displacement), kFresh);
    EXPECT_LE(relativeDifference(solution.traction, fresh.traction), kFresh);
  }
}

TEST_F(CapacitanceSolverOfASphere, SelectedRowsAreThoseOfTheFullSolution) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  BoundaryValues values = switchWholeNodes({5, 9, 30}, randomVectors(3, random_));
  values.given = randomValues();
  const BoundarySolution solution = solver.solve(values);
  const std::vector<int> rows = {9, 0, 41, 0, 17};
  const Eigen::Matrix3Xd selected = solver.solveAt(values, rows);
  ASSERT_EQ(selected.cols(), 5);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool fixed = body_->greens->isFixed(rows[i]);
    // Another order of the same sums.
    const Eigen::Vector3d full = (fixed ? solution.traction : solution.displacement).col(rows[i]);
    EXPECT_LE((selected.col(i) - full).norm(), 1e-13 * (1 + full.norm()));
  }
  EXPECT_EQ(solver.solveAt(values, {}).cols(), 0);
}

TEST_F(CapacitanceSolverOfASphere, TheOrderOfTheConstraintsDoesNotMatter) {
  BoundaryValues values;
  values.switches = flat(randomSwitches(randomSubset(nodeCount(), 20, random_), random_));
  const int count = static_cast<int>(values.switches.size());
  values.prescribed = randomVectors(count, random_).row(0).transpose();
  values.given = randomValues();
  const BoundarySolution solution = CapacitanceSolver(body_->greens, body_->mesh).solve(values);
  CapacitanceSolver solver(body_->greens, body_->mesh);
  for (int trial = 0; trial < 5; ++trial) {  // from the second on out of the cache
    BoundaryValues shuffled = values;
    const std::vector<int> order = randomSubset(count, count, random_);
    for (int k = 0; k < count; ++k) {
      shuffled.switches[k] = values.switches[order[k]];
      shuffled.prescribed[k] = values.prescribed[order[k]];
    }
    const BoundarySolution again = solver.solve(shuffled);
    // The same sums in the same order but for the right-hand side.
    EXPECT_LE(relativeDifference(again.displacement, solution.displacement), 1e-13);
    EXPECT_LE(relativeDifference(again.traction, solution.traction), 1e-13);
    for (int k = 0; k < count; ++k)
      EXPECT_NEAR(again.switchedValues[k], solution.switchedValues[order[k]],
                  1e-13 * solution.switchedValues.norm());
  }
  EXPECT_EQ(solver.cachedCount(), 1);
}

/// Springs' forces are those of their own stretch, and all else is the body's own equations.
TEST_F(CapacitanceSolverOfASphere, SpringsBearWhatTheirStretchAsksFor) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  const GreensFunctions& greens = *body_->greens;
  const std::vector<int> free = greens.info().conditions.freeNodes(),
                         fixed = greens.info().conditions.fixedNodes();
  const int pressed = free[3], released = fixed[1];
  const Eigen::Vector3d along = Eigen::Vector3d(1, -2, 2) / 3;
  for (double stiffness : {1e-4, 1.0, 1e4}) {
    const double pressedArea = greens.vertexArea(pressed), area = greens.vertexArea(released);
    BoundaryValues values;
    values.switches = {{pressed, along, pressedArea / stiffness}};
    for (int k = 0; k < 3; ++k)
      values.switches.push_back({released, Eigen::Vector3d::Unit(k), stiffness / area});
    values.prescribed = Eigen::Vector4d(0.3, 0.02, -0.01, 0.04);
    values.given = randomValues();
    const BoundarySolution found = solver.solve(values);
    const double stretch = 0.3 - along.dot(found.displacement.col(pressed));
    const Eigen::Vector3d across = found.traction.col(pressed) - values.given.col(pressed);
    EXPECT_NEAR(pressedArea * along.dot(found.traction.col(pressed)), stiffness * stretch,
                1e-9 * (1 + stiffness * std::abs(stretch)));
    EXPECT_LE((across - along.dot(across) * along).norm(), 1e-12);
    EXPECT_LE((area * found.traction.col(released) -
               (area * values.prescribed.tail<3>() - stiffness * found.displacement.col(released)))
                  .norm(),
              1e-9 * (1 + stiffness));
    // The reference problem with what came out as given gives the same.
    Eigen::Matrix3Xd all = values.given;
    all.col(pressed) = found.traction.col(pressed);
    all.col(released) = found.displacement.col(released);
    const Eigen::Matrix3Xd again = solveReferenceProblem(greens, all);
    EXPECT_LE((again.col(pressed) - found.displacement.col(pressed)).norm(), 1e-9);
    EXPECT_LE((again.col(released) - found.traction.col(released)).norm(),
              1e-9 * (1 + found.traction.col(released).norm()));
  }
}

TEST_F(CapacitanceSolverOfASphere, ABodyOnSpringsAloneIsHeldByThem) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  const GreensFunctions& greens = *body_->greens;
  BoundaryValues values =
      switchWholeNodes(greens.info().conditions.fixedNodes(),
                       Eigen::Matrix3Xd::Zero(3, greens.info().conditions.fixedNodes().size()));
  for (ConstraintSwitch& s : values.switches) s.yield = 1e-6;  // Pa/m: far softer than the body
  values.given = Eigen::Matrix3Xd::Zero(3, nodeCount());
  const int top = greens.info().conditions.freeNodes()[0];
  values.given.col(top).z() = 1;
  const BoundarySolution found = solver.solve(values);
  double held = 0;
  for (int v : greens.info().conditions.fixedNodes())
    held += greens.vertexArea(v) * found.traction(2, v);
  EXPECT_NEAR(held, -greens.vertexArea(top), 1e-3 * greens.vertexArea(top));  // condition 1e6
  for (ConstraintSwitch& s : values.switches) s.yield = -1;
  EXPECT_TRUE(isRefused([&] { solver.solve(values); }, "must yield by a number from 0 on"));
}

TEST_F(CapacitanceSolverOfASphere, NoSwitchIsTheReferenceProblemItself) {
  BoundaryValues values;
  values.given = randomValues();
  const BoundarySolution solution = CapacitanceSolver(body_->greens, body_->mesh).solve(values);
  const Eigen::Matrix3Xd response = solveReferenceProblem(*body_->greens, values.given);
  for (int node = 0; node < nodeCount(); ++node) {
    const bool fixed = body_->greens->isFixed(node);
    EXPECT_LE(
        ((fixed ? solution.traction : solution.displacement).col(node) - response.col(node)).norm(),
        1e-13 * response.norm());
    EXPECT_EQ((fixed ? solution.displacement : solution.traction).col(node),
              values.given.col(node));
  }
  EXPECT_EQ(solution.condition, 1);
}

TEST_F(CapacitanceSolverOfASphere, ReleasesThatLeaveAMotionFreeAreRefusedAndTheSolverGoesOn) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  const std::vector<int> fixed = body_->greens->info().conditions.fixedNodes();
  const auto release = [&](std::size_t left) {
    const std::vector<int> nodes(fixed.begin() + left, fixed.end());
    return [&solver, nodes] {
      solver.solve(switchWholeNodes(nodes, Eigen::Matrix3Xd::Zero(3, nodes.size())));
    };
  };
  const std::string sentence = "releasing these nodes would leave a rigid motion free (";
  for (std::size_t left : {2, 1}) {
    EXPECT_TRUE(isRefused(release(left), sentence + "rotation about the axis ("));
    EXPECT_EQ(solver.cachedCount(), 0);
  }
  EXPECT_TRUE(isRefused(release(0), sentence));
  expectFresh(solver, {fixed.begin() + 3, fixed.end()});
}

TEST_F(CapacitanceSolverOfASphere, FrictionlessContactsCannotHoldASphereThatLostItsSupport) {
  // On an exact sphere: all forces along its normals pass through the centre.
  const Shape shape = icosphere(1);
  const TouchedBody body =
      touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() < -0.6; }), false);
  CapacitanceSolver solver(body.greens, body.mesh);
  BoundaryValues values = switchWholeNodes(
      body.greens->info().conditions.fixedNodes(),
      Eigen::Matrix3Xd::Zero(3, body.greens->info().conditions.fixedNodes().size()));
  for (int node : body.greens->info().conditions.freeNodes())
    values.switches.push_back({node, body.mesh->points().col(node).normalized()});
  values.prescribed = Eigen::VectorXd::Zero(values.switches.size());
  EXPECT_TRUE(isRefused([&] { solver.solve(values); },
                        "would leave a rigid motion free (rotation about the axis ("));
}

TEST(CapacitanceSolver, EveryBodyMustKeepItsOwnSupport) {
  const Shape two = icosphere(1).with(icosphere(1).moved({3, 0, 0}));
  const TouchedBody body =
      touchedBody(two, fixedWhere(two, [](const auto& x) { return x.z() < -0.6; }), false);
  CapacitanceSolver solver(body.greens, body.mesh);
  std::vector<int> nodes;
  for (int node : body.greens->info().conditions.fixedNodes())
    if (body.mesh->bodyOfVertex(node) == 1) nodes.push_back(node);
  const auto values = switchWholeNodes(nodes, Eigen::Matrix3Xd::Zero(3, nodes.size()));
  EXPECT_TRUE(isRefused([&] { solver.solve(values); }, ") of the body of vertex 42"));
}

TEST_F(CapacitanceSolverOfASphere, TheCacheIsBoundedAndKeepsWhatWasUsedLast) {
  CapacitanceSolver solver(body_->greens, body_->mesh, 3);
  const auto first = solver.matrixFor(switchesOfNodes({5}));
  for (int node = 6; node < 16; ++node) {
    solver.matrixFor(switchesOfNodes({node}));
    EXPECT_EQ(solver.matrixFor(switchesOfNodes({5})), first) << "used in between, so kept";
    EXPECT_LE(solver.cachedCount(), 3);
  }
  EXPECT_EQ(solver.cachedCount(), 3);
  const auto another = solver.matrixFor(switchesOfNodes({6}));
  EXPECT_EQ(solver.matrixFor(switchesOfNodes({6})), another);
  for (int node = 16; node < 19; ++node) solver.matrixFor(switchesOfNodes({node}));
  EXPECT_NE(solver.matrixFor(switchesOfNodes({5})), first) << "the oldest had to go";
  EXPECT_EQ(CapacitanceSolver(body_->greens, body_->mesh, 0).cachedCount(), 0);
}

TEST_F(CapacitanceSolverOfASphere, WhatMakesNoSenseIsRefusedWithASentence) {
  CapacitanceSolver solver(body_->greens, body_->mesh);
  const auto refuses = [&](const BoundaryValues& values, const std::string& sentence) {
    return isRefused([&] { solver.solve(values); }, sentence);
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_TRUE(isRefused([&] { switchWholeNodes({1}, Eigen::Matrix3Xd::Zero(3, 2)); },
                        "there are 2 prescribed vectors for 1 nodes"));
  BoundaryValues values = switchWholeNodes({7}, Eigen::Matrix3Xd::Zero(3, 1));
  values.prescribed.conservativeResize(2);
  EXPECT_TRUE(refuses(values, "there are 2 prescribed values for 3 switched constraints"));
  values = switchWholeNodes({7}, Eigen::Matrix3Xd::Zero(3, 1));
  values.given = Eigen::Matrix3Xd::Zero(3, 5);
  EXPECT_TRUE(refuses(values, "there are 5 given values for 42 nodes"));
  values.given = Eigen::Matrix3Xd::Constant(3, 42, std::nan(""));
  EXPECT_TRUE(refuses(values, "a prescribed value is not a finite number"));
  values = switchWholeNodes({7}, Eigen::Matrix3Xd::Constant(3, 1, INFINITY));
  EXPECT_TRUE(refuses(values, "a prescribed value is not a finite number"));
  for (int node : {-1, 42})
    EXPECT_TRUE(refuses(switchWholeNodes({node}, Eigen::Matrix3Xd::Zero(3, 1)),
                        "there is no node " + std::to_string(node) + ": the model has 42 nodes"));
  EXPECT_TRUE(refuses(switchWholeNodes({7, 7}, Eigen::Matrix3Xd::Zero(3, 2)),
                      "node 7 is constrained twice along the same direction"));
  const auto along = [](std::vector<ConstraintSwitch> switches) {
    BoundaryValues out;
    out.switches = std::move(switches);
    out.prescribed = Eigen::VectorXd::Zero(out.switches.size());
    return out;
  };
  EXPECT_TRUE(
      refuses(along({{7, x}, {7, x}}), "node 7 is constrained twice along the same direction"));
  EXPECT_TRUE(refuses(along({{7, x / 2}}), "(0.5, 0, 0) of a constraint at node 7 is not a unit"));
  EXPECT_TRUE(isRefused<std::runtime_error>(
      [&] {
        solver.solve(along({{7, x}, {7, -x}}));
      },
      "those of node 7 depend on each other"));
  EXPECT_TRUE(isRefused(
      [&] {
        solver.solveAt(along({}), {0, 42});
      },
      "there is no node 42 to evaluate"));
  EXPECT_TRUE(isRefused([&] { CapacitanceSolver(body_->greens, icosphere(0).mesh()); },
                        "the Green's functions have 42 nodes, the surface 12 vertices"));
  EXPECT_EQ(solver.cachedCount(), 0) << "nothing refused was kept";
}

TEST_F(CapacitanceSolverOfASphere, AValueWhoseColumnWasNotComputedIsRefused) {
  GreensFunctionsInfo info = body_->greens->info();
  const Eigen::MatrixXd xi = denseMatrix(*body_->greens);
  info.columnNodes = info.conditions.freeNodes();
  const int fixed = info.conditions.fixedNodes().front();
  CapacitanceSolver solver(denseGreens(info, xi), body_->mesh);
  BoundaryValues values;
  values.given = Eigen::Matrix3Xd::Zero(3, nodeCount());
  EXPECT_NO_THROW(solver.solve(values));
  values.given(0, fixed) = 1;
  EXPECT_TRUE(
      isRefused([&] { solver.solve(values); },
                "the Green's functions of node " + std::to_string(fixed) + " were not computed"));
}

TEST_F(CapacitanceSolverOfASphere, AWrenchIsTheSumOfForcesAndOfTheirMoments) {
  const Eigen::Matrix3Xd traction = randomValues();
  const Eigen::Vector3d centre(0.3, -2, 1);
  const Wrench one = wrenchOf(*body_->greens, body_->mesh->points(), {4}, traction, centre);
  const Eigen::Vector3d force = body_->mesh->vertexAreas()[4] * traction.col(4);
  EXPECT_LE((one.force - force).norm(), 1e-15);
  EXPECT_LE((one.torque - (body_->mesh->points().col(4) - centre).cross(force)).norm(), 1e-15);
  // Moving the centre adds the moment of the whole force; rounding of 42 terms.
  std::vector<int> all = randomSubset(nodeCount(), nodeCount(), random_);
  const Wrench here = wrenchOf(*body_->greens, body_->mesh->points(), all, traction, centre);
  const Wrench there =
      wrenchOf(*body_->greens, body_->mesh->points(), all, traction, Eigen::Vector3d::Zero());
  EXPECT_LE((here.force - there.force).norm(), 1e-14);
  EXPECT_LE((there.torque - here.torque - centre.cross(here.force)).norm(), 1e-14);
  EXPECT_GT(here.force.norm(), 1e-3);
}

}  // namespace
}  // namespace palpate::test
