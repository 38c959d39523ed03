// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/imported_greens_functions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <random>

#include "contact/capacitance_solver.h"
#include "contact/surface_stiffness.h"
#include "greens/rigid_motions.h"
#include "linear_algebra/sparse_factorization.h"
#include "support/given_bodies.h"
#include "support/half_space.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

Eigen::MatrixXd gathered(const GreensFunctions& greens, const std::vector<int>& columns) {
  const std::vector<int> rows = nodesUpTo(greens.nodeCount());
  Eigen::MatrixXd blocks(3 * rows.size(), 3 * columns.size());
  greens.gather(nodeList(rows), nodeList(columns), blocks.data());
  return blocks;
}

TEST(ImportedGreensFunctions, AComplianceComesBackAsItWas) {
  const HalfSpace body = halfSpace(jitteredPlate(1, 6, 0.3), 0.3, true, 1e4);
  const std::vector<int> all = nodesUpTo(body.mesh->vertexCount());
  const auto greens = imported(givenModel(jitteredPlate(1, 6, 0.3)), MatrixKind::Compliance,
                               forceCompliance(*body.greens, all));
  EXPECT_LE(relativeDifference(gathered(*greens, all), gathered(*body.greens, all)), 1e-14);
  EXPECT_EQ(greens->info().columnNodes, all);
  EXPECT_TRUE(greens->info().reciprocal);
  EXPECT_FALSE(greens->info().homogeneous);
  EXPECT_EQ(greens->info().source, "imported compliance (test, 49 nodes)");
  EXPECT_TRUE(greens->info().diagnostics.warnings.empty());
  EXPECT_LE(greens->info().diagnostics.reciprocityDefect, 1e-14);
}

TEST(ImportedGreensFunctions, AreAsStiffAsWhatTheyAreFrom) {
  const Shape shape = plate(1, 8);
  const HalfSpace body = halfSpace(shape, 0.3, true, 5e3);
  const auto greens = imported(givenModel(shape), MatrixKind::Compliance,
                               forceCompliance(*body.greens, nodesUpTo(body.mesh->vertexCount())));
  const SurfaceStiffness here(greens, body.mesh, MaskShape::Linear, 0.25),
      there(body.greens, body.mesh, MaskShape::Linear, 0.25);
  EXPECT_LE(relativeDifference(here.elastic(40), there.elastic(40)), 1e-12);
  // The apparent modulus is of the size of the true one: a half-space is stiffer than a cube.
  EXPECT_NEAR(std::log10(greens->info().material.youngsModulus() / 5e3), 0, 1);
  const auto twice = greens->withYoungsModulus(2 * greens->info().material.youngsModulus());
  EXPECT_LE(relativeDifference(blockOf(*twice, 3, 7), (blockOf(*greens, 3, 7) / 2).eval()), 1e-15);
}

TEST(ImportedGreensFunctions, AStiffnessIsSolvedWithWhatLiesInside) {
  const Truss truss;
  const auto greens = imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes);
  const std::vector<int> free = truss.model.conditions().freeNodes(),
                         fixed = truss.model.conditions().fixedNodes();
  EXPECT_EQ(greens->info().columnNodes, free);
  EXPECT_EQ(greens->info().source,
            "imported stiffness (test, 27 nodes, 3 degrees of freedom condensed out)");

  // The whole system with forces on the free surface alone, the base held.
  std::vector<int> moving;
  for (int p = 0; p < 27; ++p)
    if (!base(truss.solid.points.col(p)))
      for (int c = 0; c < 3; ++c) moving.push_back(3 * p + c);
  const Eigen::MatrixXd inverse = truss.stiffness(moving, moving).inverse();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(81, 81);
  whole(moving, moving) = inverse;
  const std::vector<int> rows = truss.rowsOf(free), held = truss.rowsOf(fixed);
  EXPECT_LE(relativeDifference(forceCompliance(*greens, free), Eigen::MatrixXd(whole(rows, rows))),
            1e-12);
  const Eigen::MatrixXd reactions = truss.stiffness(held, Eigen::all) * whole(Eigen::all, rows);
  for (std::size_t j = 0; j < free.size(); ++j)
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      const Eigen::Matrix3d served = blockOf(*greens, fixed[i], free[j]) *
                                     greens->vertexArea(fixed[i]) / greens->vertexArea(free[j]);
      EXPECT_LE((served - reactions.block<3, 3>(3 * i, 3 * j)).norm(), 1e-12);
    }
}

TEST(ImportedGreensFunctions, ReactionsOutweighForces) {
  const Truss truss;
  const auto greens = imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes);
  for (int node : greens->info().columnNodes) {
    Eigen::Matrix3d sum = greens->vertexArea(node) * Eigen::Matrix3d::Identity();
    for (int fixed : truss.model.conditions().fixedNodes())
      sum += greens->vertexArea(fixed) * blockOf(*greens, fixed, node);
    EXPECT_LE(sum.norm(), 1e-12);
  }
}

