// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Probes inside bodies of finite elements, of any materials.

#include "fem/solid_probes.h"

#include <gtest/gtest.h>

#include "bem/interior_probes.h"
#include "support/refusals.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

bool onBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

/// The fields that these tractions at vertices cause, by the rows of the body's Green's functions.
ProbedField fieldUnder(const ProbeRows& rows, int point, const Eigen::Matrix3Xd& tractions) {
  ProbeValues values = ProbeValues::Zero();
  for (int node = 0; node < tractions.cols(); ++node)
    rows.accumulate(point, node, tractions.col(node), values);
  return fieldOf(values, rows.stiffness(point));
}

/// Tractions that pull the top of [0, size] evenly: rows of patch columns would be exact; these put
/// the same force on it and, at its edges, on what hangs over.
Eigen::Matrix3Xd pullOnTop(const SurfaceMesh& mesh) {
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (mesh.triangleNormals()(2, f) > 0.5)
      for (int v : mesh.triangles().col(f))
        tractions(2, v) += mesh.triangleAreas()[f] / 3 / mesh.vertexAreas()[v];
  return tractions;
}

TEST(SolidProbes, AreFoundInTheirCells) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 2}, {2, 2, 4}).mesh();
  const SolidProblem block = solidProblem(mesh, onBase, 1, 0.3);
  Eigen::Matrix3Xd points(3, 3);
  points.col(0) << 0.3, 0.4, 1.1;
  points.col(1) << 0.5, 0.5, 1;  // a vertex
  points.col(2) << 1, 0.2, 0.7;  // on the surface
  const auto probes = fem::locateProbes(block.body, points);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d place =
        mesh.points()(Eigen::all, mesh.tetrahedra().col(probes[i].cell)) * probes[i].barycentric;
    EXPECT_LT((place - points.col(i)).norm(), 1e-12);
    EXPECT_NEAR(probes[i].barycentric.sum(), 1, 1e-12);
  }
  EXPECT_TRUE(isRefused([&] { fem::locateProbes(block.body, Eigen::Vector3d(0.5, 0.5, 2.1)); },
                        "probe 0 at (0.5, 0.5, 2.1) is not inside the body"));
  EXPECT_TRUE(isRefused([&] { fem::locateProbes(block.body, Eigen::Vector3d(NAN, 0, 0)); },
                        "is not inside the body"));
}

TEST(SolidProbes, SeeTheStressOfEachLayerOfAColumn) {
  // Two layers without contraction under an even pull p: strain p / E in each, stress p in both.
  const TetrahedralMesh mesh = kuhnBox({1, 1, 4}, {3, 3, 12}).mesh();
  std::vector<int> number;
  for (int cell = 0; cell < mesh.cellCount(); ++cell)
    number.push_back(mesh.points()(2, Eigen::all)(mesh.tetrahedra().col(cell)).mean() > 2);
  const ElasticModel model = makeModel(boundaryOf(mesh), onBase, 2, 0);
  const SolidBody body(model.mesh(), mesh,
                       {Elasticity(Material(2, 0)), Elasticity(Material(10, 0))}, number);
  FiniteElementOptions options;
  options.probes.resize(3, 2);
  options.probes << 0.4, 0.45, 0.55, 0.5, 1.2, 2.6;
  const auto greens = computeFiniteElementGreensFunctions(model, body, options).take();
  const ProbeRows& rows = *greens->info().probes;
  ASSERT_EQ(rows.count(), 2);
  EXPECT_FALSE(greens->info().homogeneous);
  const Eigen::Matrix3Xd pull = pullOnTop(model.mesh());
  const double young[2] = {2, 10}, risen[2] = {1.2 / 2, 2. / 2 + 0.6 / 10};
  for (int i = 0; i < 2; ++i) {
    // A pull that is even but for the top's edges: Saint-Venant leaves little of that inside.
    const ProbedField field = fieldUnder(rows, i, pull);
    EXPECT_NEAR(field.stress(2, 2), 1, 0.02) << i;
    EXPECT_NEAR(field.gradient(2, 2) * young[i], 1, 0.02) << i;
    EXPECT_NEAR(field.displacement.z() / risen[i], 1, 0.02) << i;
    EXPECT_LT(std::abs(field.stress(0, 0)) + std::abs(field.stress(0, 2)), 0.05) << i;
  }
  const auto stiffer = greens->withYoungsModulus(3 * greens->info().material.youngsModulus());
  const ProbedField before = fieldUnder(rows, 0, pull),
                    after = fieldUnder(*stiffer->info().probes, 0, pull);
  EXPECT_LT((3 * after.displacement - before.displacement).norm(), 1e-12);
  EXPECT_LT((3 * after.gradient - before.gradient).norm(), 1e-12);
  EXPECT_LT((after.stress - before.stress).norm(), 1e-12);
}

