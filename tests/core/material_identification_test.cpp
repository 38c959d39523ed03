// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/material_identification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "linear_algebra/sparse_factorization.h"
#include "support/refusals.h"
#include "support/rigs.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

constexpr double kYoung = 2e4, kPoisson = 0.42;

bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

RigSettings rigOf(double radius) {
  RigSettings rig;
  rig.radius = radius;
  return rig;
}

/// A sphere whose measurements come from the responses that it is identified by, so that the
/// statistics of estimates are seen, not the discretisation.
struct Sphere {
  ElasticModel model = makeModel(icosphere(2), cap, kYoung, kPoisson);
  std::shared_ptr<const GreensFunctions> greens = computeGreens(model, {});
  Measurements measurements;

  explicit Sphere(const RigSettings& rig) : measurements(measuredOn(greens, model.mesh(), rig)) {}
};

double deviationsOff(const IdentifiedParameter& p, double truth) {
  return std::abs(p.value - truth) / p.deviation;
}

TEST(MaterialIdentification, ExactDataGiveTheMaterialBack) {
  RigSettings rig = rigOf(0.4);
  rig.noise = 0;
  const Sphere sphere(rig);
  IdentificationOptions options;
  options.interpolationTolerance = 1e-7;
  const auto result =
      identifierOn(sphere.model, sphere.measurements, options).identify(sphere.measurements);
  EXPECT_NEAR(result.materials[0].youngsModulus() / kYoung, 1, 1e-6);
  EXPECT_NEAR(result.materials[0].poissonRatio(), kPoisson, 1e-6);
  EXPECT_LE(result.holdOutError, 1e-6);
  EXPECT_TRUE(result.warnings.empty());
}

// A rig of quadratic tetrahedra, identified by boundary elements: another method and mesh. What
// they differ by is most of E's error.
TEST(MaterialIdentification, AnotherDiscretisationsCubeIsFoundWithinAPercent) {
  if (!SparseFactorization::isAvailable()) GTEST_SKIP() << "no MUMPS";
  const SolidProblem truth =
      solidProblem(kuhnBox({1, 1, 1}, {9, 9, 9}).mesh(), base, kYoung, kPoisson);
  const auto greens = truth.greens();
  const ElasticModel model = makeModel(box({1, 1, 1}, {10, 10, 10}), base, 1, 0.3);
  std::map<double, std::shared_ptr<const GreensFunctions>> computed;  // by Poisson's ratio
  const auto greensOf = [&](const Material& material) {
    auto& kept = computed[material.poissonRatio()];
    if (!kept)
      kept = computeGreens(
          ElasticModel(model.sharedMesh(), material, model.conditions(), model.smoothPatches()),
          {});
    return kept;
  };
  for (unsigned seed : {1, 2, 3}) {
    RigSettings rig = rigOf(0.3);
    rig.seed = seed;
    const Measurements m = measuredOn(greens, truth.model.mesh(), rig);
    const RigSetup setup = setupOn(model, m);
    const MaterialIdentifier identifier(
        [&](const std::vector<Material>& materials, const Progress&) {
          return MeasuredResponse(*greensOf(materials.front()), setup.setup, false);
        },
        setup.setup, model.mesh().diagonal(), setup.normals, {});
    const auto result = identifier.identify(m);
    EXPECT_NEAR(result.materials[0].youngsModulus() / kYoung, 1, 0.01) << seed;
    EXPECT_NEAR(result.materials[0].poissonRatio(), kPoisson, 0.02) << seed;
    EXPECT_EQ(result.probes.size(), 5u);
    EXPECT_GT(result.holdOutError, 0);
  }
}

/// A cube whose upper half has another Young's modulus.
SolidProblem halves(int divisions, double lower, double upper) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {divisions, divisions, divisions}).mesh();
  std::vector<int> regions;
  for (const auto& cell : mesh.tetrahedra().colwise())
    regions.push_back(mesh.points()(Eigen::all, cell).row(2).mean() > 0.5);
  const ElasticModel model = makeModel(boundaryOf(mesh), base, 1, kPoisson);
  return SolidProblem{model, SolidBody(model.mesh(), mesh,
                                       {Elasticity(Material(lower, kPoisson)),
                                        Elasticity(Material(upper, kPoisson))},
                                       regions)};
}

