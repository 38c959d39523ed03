// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Supports that hold a body just so, or not at all.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "contact/capacitance_solver.h"
#include "model/support.h"
#include "stability/hard_case.h"
#include "support/fresh_solve.h"
#include "support/problems.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"supports", name, danger};
}

// The capacitance matrix algorithm against a fresh solve: systems of condition 1e3, whose rounding
// alone is a thousandth of it.
constexpr double kFresh = 1e-10;

/// Exchanges whole nodes, all values random, and compares with the exchanged system solved afresh.
double differenceToFresh(CapacitanceSolver& solver, const Shape& shape, const TouchedBody& body,
                         const std::vector<int>& nodes) {
  std::mt19937 random(21);
  const int count = static_cast<int>(nodes.size());
  BoundaryValues values = switchWholeNodes(nodes, randomVectors(count, random));
  values.given = randomVectors(body.mesh->vertexCount(), random);
  const BoundarySolution solution = solver.solve(values);
  Eigen::Matrix3Xd given = values.given;
  given(Eigen::all, nodes) = values.prescribed.reshaped(3, count);
  const Nodal fresh = solveAfresh(shape, *body.greens, nodes, given);
  return std::max(relativeDifference(solution.displacement, fresh.displacement),
                  relativeDifference(solution.traction, fresh.traction));
}

class Releases : public testing::Test {
 protected:
  const Shape shape_ = jitteredSphere(2, 0.2);
  const TouchedBody body_ = touchedSphere(2, false);
  const std::vector<int> fixed_ = body_.greens->info().conditions.fixedNodes();
  CapacitanceSolver solver_{body_.greens, body_.mesh};

  std::vector<int> allBut(std::size_t left) const { return {fixed_.begin() + left, fixed_.end()}; }
};

TEST_F(Releases, DownToThreeNodesGiveWhatAFreshSolveGives) {
  double worst = 0;
  for (const std::size_t left : {std::size_t(20), std::size_t(10), std::size_t(5), std::size_t(4)})
    worst = std::max(worst, differenceToFresh(solver_, shape_, body_, allBut(left)));
  hard("a support of " + std::to_string(fixed_.size()) + " nodes released down to 20, 10, 5, 4",
       "reactions that grow without bound")
      .expectAtMost("largest difference to a fresh solve", worst, kFresh);
  hard("released down to three nodes that are not on one line", "reactions that grow without bound")
      .expectAtMost("difference to a fresh solve",
                    differenceToFresh(solver_, shape_, body_, allBut(3)), kFresh);
}

TEST_F(Releases, OfTheWholeSupportLeaveABodyToItsContacts) {
  std::vector<int> nodes = fixed_;
  const std::vector<int> free = body_.greens->info().conditions.freeNodes();
  for (std::size_t i : {std::size_t(0), free.size() / 2, free.size() - 1}) nodes.push_back(free[i]);
  hard("all released, held by contacts at three nodes",
       "a reference problem that nothing of the solved one is left of")
      .expectAtMost("difference to a fresh solve", differenceToFresh(solver_, shape_, body_, nodes),
                    kFresh);
}

TEST_F(Releases, ThatLeaveAMotionFreeAreRefusedAndTheSolverGoesOn) {
  const double before = differenceToFresh(solver_, shape_, body_, allBut(3));
  std::vector<std::function<void()>> calls;
  for (std::size_t left : {2, 1, 0})
    calls.push_back([this, left] {
      const std::vector<int> nodes = allBut(left);
      solver_.solve(switchWholeNodes(nodes, Eigen::Matrix3Xd::Zero(3, nodes.size())));
    });
  const auto released = hard("released down to two, one, no node",
                             "a factorisation that succeeds: compliances of 1e5 … 1e7");
  released.expectAllRefused(calls, "releasing these nodes would leave a rigid motion free (");
  EXPECT_EQ(solver_.cachedCount(), 1) << "the last valid state is kept";
  released.expectAtMost("change of what the solver says afterwards",
                        std::abs(differenceToFresh(solver_, shape_, body_, allBut(3)) - before), 0);
}

/// Fixes the vertices nearest to three places.
std::vector<unsigned char> threeNodes(const Shape& shape, const Eigen::Vector3d (&places)[3]) {
  std::vector<unsigned char> types(shape.points.cols(), 0);
  for (const Eigen::Vector3d& place : places) {
    Eigen::Index nearest;
    (shape.points.colwise() - place).colwise().norm().minCoeff(&nearest);
    types[nearest] = 1;
  }
  return types;
}

