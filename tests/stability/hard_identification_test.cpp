// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Tables that do not tell what they are asked for, or tell it wrongly.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "identification/registration.h"
#include "linear_algebra/sparse_factorization.h"
#include "stability/hard_case.h"
#include "support/refusals.h"
#include "support/rigs.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

constexpr double kYoung = 2e4, kPoisson = 0.42;

HardCase hard(const std::string& name, const std::string& danger) {
  return {"identification", name, danger};
}

/// A sphere of 162 vertices held below, and what a rig measures of it.
struct Body {
  ElasticModel model = makeModel(icosphere(2), cap, kYoung, kPoisson);
  std::shared_ptr<const GreensFunctions> greens = computeGreens(model, {});

  Measurements measured(int probes, int markers, double tilt = 45) const {
    RigSettings rig;
    rig.radius = 0.4;
    rig.probes = probes;
    rig.markers = markers;
    rig.tilt = tilt;
    return measuredOn(greens, model.mesh(), rig);
  }
  MaterialIdentification identify(const Measurements& m, IdentificationOptions options = {}) const {
    return identifierOn(model, m, options).identify(m);
  }
};

double errorOf(const MaterialIdentification& result) {
  return std::abs(result.materials[0].youngsModulus() / kYoung - 1);
}

/// The displacement under each probe of its own contact, 3 % noise.
Measurements ofContactsAlone(const Body& body, int probes) {
  Measurements m = body.measured(probes, 1, 0);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (std::size_t p = 0; p < m.probes.size(); ++p) m.displacements[p].marker = m.probes[p].contact;
  const MaterialIdentifier identifier = identifierOn(body.model, m);
  const Eigen::Matrix3Xd exact = identifier.predict(Eigen::Vector2d(kYoung, kPoisson), m);
  for (std::size_t p = 0; p < m.probes.size(); ++p) {
    m.displacements[p].deviation.setConstant(0.03 * exact.col(p).norm());
    for (int c = 0; c < 3; ++c)
      m.displacements[p].displacement[c] =
          exact(c, p) + m.displacements[p].deviation[c] * normal(random);
  }
  return m;
}

TEST(HardIdentification, NormalPokesAlone) {
  const Body body;
  const HardCase here = hard("one normal poke that sees itself alone, 3 % noise",
                             "E and ν that cannot be told apart, given with confidence");
  const Measurements m = ofContactsAlone(body, 1);
  const std::string sentence = refusal([&] { body.identify(m); });
  here.expectSaid(sentence, "the data cannot tell Poisson's ratio");
  here.expectSaid(sentence, "a tangential force of");
  IdentificationOptions held;
  held.unknowns.poisson = false;
  held.unknowns.poissonRatio = kPoisson;
  here.expectAtMost("error of E where ν is held", errorOf(body.identify(m, held)), 0.1);
}

TEST(HardIdentification, AllProbesAtOnePlace) {
  const Body body;
  const HardCase here =
      hard("five probes at one place, 50 markers, 1 % noise", "repetition taken for information");
  Measurements m = body.measured(5, 50);
  const Measurements apart = m;
  for (Probe& probe : m.probes) probe.contact = m.probes[0].contact;
  const MaterialIdentifier identifier = identifierOn(body.model, m);
  const Eigen::Matrix3Xd exact = identifier.predict(Eigen::Vector2d(kYoung, kPoisson), m),
                         there = identifierOn(body.model, apart)
                                     .predict(Eigen::Vector2d(kYoung, kPoisson), apart);
  for (std::size_t i = 0; i < m.displacements.size(); ++i)  // the same noise on other displacements
    m.displacements[i].displacement += exact.col(i) - there.col(i);
  const MaterialIdentification result = identifier.identify(m);
  here.expectAtMost("error of E", errorOf(result), 0.03);
  here.expectAtMost("error of E in its standard deviations",
                    errorOf(result) * kYoung / result.parameters[0].deviation, 3.5);
}