TEST(MaterialIdentification, TwoRegionsAreFoundWithinFivePercent) {
  if (!SparseFactorization::isAvailable()) GTEST_SKIP() << "no MUMPS";
  constexpr double kUpper = 5e4;
  const SolidProblem truth = halves(8, kYoung, kUpper);
  const Measurements m = measuredOn(truth.greens(), truth.model.mesh(), rigOf(0.3));
  const ElasticModel model = halves(6, 1, 1).model;
  const RigSetup rig = setupOn(model, m);
  IdentificationOptions options;
  options.unknowns.regions = 2;
  options.unknowns.poisson = false;
  options.unknowns.poissonRatio = kPoisson;
  options.interpolationTolerance = 1e-3;
  const auto responseOf = [&](const std::vector<Material>& materials, const Progress&) {
    const auto greens =
        halves(6, materials[0].youngsModulus(), materials[1].youngsModulus()).greens();
    return MeasuredResponse(*greens, rig.setup, false);
  };
  const auto result =
      MaterialIdentifier(responseOf, rig.setup, std::sqrt(3.0), rig.normals, options).identify(m);
  ASSERT_EQ(result.materials.size(), 2u);
  EXPECT_NEAR(result.materials[0].youngsModulus() / kYoung, 1, 0.05);
  EXPECT_NEAR(result.materials[1].youngsModulus() / kUpper, 1, 0.05);
  EXPECT_EQ(result.parameters[1].name, "Young's modulus of region 1");
}

/// How many of 200 sets of noise have the truth within their interval of 95 %.
void requireCoverage(bool withDeviations) {
  RigSettings rig = rigOf(0.5);
  rig.noise = 0;
  rig.markers = 15;
  const Sphere sphere(rig);
  IdentificationOptions options;
  options.folds = 0;
  const MaterialIdentifier identifier = identifierOn(sphere.model, sphere.measurements, options);
  const Eigen::Vector2d truth(kYoung, kPoisson);
  const Eigen::Matrix3Xd exact = identifier.predict(truth, sphere.measurements);
  const double noise = 0.01 * exact.cwiseAbs().maxCoeff();
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, noise);
  int covered[2] = {0, 0};
  constexpr int kSets = 200;
  for (int set = 0; set < kSets; ++set) {
    Measurements m = sphere.measurements;
    for (std::size_t i = 0; i < m.displacements.size(); ++i) {
      for (int c = 0; c < 3; ++c) m.displacements[i].displacement[c] = exact(c, i) + normal(random);
      m.displacements[i].deviation.setConstant(withDeviations ? noise : 0);
    }
    const auto result = identifier.identify(m);
    for (int i = 0; i < 2; ++i)
      covered[i] +=
          truth[i] >= result.parameters[i].lower && truth[i] <= result.parameters[i].upper;
  }
  for (int count : covered) {
    EXPECT_GE(count, 0.90 * kSets);
    EXPECT_LE(count, 0.99 * kSets);
  }
}

TEST(MaterialIdentification, IntervalsOf95PercentHoldTheTruthAsOften) {
  requireCoverage(false);
}

TEST(MaterialIdentification, SoTheyDoWhereTheNoiseIsGiven) {
  requireCoverage(true);
}