TEST(ImportedGreensFunctions, MovedSupportsCarryTheBodyRigidly) {
  const Truss truss;
  ImportOptions options;
  options.columns = nodesUpTo(truss.model.mesh().vertexCount());
  const auto greens =
      imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes, options);
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, greens->nodeCount());
  const auto rigid = [&](int node) -> Eigen::Vector3d {
    const Eigen::Vector3d turn(0.3, -0.2, 0.5), shift(1, 2, 3);
    return shift + turn.cross(truss.model.mesh().points().col(node));
  };
  for (int node : truss.model.conditions().fixedNodes()) moved.col(node) = rigid(node);
  const Eigen::Matrix3Xd answer = solveReferenceProblem(*greens, moved);
  for (int node = 0; node < greens->nodeCount(); ++node)
    EXPECT_LE(
        (answer.col(node) - (greens->isFixed(node) ? Eigen::Vector3d::Zero() : rigid(node))).norm(),
        1e-11);
}

TEST(ImportedGreensFunctions, ALooseBodyCannotBeReleased) {
  const Truss truss;
  ImportOptions options;
  options.columns = nodesUpTo(truss.model.mesh().vertexCount());
  const auto greens =
      imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes, options);
  CapacitanceSolver solver(greens, truss.model.sharedMesh());
  BoundaryValues values;
  values.switches = switchesOfNodes(truss.model.conditions().fixedNodes());
  values.prescribed = Eigen::VectorXd::Zero(values.switches.size());
  EXPECT_TRUE(isRefused<std::exception>([&] { solver.solve(values); }, "cannot be told apart"));
}

TEST(ImportedGreensFunctions, AComplianceAndItsStiffnessAreTheSameBody) {
  // Held at the base where the matrix is from, and beyond that at one side.
  const Truss truss;
  const std::vector<int> above = truss.model.conditions().freeNodes(), rows = truss.rowsOf(above);
  const std::vector<int> inside = {3 * 13, 3 * 13 + 1, 3 * 13 + 2};
  Eigen::MatrixXd stiffness =
      truss.stiffness(rows, rows) - truss.stiffness(rows, inside) *
                                        Eigen::MatrixXd(truss.stiffness(inside, inside)).inverse() *
                                        truss.stiffness(inside, rows);
  const auto nodes = nodesAt(truss.model.mesh().points()(Eigen::all, above));
  const ElasticModel model =
      givenModel(boundaryOf(truss.solid.mesh()), [](auto&& x) { return base(x) || x.x() < 1e-9; });
  ImportOptions options;
  options.columns = above;
  const auto soft = imported(model, MatrixKind::Compliance, stiffness.inverse(), nodes, options),
             stiff = imported(model, MatrixKind::Stiffness, stiffness, nodes, options);
  EXPECT_LE(relativeDifference(gathered(*soft, above), gathered(*stiff, above)), 1e-11);
  EXPECT_EQ(soft->info().conditions.fixedNodes().size(), 6u);
}

TEST(ImportedGreensFunctions, VerticesThatTheMatrixLacksAreHeldWhereItIsFrom) {
  const SolidProblem fem = solidProblem(kuhnBox({1, 1, 1}, {2, 2, 2}).mesh(), base, 1e4, 0.3);
  if (!SparseFactorization::isAvailable()) GTEST_SKIP() << "no MUMPS";
  const auto greens = fem.greens();
  const std::vector<int> free = greens->info().columnNodes;
  const Shape shape{fem.model.mesh().points(), fem.model.mesh().triangles()};
  const Eigen::MatrixXd compliance = forceCompliance(*greens, free);
  // By the places of the nodes, by the order of the free vertices, and with rows of zeros.
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(3 * greens->nodeCount(), 3 * greens->nodeCount());
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t j = 0; j < free.size(); ++j)
      padded.block<3, 3>(3 * free[i], 3 * free[j]) = compliance.block<3, 3>(3 * i, 3 * j);
  const auto places = nodesAt(fem.model.mesh().points()(Eigen::all, free));
  for (const auto& body :
       {imported(givenModel(shape, base), MatrixKind::Compliance, compliance, places),
        imported(givenModel(shape, base), MatrixKind::Compliance, compliance),
        imported(givenModel(shape), MatrixKind::Compliance, padded)}) {
    EXPECT_LE(relativeDifference(forceCompliance(*body, free), compliance), 1e-13);
    EXPECT_EQ(body->info().columnNodes, free);
    EXPECT_TRUE(body->info().conditions.fixedNodes().empty());
    EXPECT_EQ(body->missingCount(), 9);
    for (int node : fem.model.conditions().fixedNodes())
      EXPECT_EQ(blockOf(*body, node, free[0]).norm(), 0);
    EXPECT_TRUE(contains(body->info().source, "9 vertices held where it is from"));
  }
  ImportOptions options;
  options.columns = {0};
  EXPECT_TRUE(isRefused(
      [&] {
        imported(givenModel(shape, base), MatrixKind::Compliance, compliance, places, options);
      },
      "vertex 0 is held where the matrix is from"));
}