TEST(HardIdentification, ManyOutliers) {
  const Body body;
  Measurements m = body.measured(5, 50);
  double largest = 0;
  for (const MeasuredDisplacement& u : m.displacements)
    largest = std::max(largest, u.displacement.cwiseAbs().maxCoeff());
  std::mt19937 random(3);
  for (MeasuredDisplacement& u : m.displacements)
    if (random() % 10 < 3) u.displacement += largest * Eigen::Vector3d(1, 1, -1);
  const MaterialIdentification result = body.identify(m);
  const HardCase here = hard("30 % of the displacements wrong, all to one side",
                             "a fit between two truths, said to be good");
  here.expectAtMost("error of E", errorOf(result), 0.02);
  here.expectSaid(result.warnings.empty() ? "" : result.warnings.back(), "contradict the rest");
}

/// Displacements from the largest on.
std::vector<int> bySize(const Measurements& m) {
  std::vector<int> order(m.displacements.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return m.displacements[i].displacement.norm() > m.displacements[j].displacement.norm();
  });
  return order;
}

TEST(HardIdentification, TheLargestDisplacementsAreWrong) {
  const Body body;
  const Measurements sound = body.measured(5, 50);
  const std::vector<int> order = bySize(sound);
  const auto errorWith = [&](int count, double factor) {
    Measurements m = sound;
    for (int i = 0; i < count; ++i) m.displacements[order[i]].displacement *= factor;
    return errorOf(body.identify(m));
  };
  hard("the largest displacement of 250 times -40", "a refusal for the forces' sign")
      .expectAtMost("error of E", errorWith(1, -40), 0.02);
  hard("the largest 5 % of the displacements times -5", "a refusal for the forces' sign")
      .expectAtMost("error of E", errorWith(12, -5), 0.02);
}

TEST(HardIdentification, RowsOfOtherProbesAndMarkers) {
  const Body body;
  Measurements m = body.measured(5, 50);
  std::mt19937 random(4);
  for (std::size_t i = m.displacements.size() - 1; i > 0; --i)
    std::swap(m.displacements[i].displacement, m.displacements[random() % (i + 1)].displacement);
  hard("displacements shuffled over the rows", "a modulus with a deviation")
      .expectSaid(refusal([&] { body.identify(m); }), "check which rows are of which probe");
}

TEST(HardIdentification, NearlyIncompressible) {
  const ElasticModel model = makeModel(icosphere(2), cap, kYoung, 0.499);
  RigSettings rig;
  rig.radius = 0.4;
  const Measurements m = measuredOn(computeGreens(model, {}), model.mesh(), rig);
  const HardCase here =
      hard("ν = 0.499, looked for up to 0.499 and up to 0.45", "a bound taken for an estimate");
  const MaterialIdentification free = identifierOn(model, m).identify(m);
  here.expectAtMost("error of E", errorOf(free), 0.02);
  here.expectAtMost("error of ν", std::abs(free.materials[0].poissonRatio() - 0.499), 0.02);
  IdentificationOptions narrow;
  narrow.unknowns.poissonUpper = 0.45;
  const MaterialIdentification bound = identifierOn(model, m, narrow).identify(m);
  here.expectSaid(bound.warnings.empty() ? "" : bound.warnings.front(),
                  "Poisson's ratio is at the bound 0.45");
}

TEST(HardIdentification, WrongUnitsAndSigns) {
  const Body body;
  const Measurements m = body.measured(5, 50);
  Measurements other = m;
  for (Probe& probe : other.probes) probe.contact.point *= 1000;
  for (MeasuredDisplacement& u : other.displacements) {
    u.marker.point *= 1000;
    u.displacement *= 1000;
  }
  hard("a table in millimetres read as metres", "a material a million times too soft")
      .expectSaid(refusal([&] { body.identify(other); }), "times 0.001 it would be on it");
  other = m;
  for (Probe& probe : other.probes) probe.force *= 1e-6;
  const MaterialIdentification soft = body.identify(other);
  hard("forces in meganewtons read as newtons", "a material that none is like")
      .expectSaid(soft.warnings.empty() ? "" : soft.warnings.front(), "is no material's");
  other = m;
  for (Probe& probe : other.probes) probe.force *= -1;
  hard("forces on the probe, not on the body", "a negative modulus")
      .expectSaid(refusal([&] { body.identify(other); }), "against the forces");
}

