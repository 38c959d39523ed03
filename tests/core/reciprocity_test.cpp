// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/reciprocity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <limits>

#include "support/problems.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

/// A made-up body of 50 nodes (more than a tile) with columns of some, in random order.
template <class Scalar>
struct Example {
  explicit Example(unsigned seed = 3) {
    std::mt19937 random(seed);
    body.nodes = 50;
    body.fixed = {0, 7, 8, 40};
    body.columns = randomSubset(50, 41, random);
    info = body.info();
    const Eigen::MatrixXd all = body.matrix();
    matrix.resize(150, 3 * body.columns.size());
    for (std::size_t c = 0; c < body.columns.size(); ++c)
      matrix.template middleCols<3>(3 * c) =
          all.middleCols<3>(3 * body.columns[c]).template cast<Scalar>();
  }

  double makeReciprocal(bool symmetrise) {
    return palpate::makeReciprocal(matrix.data(), info.conditions, info.vertexAreas, body.columns,
                                   symmetrise);
  }

  /// S_ij = Xi_ij / a_j between the free nodes that have columns.
  Eigen::MatrixXd forceCompliance() const {
    std::vector<int> rows, columns;
    for (std::size_t c = 0; c < body.columns.size(); ++c)
      for (int k = 0; k < 3 && !info.conditions.isFixed(body.columns[c]); ++k) {
        rows.push_back(3 * body.columns[c] + k);
        columns.push_back(3 * int(c) + k);
      }
    Eigen::MatrixXd s = matrix.template cast<double>()(rows, columns);
    for (std::size_t k = 0; k < rows.size(); ++k) s.col(k) /= info.vertexAreas[rows[k] / 3];
    return s;
  }

  SyntheticBody body;
  GreensFunctionsInfo info;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> matrix;
};

template <class Scalar>
class ReciprocityOf : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(ReciprocityOf, Scalars);

TYPED_TEST(ReciprocityOf, DefectIsTheAntisymmetricShareAndLookingChangesNothing) {
  Example<TypeParam> example;
  const Eigen::MatrixXd s = example.forceCompliance();
  const auto before = example.matrix;
  const double defect = example.makeReciprocal(false);
  EXPECT_NEAR(defect, (s - s.transpose()).norm() / s.norm(), 1e-13);
  EXPECT_GT(defect, 0.1);
  EXPECT_EQ(example.matrix, before);
}

TYPED_TEST(ReciprocityOf, ServedComplianceIsTheSymmetricPart) {
  Example<TypeParam> example;
  const Eigen::MatrixXd s = example.forceCompliance();
  example.makeReciprocal(true);
  // Each entry is rounded when it is stored, times its area and divided again.
  const double tolerance = 4 * std::numeric_limits<TypeParam>::epsilon();
  EXPECT_LE(relativeDifference(example.forceCompliance(), (s + s.transpose()) / 2), tolerance);
  EXPECT_LE(example.makeReciprocal(false), tolerance);
}

TYPED_TEST(ReciprocityOf, RowsAndColumnsOfOtherNodesStayAsTheyAre) {
  Example<TypeParam> example;
  const auto before = example.matrix;
  example.makeReciprocal(true);
  std::vector<bool> hasColumn(example.body.nodes, false);
  for (int node : example.body.columns) hasColumn[node] = true;
  int kept = 0;
  for (std::size_t c = 0; c < example.body.columns.size(); ++c)
    for (int row = 0; row < example.body.nodes; ++row) {
      if (!example.info.conditions.isFixed(example.body.columns[c]) &&
          !example.info.conditions.isFixed(row) && hasColumn[row])
        continue;
      ++kept;
      EXPECT_EQ((example.matrix.template block<3, 3>(3 * row, 3 * c)),
                (before.template block<3, 3>(3 * row, 3 * c)));
    }
  EXPECT_GT(kept, 0);
}

