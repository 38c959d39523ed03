// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/greens_functions.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/problems.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

bool isBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

/// Unit cube on its fixed base, every node's column and those of the patches.
struct Cube {
  explicit Cube(bool patchColumns = true, int divisions = 3)
      : model(makeModel(box({1, 1, 1}, Eigen::Vector3i::Constant(divisions)), isBase, 1, 0.3)) {
    BoundaryElementOptions options = rawWithAllColumns(model);
    options.patchColumns = patchColumns;
    greens = computeGreens(model, options);
  }
  Eigen::Matrix3Xd solveFaces(const Eigen::Matrix3Xd& tractions, Eigen::Matrix3Xd& applied) const {
    return solveFaceTractions(*greens, model.mesh(), model.smoothPatches(), tractions, applied);
  }
  ElasticModel model;
  std::shared_ptr<const GreensFunctions> greens;
};

// The same sums in another order.
constexpr double kRounding = 1e-13;

TEST(ReferenceProblem, SolutionIsTheGreensFunctionsTimesWhatIsGiven) {
  SyntheticBody body;
  body.fixed = {2, 7};
  std::mt19937 random(1);
  const Eigen::Matrix3Xd given = randomVectors(body.nodes, random);
  const Eigen::VectorXd expected = body.matrix() * given.reshaped();
  const Eigen::Matrix3Xd solved = solveReferenceProblem(*syntheticGreens(body), given);
  EXPECT_LE(relativeDifference(solved.reshaped(), expected), kRounding);
}

TEST(ReferenceProblem, NodesWithoutGivenValuesNeedNoColumn) {
  SyntheticBody body;
  body.columns = {5, 1};
  const auto greens = syntheticGreens(body);
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, body.nodes);
  EXPECT_EQ(solveReferenceProblem(*greens, given), given);
  given.col(5) = Eigen::Vector3d(1, 0, -2);
  const Eigen::VectorXd expected = body.matrix().middleCols<3>(15) * given.col(5);
  EXPECT_LE(relativeDifference(solveReferenceProblem(*greens, given).reshaped(), expected),
            kRounding);
}

TEST(ReferenceProblem, WrongInputIsRefusedByName) {
  SyntheticBody body;
  body.columns = {5, 1};
  const auto greens = syntheticGreens(body);
  EXPECT_TRUE(isRefused([&] { solveReferenceProblem(*greens, Eigen::Matrix3Xd::Zero(3, 11)); },
                        "there are 11 given values for 12 nodes"));
  EXPECT_TRUE(isRefused([&] { solveReferenceProblem(*greens, Eigen::Matrix3Xd::Ones(3, 12)); },
                        "the Green's functions of node 0 were not computed: name it among the "
                        "columns to precompute"));
  EXPECT_TRUE(isRefused([&] { greens->requireColumns(Eigen::Vector2i(1, 12)); },
                        "there is no node 12: the model has 12 nodes"));
  EXPECT_TRUE(isRefused([&] { greens->requireColumns(Eigen::Vector2i(-1, 1)); },
                        "there is no node -1: the model has 12 nodes"));
  EXPECT_NO_THROW(greens->requireColumns(Eigen::Vector2i(1, 5)));
}

TEST(FaceTractions, AppliedForceIsThatOfTheTrianglesAwayFromTheSupport) {
  const Cube cube;
  const SurfaceMesh& mesh = cube.model.mesh();
  std::mt19937 random(2);
  Eigen::Matrix3Xd tractions = randomVectors(mesh.triangleCount(), random), applied;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    for (int k = 0; k < 3; ++k)
      if (cube.greens->isFixed(mesh.triangles()(k, f))) tractions.col(f).setZero();
    force += mesh.triangleAreas()[f] * tractions.col(f);
  }
  cube.solveFaces(tractions, applied);
  EXPECT_LE((applied.rowwise().sum() - force).norm(), kRounding);
}