TEST(ImportedGreensFunctions, OnesOnTheDiagonalHoldAVertex) {
  const Truss truss;
  Eigen::MatrixXd held = truss.stiffness;
  for (int row : truss.rowsOf(truss.model.conditions().fixedNodes())) {
    held.row(row).setZero();
    held.col(row).setZero();
    held(row, row) = 1;
  }
  const auto greens = imported(truss.model, MatrixKind::Stiffness, held, truss.nodes),
             whole = imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes);
  const std::vector<int> free = truss.model.conditions().freeNodes();
  EXPECT_LE(relativeDifference(forceCompliance(*greens, free), forceCompliance(*whole, free)),
            1e-12);
  EXPECT_EQ(greens->missingCount(), 9);
  EXPECT_TRUE(isRefused(
      [&] {
        imported(givenModel(boundaryOf(truss.solid.mesh())), MatrixKind::Stiffness, held,
                 truss.nodes);
      },
      "the stiffness does not couple vertex 0 to any other"));
}

TEST(ImportedGreensFunctions, AreTheSameInAnyOrderAndUnit) {
  const Truss truss;
  const auto plain = imported(truss.model, MatrixKind::Stiffness, truss.stiffness, truss.nodes);
  std::mt19937 random(3);
  const std::vector<int> order = randomSubset(27, 27, random);
  NodeTable nodes;
  nodes.points = 1000 * truss.solid.points(Eigen::all, order);  // mm
  for (int p : order) nodes.numbers.push_back(p + 100);
  std::vector<int> byNode, byComponent;
  for (int p : order)
    for (int c = 0; c < 3; ++c) byNode.push_back(3 * p + c);
  for (int c = 0; c < 3; ++c)
    for (int p : order) byComponent.push_back(3 * p + c);
  const double factor = 1e-3 / 1e3;  // kN/mm of N/m
  for (DofOrder ordered : {DofOrder::ByNode, DofOrder::ByComponent}) {
    const std::vector<int>& rows = ordered == DofOrder::ByNode ? byNode : byComponent;
    ImportOptions options;
    options.order = ordered;
    options.lengthUnit = 1e-3;
    options.forceUnit = 1e3;
    const auto shuffled = imported(truss.model, MatrixKind::Stiffness,
                                   factor * truss.stiffness(rows, rows), nodes, options);
    const std::vector<int> columns = plain->info().columnNodes;
    EXPECT_LE(relativeDifference(gathered(*shuffled, columns), gathered(*plain, columns)), 1e-12);
    EXPECT_EQ(shuffled->info().fingerprint, plain->info().fingerprint);
  }
}

TEST(ImportedGreensFunctions, ALargeSparseStiffnessIsCondensedAsADenseOne) {
  if (!SparseFactorization::isAvailable()) GTEST_SKIP() << "no MUMPS";
  const Solid solid = kuhnBox({1, 1, 1}, {9, 9, 9});  // 512 points inside
  const Eigen::MatrixXd stiffness = trussStiffness(solid);
  const ElasticModel model = givenModel(boundaryOf(solid.mesh()), base);
  const auto sparse = importGreensFunctions(
                          model, MatrixKind::Stiffness,
                          GivenMatrix(3000, entriesOf(stiffness), false, "test", "given"),
                          nodesAt(solid.points))
                          .greens.take(),
             dense = imported(model, MatrixKind::Stiffness, stiffness, nodesAt(solid.points));
  const std::vector<int> columns = {200, 300, 400};
  EXPECT_LE(relativeDifference(gathered(*sparse, columns), gathered(*dense, columns)), 1e-10);
}