TEST(MaterialIdentification, GrossOutliersAreNamedAndChangeLess) {
  RigSettings rig = rigOf(0.4);
  const Sphere clean(rig);
  const MaterialIdentifier identifier = identifierOn(clean.model, clean.measurements);
  const auto without = identifier.identify(clean.measurements);
  Measurements m = clean.measurements;
  double largest = 0;
  for (const MeasuredDisplacement& u : m.displacements)
    largest = std::max(largest, u.displacement.cwiseAbs().maxCoeff());
  std::mt19937 random(3);
  std::vector<int> wrong;
  for (std::size_t i = 0; i < m.displacements.size(); ++i)
    if (random() % 20 == 0) {
      wrong.push_back(static_cast<int>(i));
      m.displacements[i].displacement +=
          largest * (1 + random() % 3) * Eigen::Vector3d(1, -1, 0.5 * (random() % 3));
    }
  ASSERT_GT(wrong.size(), 8u);
  for (RobustLoss loss : {RobustLoss::Huber, RobustLoss::Cauchy}) {
    IdentificationOptions options;
    options.loss = loss;
    const auto result = identifierOn(clean.model, m, options).identify(m);
    EXPECT_TRUE(
        std::includes(result.outliers.begin(), result.outliers.end(), wrong.begin(), wrong.end()));
    EXPECT_LE(result.outliers.size(), wrong.size() + 2);
    for (int i = 0; i < 2; ++i)
      EXPECT_LT(deviationsOff(result.parameters[i], without.parameters[i].value), 1) << i;
  }
  IdentificationOptions plain;
  plain.loss = RobustLoss::None;
  plain.unknowns.poisson = false;  // which such data would not tell
  plain.unknowns.poissonRatio = kPoisson;
  const auto spoilt = identifierOn(clean.model, m, plain).identify(m);
  EXPECT_GT(std::abs(spoilt.materials[0].youngsModulus() / kYoung - 1), 0.02)
      << "else outliers would not matter";
}

TEST(MaterialIdentification, AYieldingSupportIsFoundWithTheMaterial) {
  ElasticModel model = makeModel(icosphere(2), cap, kYoung, kPoisson);
  BoundaryElementOptions how;
  how.columns = allNodes(model);
  const auto greens = computeGreens(model, how);
  IdentificationOptions options;
  options.unknowns.support = true;
  for (double length : {0.0, 0.2}) {
    RigSettings rig = rigOf(0.4);
    rig.foundationLength = length;
    const Measurements m = measuredOn(greens, model.mesh(), rig);
    const auto result = identifierOn(model, m, options).identify(m);
    ASSERT_EQ(result.parameters.size(), 3u);
    EXPECT_LE(deviationsOff(result.parameters[0], kYoung), 3.5) << length;
    EXPECT_LE(deviationsOff(result.parameters[2], length), 3.5) << length;
    EXPECT_LE(result.parameters[2].deviation, 0.02);
    if (length == 0) continue;
    // Taken for firm it would make the body soft.
    const auto firm = identifierOn(model, m).identify(m);
    EXPECT_GT(deviationsOff(firm.parameters[0], kYoung), 5);
  }
}

TEST(MaterialIdentification, WhatNoiseIsUnderratedByIsSaid) {
  RigSettings rig = rigOf(0.4);
  rig.withDeviations = true;
  const Sphere sphere(rig);
  const MaterialIdentifier identifier = identifierOn(sphere.model, sphere.measurements);
  const auto fair = identifier.identify(sphere.measurements);
  EXPECT_NEAR(fair.misfit, 1, 0.1);
  EXPECT_TRUE(fair.warnings.empty());
  Measurements m = sphere.measurements;
  for (MeasuredDisplacement& u : m.displacements) u.deviation /= 3;
  const auto proud = identifier.identify(m);
  EXPECT_NEAR(proud.misfit, 3, 0.3);
  ASSERT_FALSE(proud.warnings.empty());
  EXPECT_TRUE(contains(proud.warnings[0], "times the standard deviations given"));
  EXPECT_NEAR(proud.parameters[0].deviation / fair.parameters[0].deviation, 1, 0.2);
}

/// Measurements of the probes' own places alone, which are pushed along their normals, as an
/// indenter makes them; with noise of 3 % each.
Measurements asAnIndenterSees(const Sphere& sphere) {
  Measurements m = sphere.measurements;
  m.displacements.clear();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const RigSetup rig = setupOn(sphere.model, sphere.measurements);
  for (std::size_t p = 0; p < m.probes.size(); ++p) {
    m.probes[p].force = -rig.normals[p];
    MeasuredDisplacement u;
    u.probe = static_cast<int>(p);
    u.marker = m.probes[p].contact;
    u.row = static_cast<int>(p) + 2;
    m.displacements.push_back(u);
  }
  const MaterialIdentifier identifier = identifierOn(sphere.model, m);
  const Eigen::Matrix3Xd exact = identifier.predict(Eigen::Vector2d(kYoung, kPoisson), m);
  for (std::size_t p = 0; p < m.probes.size(); ++p) {
    const double noise = 0.03 * exact.col(p).norm();
    for (int c = 0; c < 3; ++c)
      m.displacements[p].displacement[c] = exact(c, p) + noise * normal(random);
    m.displacements[p].deviation.setConstant(noise);
  }
  return m;
}