TEST(Reciprocity, EnergyOfAnyTractionIsKept) {
  Example<double> example;
  std::mt19937 random(4);
  const Eigen::MatrixXd before = example.forceCompliance();
  example.makeReciprocal(true);
  const Eigen::MatrixXd after = example.forceCompliance();
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::VectorXd force = randomVectors(int(before.rows() / 3), random).reshaped();
    EXPECT_NEAR(force.dot(after * force) / force.dot(before * force), 1, 1e-13);
  }
}

TYPED_TEST(ReciprocityOf, WorkOfKeptForcesIsKeptUnlessAColumnIsMissing) {
  for (const bool complete : {true, false}) {
    Example<TypeParam> example;
    std::mt19937 random(5);
    Eigen::Matrix3Xd force = randomVectors(example.body.nodes, random);
    std::vector<int> freeColumns;
    for (int node : example.body.columns)
      if (!example.info.conditions.isFixed(node)) freeColumns.push_back(node);
    if (complete)
      for (int node : example.info.conditions.freeNodes())
        if (std::count(freeColumns.begin(), freeColumns.end(), node) == 0)
          force.col(node).setZero();
    const Eigen::VectorXd f = force(Eigen::all, freeColumns).reshaped();
    const Eigen::MatrixXd before = example.forceCompliance();
    palpate::makeReciprocal(example.matrix.data(), example.info.conditions,
                            example.info.vertexAreas, example.body.columns, true, {force});
    const Eigen::MatrixXd after = example.forceCompliance();
    const double tolerance = 20 * std::numeric_limits<TypeParam>::epsilon();
    EXPECT_LE(relativeDifference(after, after.transpose()), tolerance);
    if (complete)
      EXPECT_LE(relativeDifference(f.transpose() * after, f.transpose() * before), tolerance);
    else
      EXPECT_LE(relativeDifference(after, (before + before.transpose()) / 2), tolerance);
  }
}