TEST(ImportedGreensFunctions, OfAnUnsupportedBodyUndoItsStiffness) {
  const Solid solid = cubeOfFive();
  const Eigen::MatrixXd stiffness = trussStiffness(solid);
  const Shape shape = boundaryOf(solid.mesh());
  const ElasticModel model = givenModel(shape);
  ImportOptions options;
  options.unsupported = true;
  const ImportedGreensFunctions imported = importGreensFunctions(
      model, MatrixKind::Stiffness, given(stiffness), nodesAt(solid.points), options);
  const Eigen::VectorXd& areas = imported.model.mesh().vertexAreas();
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(model.mesh());
  Eigen::MatrixXd tractions(motions.rows(), 3);
  for (Eigen::Index i = 0; i < tractions.size(); ++i) tractions(i) = std::sin(1.3 * i);
  tractions -= motions * (meanRigidMotion(areas, motions) * tractions).eval();
  const Eigen::Map<const Eigen::MatrixXd> xi(imported.greens.matrix.data(), motions.rows(),
                                             motions.rows());
  const Eigen::MatrixXd moved = xi * tractions;
  Eigen::MatrixXd forces = tractions;
  for (int v = 0; v < areas.size(); ++v) forces.middleRows<3>(3 * v) *= areas[v];
  EXPECT_LT((stiffness * moved - forces).norm(), 1e-10 * forces.norm());
  EXPECT_LT((meanRigidMotion(areas, motions) * moved).norm(), 1e-10 * moved.norm());
  EXPECT_LT((xi * motions).norm(), 1e-10 * moved.norm());
  EXPECT_NE(imported.greens.info.source.find("unsupported"), std::string::npos);

  const auto refused = [&](const ElasticModel& of, MatrixKind kind, const Eigen::MatrixXd& matrix,
                           const char* sentence) {
    return isRefused(
        [&] { importGreensFunctions(of, kind, given(matrix), nodesAt(solid.points), options); },
        sentence);
  };
  Eigen::MatrixXd held = stiffness;
  held.topLeftCorner<3, 3>().diagonal().array() += 1;
  EXPECT_TRUE(refused(model, MatrixKind::Stiffness, held, "resists rigid motions"));
  EXPECT_TRUE(refused(model, MatrixKind::Compliance, held, "by its stiffness"));
  EXPECT_TRUE(refused(givenModel(shape, [](const Eigen::Vector3d& x) { return x.z() < 1e-9; }),
                      MatrixKind::Stiffness, stiffness, "leave out what fixes them"));
}

TEST(ImportedGreensFunctions, RawComplianceStaysAsItIs) {
  const HalfSpace body = halfSpace(jitteredPlate(1, 6, 0.3), 0.3, false);
  const std::vector<int> all = nodesUpTo(body.mesh->vertexCount());
  const Eigen::MatrixXd compliance = forceCompliance(*body.greens, all);
  const ElasticModel model = givenModel(jitteredPlate(1, 6, 0.3));
  EXPECT_TRUE(isRefused([&] { imported(model, MatrixKind::Compliance, compliance); },
                        "the compliance is not symmetric"));
  ImportOptions raw;
  raw.reciprocal = false;
  const auto greens = imported(model, MatrixKind::Compliance, compliance, {}, raw);
  EXPECT_LE(relativeDifference(gathered(*greens, all), gathered(*body.greens, all)), 1e-14);
  EXPECT_NEAR(greens->info().diagnostics.reciprocityDefect,
              body.greens->info().diagnostics.reciprocityDefect, 1e-12);
  EXPECT_FALSE(greens->info().reciprocal);
}

TEST(ImportedGreensFunctions, WhatDoesNotFitTheSurfaceIsRefused) {
  const Truss truss;
  const auto refused = [&](const Eigen::MatrixXd& matrix, const NodeTable& nodes,
                           const std::string& words, const ImportOptions& options = {}) {
    EXPECT_TRUE(isRefused(
        [&] { imported(truss.model, MatrixKind::Stiffness, matrix, nodes, options); }, words));
  };
  const Eigen::MatrixXd& k = truss.stiffness;
  refused(k, {}, "the matrix has 81 rows, but the surface has 26 vertices, 17 of them free");
  refused(k.topLeftCorner(80, 80), truss.nodes, "there are 27 nodes for 80 rows");
  refused(k.topLeftCorner(77, 77), {}, "no multiple of 3");
  refused(k, nodesAt(1000 * truss.solid.points), "1000 times the surface's size");
  NodeTable moved = truss.nodes;
  moved.points.col(26) += Eigen::Vector3d(0.01, 0, 0);
  refused(k, moved, "vertex 25 has no node in the matrix: the nearest, node 27, is 0.01 away");
  moved.points.col(26) = moved.points.col(25);
  refused(k, moved, "nodes 26 and 27 are both at vertex 24");
  ImportOptions options;
  options.lengthUnit = 0;
  refused(k, truss.nodes, "units must be positive", options);
  options = {};
  options.nodeTolerance = -1;
  refused(k, truss.nodes, "above 0", options);
  EXPECT_TRUE(isRefused(
      [&] {
        importGreensFunctions(givenModel(boundaryOf(truss.solid.mesh()).flipped(), base),
                              MatrixKind::Stiffness, given(k), truss.nodes);
      },
      "point into what it encloses"));
}

}  // namespace
}  // namespace palpate::test