class SolidProbesOf : public testing::TestWithParam<double> {};

TEST_P(SolidProbesOf, AHomogeneousBodyReadAsSomiglianasIdentityDoes) {
  // Two ways to the inside: the elements' own fields, and integrals over the surface's solution.
  const double poissonRatio = GetParam();
  Eigen::Vector3d differences[2];
  for (int level = 0; level < 2; ++level) {
    const int n = level ? 6 : 3;
    const SolidProblem block =
        solidProblem(kuhnBox({1, 1, 1.5}, {n, n, 3 * n / 2}).mesh(), onBase, 1, poissonRatio);
    FiniteElementOptions options;
    options.probes = Eigen::Vector3d(0.41, 0.53, 0.77);
    const auto greens = block.greens(options);
    const ProbeRows somigliana = probeRows(*greens, block.model, options.probes);
    Eigen::Matrix3Xd push = pullOnTop(block.model.mesh());
    push.row(0) = 0.3 * push.row(2);
    const ProbedField a = fieldUnder(*greens->info().probes, 0, push),
                      b = fieldUnder(somigliana, 0, push);
    differences[level] = {(a.displacement - b.displacement).norm() / b.displacement.norm(),
                          (a.gradient - b.gradient).norm() / b.gradient.norm(),
                          (a.stress - b.stress).norm() / b.stress.norm()};
  }
  EXPECT_LT(differences[1][0], 0.03);
  EXPECT_LT(differences[1][1], 0.06);
  EXPECT_LT(differences[1][2], 0.06);
  EXPECT_LT(differences[1].sum(), differences[0].sum());
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, SolidProbesOf, testing::Values(0.0, 0.3, 0.49, 0.5));

TEST(SolidProbes, OfFewColumnsAreThoseOfAll) {
  const SolidProblem block = solidProblem(kuhnBox({1, 1, 1}, {3, 3, 3}).mesh(), onBase, 1, 0.3);
  FiniteElementOptions all, one;
  all.probes = one.probes = Eigen::Vector3d(0.3, 0.4, 0.5);
  one.columns = {block.model.conditions().freeNodes().back()};
  const auto a = block.greens(all), b = block.greens(one);
  Eigen::Matrix3Xd load = Eigen::Matrix3Xd::Zero(3, block.model.mesh().vertexCount());
  load.col(one.columns[0]) = Eigen::Vector3d(1, 2, 3);
  const ProbedField x = fieldUnder(*a->info().probes, 0, load),
                    y = fieldUnder(*b->info().probes, 0, load);
  EXPECT_LT((x.stress - y.stress).norm(), 1e-9 * x.stress.norm());
}

TEST(SolidProbes, ArePickedByTheirPlaces) {
  Eigen::Matrix3Xd points(3, 2);
  points << 0, 1, 0, 0, 0, 0;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(26, 3);
  rows.bottomRows(13).setOnes();
  const ProbeRows both(points, rows, {Matrix6d::Zero(), Matrix6d::Identity()});
  const ProbeRows second = both.at(Eigen::Vector3d(1, 1e-9, 0), 1e-6);
  EXPECT_EQ(second.count(), 1);
  EXPECT_EQ(second.rows(), rows.bottomRows(13));
  EXPECT_EQ(second.stiffness(0), Matrix6d::Identity());
  EXPECT_TRUE(
      isRefused([&] { both.at(Eigen::Vector3d(0.5, 0, 0), 1e-6); }, "no probe at (0.5, 0, 0)"));
}

}  // namespace
}  // namespace palpate::test