TEST(HardIdentification, TooLittle) {
  const Body body;
  Measurements m = body.measured(1, 1);
  m.displacements[0].displacement.tail<2>().setConstant(std::nan(""));
  hard("one component of one displacement", "two unknowns from one number")
      .expectSaid(refusal([&] { body.identify(m); }),
                  "1 measured components without outliers for 2 unknowns");
}

/// A block whose farther half is another region, of cubes of tetrahedra.
SolidProblem twoRegions(const Eigen::Vector3i& cubes, double near, double far) {
  const TetrahedralMesh mesh = kuhnBox({0.08, 0.06, 0.04}, cubes).mesh();
  std::vector<int> regions;
  for (const auto& cell : mesh.tetrahedra().colwise())
    regions.push_back(mesh.points()(Eigen::all, cell).row(0).mean() > 0.04);
  const ElasticModel model = makeModel(
      boundaryOf(mesh), [](const Eigen::Vector3d& x) { return x.z() < 1e-9; }, 1, 0.35);
  return {model,
          SolidBody(model.mesh(), mesh,
                    {Elasticity(Material(near, 0.35)), Elasticity(Material(far, 0.35))}, regions)};
}

// Refining the mesh is the cure: what matters is that deviations are not taken for the error.
TEST(HardIdentification, AMeshTooCoarseForTwoRegions) {
  if (!SparseFactorization::isAvailable()) GTEST_SKIP() << "no MUMPS";
  const HardCase here = hard("two regions on a block of 6x4x3 cubes, measured on 10x7x5",
                             "deviations of noise alone where the mesh errs by five of them");
  const SolidProblem truth = twoRegions({10, 7, 5}, 8e3, 3e4);
  RigSettings rig;
  rig.seed = 3;
  rig.radius = 0.021;
  const Measurements m = measuredOn(truth.greens(), truth.model.mesh(), rig);
  const ElasticModel model = twoRegions({6, 4, 3}, 1, 1).model;
  const RigSetup setup = setupOn(model, m);
  IdentificationOptions options;
  options.unknowns.regions = 2;
  options.unknowns.poisson = false;
  options.unknowns.poissonRatio = 0.35;
  options.interpolationTolerance = 1e-3;
  const auto responseOf = [&](const std::vector<Material>& materials, const Progress&) {
    const auto greens =
        twoRegions({6, 4, 3}, materials[0].youngsModulus(), materials[1].youngsModulus()).greens();
    return MeasuredResponse(*greens, setup.setup, false);
  };
  const MaterialIdentification result =
      MaterialIdentifier(responseOf, setup.setup, model.mesh().diagonal(), setup.normals, options)
          .identify(m);
  const IdentifiedParameter& modulus = result.parameters[0];
  here.expectAtLeast("error of E in its standard deviations",
                     std::abs(modulus.value - 8e3) / modulus.deviation, 5);
  here.expectSaid(result.warnings.empty() ? "" : result.warnings.back(),
                  "residuals of neighbouring markers go together");
  here.expectAtLeast("deviation by probes left out over that of noise",
                     modulus.probewiseDeviation / modulus.deviation, 1.5);
}

TEST(HardIdentification, FramesThatAreNotTold) {
  const Body body;
  const Measurements m = body.measured(5, 50);
  hard("registration to a ball", "a frame turned by any angle")
      .expectSaid(refusal([&] { registerToSurface(body.model.mesh(), m); }),
                  "do not tell the rotation about");
  Measurements line = m;
  for (std::size_t i = 0; i < line.displacements.size(); ++i)
    line.displacements[i].marker.point = {0, 1e-3 * double(i), 1};
  for (Probe& probe : line.probes) probe.contact.point = {0, 0, 1};
  hard("registration by markers on a line", "a frame turned by any angle")
      .expectSaid(refusal([&] { registerToSurface(body.model.mesh(), line); }), "do not tell the");
}

}  // namespace
}  // namespace palpate::test