TEST(Reciprocity, UnitPressuresDoTheWorkOfTheChangeOfVolume) {
  const auto mesh = icosphere(2).mesh();
  const Eigen::Matrix3Xd force = unitPressures(*mesh).at(0);
  EXPECT_LT(force.rowwise().sum().norm(), 1e-14);
  double volume = 0;
  for (int f = 0; f < mesh->triangleCount(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh->points().col(mesh->triangles()(k, f));
    volume += corners.determinant() / 6;
  }
  EXPECT_NEAR(force.cwiseProduct(mesh->points()).sum(), 3 * volume, 1e-13);
}

TEST(Reciprocity, WithoutFreeColumnsThereIsNoDefect) {
  const SyntheticBody body;
  Eigen::MatrixXd matrix = body.matrix();
  const BoundaryConditions conditions(std::vector<unsigned char>(12, 1));
  std::vector<int> columns = body.info().columnNodes;
  EXPECT_EQ(makeReciprocal(matrix.data(), conditions, body.info().vertexAreas, columns, true), 0);
  columns.clear();
  EXPECT_EQ(makeReciprocal(matrix.data(), conditions, body.info().vertexAreas, columns, true), 0);
  EXPECT_EQ(matrix, body.matrix());
}

TEST(Reciprocity, DefectOfTheDiscretisationFallsWithRegularRefinement) {
  for (Collocation collocation : {Collocation::Vertex, Collocation::Averaged}) {
    double coarser = 1;
    for (int levels : {2, 3}) {
      const ElasticModel model = makeModel(
          icosphere(levels), [](const auto& x) { return x.z() < -0.5; }, 1, 0.3);
      BoundaryElementOptions options = raw();
      options.collocation = collocation;
      const double defect = computeGreens(model, options)->info().diagnostics.reciprocityDefect;
      // At least like the square root of the mesh size: a halved size gives less than 0.71.
      EXPECT_LT(defect, 0.71 * coarser) << levels;
      EXPECT_GT(defect, 1e-6);  // collocation is not exactly reciprocal
      coarser = defect;
    }
  }
}

/// Green's functions of a rigid body on a hinge: displacement = rotation x arm about `centre`,
/// rotation = compliance * torque.
std::shared_ptr<const GreensFunctions> hinged(const SurfaceMesh& mesh, GreensFunctionsInfo info,
                                              const std::vector<Eigen::Matrix3d>& compliance,
                                              const std::vector<Eigen::Vector3d>& centre) {
  const int n = mesh.vertexCount();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  const auto cross = [&](int v) {  // omega -> omega x r
    const Eigen::Vector3d r = mesh.points().col(v) - centre[mesh.bodyOfVertex(v)];
    Eigen::Matrix3d m;
    for (int c = 0; c < 3; ++c) m.col(c) = Eigen::Vector3d::Unit(c).cross(r);
    return m;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (mesh.bodyOfVertex(i) == mesh.bodyOfVertex(j))
        matrix.block<3, 3>(3 * i, 3 * j) = cross(i) * compliance[mesh.bodyOfVertex(j)] *
                                           cross(j).transpose() * info.vertexAreas[j];
  return denseGreens(std::move(info), matrix);
}

GreensFunctionsInfo infoOf(const SurfaceMesh& mesh) {
  GreensFunctionsInfo info;
  info.conditions = BoundaryConditions(std::vector<unsigned char>(mesh.vertexCount(), 0));
  info.vertexAreas = mesh.vertexAreas();
  for (int v = 0; v < mesh.vertexCount(); ++v) info.columnNodes.push_back(v);
  return info;
}

TEST(RockingCompliance, OfARigidBodyOnAHingeIsTheHinges) {
  const auto mesh = icosphere(1).moved({3, 0, 1}).mesh();
  Eigen::Matrix3d compliance = Eigen::Vector3d(0.5, 2, 7).asDiagonal();
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  compliance = turn * compliance * turn.inverse();
  // The hinge may lie anywhere: translations of a body that turns about its middle do no work.
  for (const Eigen::Vector3d& centre : {Eigen::Vector3d(3, 0, 1), Eigen::Vector3d(3, 0.2, 0)}) {
    const auto greens = hinged(*mesh, infoOf(*mesh), {compliance}, {centre});
    EXPECT_NEAR(rockingCompliance(*greens, *mesh), 7, 1e-11);
  }
}

TEST(RockingCompliance, IsThatOfTheSoftestBodyWhoseColumnsAreThere) {
  const auto mesh = icosphere(1).with(icosphere(0).moved({4, 0, 0})).mesh();
  const std::vector<Eigen::Matrix3d> compliance = {2 * Eigen::Matrix3d::Identity(),
                                                   5 * Eigen::Matrix3d::Identity()};
  const std::vector<Eigen::Vector3d> centre = {{0, 0, 0}, {4, 0, 0}};
  GreensFunctionsInfo info = infoOf(*mesh);
  EXPECT_NEAR(rockingCompliance(*hinged(*mesh, info, compliance, centre), *mesh), 5, 1e-11);
  info.columnNodes.pop_back();  // one of the second body
  EXPECT_NEAR(rockingCompliance(*hinged(*mesh, info, compliance, centre), *mesh), 2, 1e-11);
  info.columnNodes.erase(info.columnNodes.begin());
  EXPECT_EQ(rockingCompliance(*hinged(*mesh, info, compliance, centre), *mesh), -1);
}

TEST(RockingCompliance, GrowsWithoutBoundAsASupportShrinksToAPoint) {
  double wider = 0;
  for (double height : {-0.6, -0.82, -0.93}) {
    const ElasticModel model = makeModel(
        icosphere(2), [&](const auto& x) { return x.z() < height; }, 1, 0.3);
    const auto greens = computeGreens(model, raw());
    const double compliance = rockingCompliance(*greens, model.mesh());
    EXPECT_DOUBLE_EQ(compliance, greens->info().diagnostics.rockingCompliance);
    EXPECT_GT(compliance, 2 * wider);
    // Inversely proportional to stiffness.
    EXPECT_NEAR(rockingCompliance(*greens->withYoungsModulus(4), model.mesh()) * 4 / compliance, 1,
                1e-12);
    wider = compliance;
  }
}

}  // namespace
}  // namespace palpate::test