TEST(FaceTractions, LinearFieldsPassThePatchTestAcrossSharpEdges) {
  const Cube cube;
  const SurfaceMesh& mesh = cube.model.mesh();
  Eigen::Matrix3d gradient;
  gradient << 0.3, -0.2, 0.5, 0.1, -0.4, 0.2, 0.6, 0.1, 0.7;
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  const double g = cube.model.material().shearModulus(), nu = 0.3;
  const Eigen::Matrix3d stress =
      2 * g * (strain + nu / (1 - 2 * nu) * strain.trace() * Eigen::Matrix3d::Identity());
  const Eigen::Matrix3Xd exact = gradient * mesh.points();
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount()), applied;
  for (int v : cube.model.conditions().fixedNodes()) given.col(v) = exact.col(v);
  const Eigen::Matrix3Xd solved = cube.solveFaces(stress * mesh.triangleNormals(), applied) +
                                  solveReferenceProblem(*cube.greens, given);
  // The bound of the patch test at the default integration tolerance.
  EXPECT_LE(
      relativeError(solved, exact, cube.model, [&](int v) { return !cube.greens->isFixed(v); }),
      1e-6);
  // On the base, traction and reaction are those of the stress.
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();
  for (int v : cube.model.conditions().fixedNodes())
    reaction += cube.greens->vertexArea(v) * solved.col(v);
  EXPECT_LE((reaction + applied.rowwise().sum()).norm(), 1e-6);
}

TEST(FaceTractions, OneTractionOnAllPatchesOfAVertexIsItsOwnColumn) {
  const Cube cube;
  const Eigen::Vector3d traction(1, -2, 0.5);
  int corner;
  (cube.model.mesh().points().colwise() - Eigen::Vector3d(1, 1, 1))
      .colwise()
      .norm()
      .minCoeff(&corner);
  std::vector<int> patches;
  for (std::size_t c = 0; c < cube.greens->info().patchColumns.size(); ++c)
    if (cube.greens->info().patchColumns[c].node == corner) patches.push_back(int(c));
  ASSERT_EQ(patches.size(), 3u);
  Eigen::VectorXd apart = Eigen::VectorXd::Zero(3 * cube.greens->nodeCount()), together = apart;
  cube.greens->accumulatePatches(nodeList(patches), traction.replicate<3, 1>(), apart);
  cube.greens->accumulate(nodeList({corner}), traction, together);
  // Two solves with the same factors, condition below 1e4.
  EXPECT_LE(relativeDifference(apart, together), 1e-11);
}

TEST(FaceTractions, OnASmoothSurfaceTheyAreTheNodalProblem) {
  const ElasticModel model = makeModel(
      icosphere(2), [](const auto& x) { return x.z() < -0.5; }, 1, 0.3);
  const auto greens = computeGreens(model, raw());
  const SurfaceMesh& mesh = model.mesh();
  const Eigen::Vector3d traction(0.2, 0, -1);
  Eigen::Matrix3Xd faces = traction.replicate(1, mesh.triangleCount());
  Eigen::Matrix3Xd applied, nodal = traction.replicate(1, mesh.vertexCount());
  for (int v : model.conditions().fixedNodes()) nodal.col(v).setZero();
  const Eigen::Matrix3Xd solved =
      solveFaceTractions(*greens, mesh, model.smoothPatches(), faces, applied);
  EXPECT_LE(relativeDifference(solved, solveReferenceProblem(*greens, nodal)), kRounding);
  // What falls on fixed nodes is part of their reaction and not listed.
  EXPECT_LE((applied - nodal * mesh.vertexAreas().asDiagonal()).norm(), kRounding);
}

TEST(FaceTractions, WrongInputIsRefusedByName) {
  const Cube cube(false, 2);
  const SurfaceMesh& mesh = cube.model.mesh();
  const Eigen::VectorXi& patches = cube.model.smoothPatches();
  Eigen::Matrix3Xd applied, tractions = Eigen::Matrix3Xd::Zero(3, mesh.triangleCount());
  EXPECT_TRUE(isRefused([&] { cube.solveFaces(Eigen::Matrix3Xd::Zero(3, 7), applied); },
                        "there are 7 triangle tractions and 48 patch numbers for 48 triangles"));
  EXPECT_TRUE(isRefused(
      [&] { solveFaceTractions(*cube.greens, mesh, patches.head(5), tractions, applied); },
      "there are 48 triangle tractions and 5 patch numbers for 48 triangles"));
  EXPECT_TRUE(isRefused(
      [&] {
        const auto sphere = icosphere(1).mesh();
        solveFaceTractions(*cube.greens, *sphere, patches, tractions, applied);
      },
      "the Green's functions have 26 nodes, the surface 42 vertices"));
  // A load on one face of the top edge, without patch columns.
  int loaded = -1;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (mesh.triangleNormals()(2, f) > 0.9) loaded = f;
  tractions.col(loaded) = Eigen::Vector3d::UnitZ();
  const int node = mesh.triangles().col(loaded).minCoeff();
  EXPECT_TRUE(isRefused([&] { cube.solveFaces(tractions, applied); },
                        "node " + std::to_string(node) +
                            " lies on a sharp edge: precompute with patch columns to load its "
                            "patches apart"));
}

}  // namespace
}  // namespace palpate::test