TEST(MaterialIdentification, WhatTheDataCannotSeeIsNamedWithWhatWouldHelp) {
  RigSettings rig = rigOf(0.5);
  rig.probes = 1;
  const Sphere sphere(rig);
  const Measurements m = asAnIndenterSees(sphere);
  const std::string sentence = refusal([&] { identifierOn(sphere.model, m).identify(m); });
  EXPECT_TRUE(contains(sentence, "the data cannot tell Poisson's ratio"));
  EXPECT_TRUE(contains(sentence, "all probes push along the normal"));
  EXPECT_TRUE(contains(sentence, "a tangential force of"));
  IdentificationOptions held;
  held.unknowns.poisson = false;
  held.unknowns.poissonRatio = kPoisson;
  const auto result = identifierOn(sphere.model, m, held).identify(m);
  EXPECT_LE(deviationsOff(result.parameters[0], kYoung), 3.5);
}

TEST(MaterialIdentification, HardTablesAreRefusedWithSentences) {
  const Sphere sphere(rigOf(0.4));
  const MaterialIdentifier identifier = identifierOn(sphere.model, sphere.measurements);
  Measurements m = sphere.measurements;
  for (Probe& probe : m.probes) probe.force *= -1;
  EXPECT_TRUE(isRefused([&] { identifier.identify(m); }, "displacements are against the forces"));
  m = sphere.measurements;
  m.displacements.pop_back();
  EXPECT_TRUE(isRefused([&] { identifier.identify(m); }, "not those that the responses were"));
  m = sphere.measurements;
  m.displacements.resize(1);
  m.probes.resize(1);
  for (int c = 1; c < 3; ++c) m.displacements[0].displacement[c] = std::nan("");
  const MaterialIdentifier little = identifierOn(sphere.model, m);
  EXPECT_TRUE(isRefused([&] { little.identify(m); },
                        "there are 1 measured components without outliers for 2 unknowns"));
}

TEST(MaterialIdentification, AModulusThatNoMaterialHasTellsOfUnits) {
  const Sphere sphere(rigOf(0.4));
  Measurements m = sphere.measurements;
  for (Probe& probe : m.probes) probe.force *= 1e-6;
  const auto result = identifierOn(sphere.model, m).identify(m);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(contains(result.warnings[0], "is no material's: check the units"));
}

TEST(MaterialIdentification, WithoutALossDeviationsAreByWhatIsLeft) {
  const Sphere sphere(rigOf(0.4));
  IdentificationOptions plain;
  plain.loss = RobustLoss::None;
  const auto robust = identifierOn(sphere.model, sphere.measurements).identify(sphere.measurements),
             result = identifierOn(sphere.model, sphere.measurements, plain)
                          .identify(sphere.measurements);
  ASSERT_TRUE(robust.outliers.empty());
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(result.parameters[i].deviation / robust.parameters[i].deviation, 1, 1e-3) << i;
}

TEST(MaterialIdentification, ABoundIsSaidToBeOne) {
  const Sphere sphere(rigOf(0.4));
  IdentificationOptions options;
  options.unknowns.poissonUpper = 0.3;
  const auto result =
      identifierOn(sphere.model, sphere.measurements, options).identify(sphere.measurements);
  EXPECT_TRUE(result.parameters[1].isAtBound);
  EXPECT_DOUBLE_EQ(result.parameters[1].value, 0.3);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_TRUE(contains(result.warnings[0], "Poisson's ratio is at the bound 0.3"));
}

TEST(MaterialIdentification, IsAborted) {
  const Sphere sphere(rigOf(0.4));
  const MaterialIdentifier identifier = identifierOn(sphere.model, sphere.measurements);
  const Progress abort([](double, const char*) { return false; });
  EXPECT_THROW(identifier.identify(sphere.measurements, abort), Aborted);
}

}  // namespace
}  // namespace palpate::test