ElasticModel heldAt(const Shape& shape, const std::vector<unsigned char>& types) {
  const auto mesh = shape.mesh();
  return ElasticModel(mesh, Material(1, 0.3), BoundaryConditions(types),
                      Eigen::VectorXi::Zero(mesh->triangleCount()));
}

TEST(ThreeNodes, AreSupportEnoughForThePointSourcesField) {
  // What is given at the nodes is exact, so that they need not bear anything: twice the error of
  // 642 vertices on a proper support.
  const Shape shape = icosphere(3);
  hard("three nodes on a great circle hold a sphere of 642 vertices",
       "a system that is regular by quadrature noise alone")
      .expectAtMost("relative L2 error of u, point source",
                    pointSourceError(heldAt(
                        shape, threeNodes(shape, {{0, 0, 1}, {0.9, 0, -0.5}, {-0.9, 0, -0.5}}))),
                    0.01);
  hard("the three nodes of one triangle hold it", "a support of one edge that turns under the load")
      .expectAtMost("relative L2 error of u, point source",
                    pointSourceError(heldAt(shape,
                                            [&] {
                                              std::vector<unsigned char> types(shape.points.cols(),
                                                                               0);
                                              for (int v : shape.triangles.col(0)) types[v] = 1;
                                              return types;
                                            }())),
                    0.1);
}

TEST(SmallSupport, IsNamedWithItsWidth) {
  const Shape shape = icosphere(3);
  const ElasticModel model = makeModel(
      shape, [](const Eigen::Vector3d& x) { return x.z() < -0.97; }, 1, 0.3);
  double wall = 0, width = 0;
  const std::vector<std::string> warnings = modelWarnings(model, wall, width);
  hard("a support of one ring of nodes", "a compliance that diverges like 1/h³ with refinement")
      .expectSaid(warnings.empty() ? "" : warnings.front(),
                  "edges wide: its compliance depends on the mesh");
}

TEST(ThreeNodes, AlmostOnALineAreHeldToTheirCondition) {
  // The middle node of three along a cube's edge moved off it by `off`: the rotation about the line
  // is resisted by off / 2.
  const auto offLine = [](double off) {
    Eigen::Matrix3Xd points(3, 9), directions(3, 9);
    for (int i = 0; i < 9; ++i) {
      points.col(i) = Eigen::Vector3d(i / 3 == 1 ? off : 0, 0.5 * (i / 3), 0);
      directions.col(i) = Eigen::Vector3d::Unit(i % 3);
    }
    return leastResistedMotion(points, directions, 1).resistance;
  };
  double worst = 0;
  // Root mean square over nine constraints of the three nodes' distances from their common line,
  // off / 3 twice and 2 off / 3; of the second order in off otherwise.
  for (const double off : {1e-2, 1e-4, 1e-8})
    worst = std::max(worst, std::abs(offLine(off) / (off * std::sqrt(2. / 27)) - 1));
  hard("three nodes 1e−2 … 1e−8 off a line", "a rank that is decided by units")
      .expectAtMost("largest error of the least resistance, closed form", worst, 1e-4);
  const Shape cube = box({1, 1, 1}, {4, 4, 4});
  hard("all nodes of one edge", "a factorisation that succeeds: compliances of 1e5 … 1e7")
      .expectRefused(
          [&] {
            makeModel(
                cube, [](const auto& x) { return x.x() < 1e-9 && x.z() < 1e-9; }, 1, 0.3);
          },
          "leave a rigid motion free (rotation about the axis (");
  hard("one node", "a factorisation that succeeds: compliances of 1e5 … 1e7")
      .expectRefused(
          [&] {
            makeModel(
                icosphere(2), [](const auto& x) { return x.z() > 0.999; }, 1, 0.3);
          },
          "the only fixed node of the body of vertex 0 leaves a rigid motion free");
  hard("no node", "a factorisation that succeeds: compliances of 1e5 … 1e7")
      .expectRefused(
          [&] {
            makeModel(
                cube, [](const auto&) { return false; }, 1, 0.3);
          },
          "has no fixed node, which leaves a rigid motion free (");
}

}  // namespace
}  // namespace palpate::test
