// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Bodies that differ inside from what they are taken for, beyond what was expected: stiffness that
// is identified as a field, and compliances that are corrected.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "stability/hard_case.h"
#include "support/inclusions.h"

namespace palpate::test {
namespace {

using namespace inclusions;

HardCase hard(const std::string& name, const std::string& danger) {
  return {"identification", name, danger};
}

/// A table that is fitted, and other probes without noise.
struct Tables {
  Measurements fitted, others;

  Tables(const SolidProblem& truth, const RigSettings& rig) {
    const auto greens = truth.greens();
    fitted = measuredOn(greens, truth.model.mesh(), rig);
    others = measuredOn(greens, truth.model.mesh(), rigOf(20, 0, 77));
  }
};

StiffnessFieldOptions knownPoisson() {
  StiffnessFieldOptions options;
  options.poissonRatio = kPoisson;
  options.folds = 0;
  return options;
}

const FieldPrior& fieldPrior() {
  static const FieldPrior prior(4);
  return prior;
}

double uniformError(const Measurements& m) {
  return fieldPrior().errorOf(Eigen::VectorXd::Constant(fieldPrior().mesh.cellCount(), kYoung),
                              kPoisson, m);
}

TEST(HardFields, FarBeyondWhatWasExpected) {
  for (double factor : {1e-3, 1e3}) {
    const Tables tables(cubeWithBall(5, factor), rigOf(15, 0.01));
    StiffnessFieldOptions options = knownPoisson();
    options.deviation = 1;
    const StiffnessField found = fieldPrior().identified(tables.fitted, options, 30);
    const HardCase here = hard(
        "a field where a ball is a thousand times " + std::string(factor < 1 ? "softer" : "harder"),
        "moduli below 0, or that overflow");
    here.expectAtLeast("least modulus, over the cube's", found.modulus.minCoeff() / kYoung, 1e-6);
    here.expectAtMost("largest modulus, over the cube's", found.modulus.maxCoeff() / kYoung, 1e6);
    here.expectAtMost(
        "error at other probes, over that of one stiffness",
        fieldPrior().errorOf(found.modulus, kPoisson, tables.others) / uniformError(tables.others),
        0.8);
    here.expectSaid(found.fit.warnings.empty() ? "" : found.fit.warnings.back(),
                    "times the standard deviation that was expected");
  }
}

TEST(HardFields, WhatNoProbeTells) {
  const Tables tables(cubeWithBall(5, 0.1), rigOf(1, 0.01));
  const StiffnessField found = fieldPrior().identified(tables.fitted, knownPoisson(), 30);
  const HardCase here = hard("a field by one probe", "a guess far from the probe told as known");
  double square = 0;
  const Eigen::Matrix3Xd centres = centresOf(fieldPrior().mesh);
  for (Eigen::Index c = 0; c < centres.cols(); ++c) {
    const bool isBall = (centres.col(c) - kBall).norm() < 0.37;
    const double wrong = std::log(found.modulus[c] / (kYoung * (isBall ? 0.1 : 1)));
    square += std::pow(wrong / found.deviation[c], 2) / double(centres.cols());
  }
  here.expectAtLeast("largest deviation of ln E that is left, of 1 expected",
                     found.deviation.maxCoeff(), 0.4);
  here.expectAtMost("errors of ln E over their deviations, mean square's root", std::sqrt(square),
                    3);
}

TEST(HardFields, ExactData) {
  const SolidProblem truth = cubeWithBall(4, 1);
  const auto greens = truth.greens();
  const Measurements exact = measuredOn(greens, truth.model.mesh(), rigOf(10, 0));
  const StiffnessField found = fieldPrior().identified(exact, knownPoisson(), 30);
  hard("a field of displacements without noise on a body of one stiffness",
       "division by a noise of zero")
      .expectAtMost("largest relative error of the modulus",
                    (found.modulus.array() / kYoung - 1).abs().maxCoeff(), 1e-3);
}

TEST(HardFields, WrongRows) {
  RigSettings rig = rigOf(20, 0.01);
  rig.outliers = 0.05;
  const SolidProblem truth = cubeWithBall(5, 0.1);
  const Tables sound(truth, rigOf(20, 0.01)), wrong(truth, rig);
  const auto errorOf = [&](const Measurements& m) {
    return fieldPrior().errorOf(fieldPrior().identified(m, knownPoisson(), 30).modulus, kPoisson,
                                sound.others);
  };
  hard("a field of a table 5 % of which is wrong", "wrong rows explained by lumps inside")
      .expectAtMost("error at other probes, over that without",
                    errorOf(wrong.fitted) / errorOf(sound.fitted), 1.2);
}

TEST(HardFields, NothingMoved) {
  Measurements still =
      measuredOn(cubeWithBall(4, 1).greens(), fieldPrior().model.mesh(), rigOf(5, 0.01));
  for (MeasuredDisplacement& measured : still.displacements) measured.displacement.setZero();
  hard("a field where nothing moved", "an infinite stiffness")
      .expectRefused([&] { fieldPrior().identified(still, knownPoisson(), 10); }, "nothing moved");
}

const CorrectionPrior& correctionPrior() {
  static const CorrectionPrior prior(4);
  return prior;
}

/// Least eigenvalue of the compliance between free nodes over the largest.
double definiteness(const GreensFunctions& greens) {
  const std::vector<int> free = greens.info().conditions.freeNodes();
  Eigen::MatrixXd compliance(3 * free.size(), 3 * free.size());
  greens.gather(nodeList(free), nodeList(free), compliance.data());
  for (std::size_t j = 0; j < free.size(); ++j)
    compliance.middleCols<3>(3 * j) /= greens.vertexArea(free[j]);
  const Eigen::VectorXd values = compliance.selfadjointView<Eigen::Lower>().eigenvalues();
  return values.minCoeff() / values.maxCoeff();
}

TEST(HardCorrections, FarFromThePrior) {
  for (double factor : {1e-3, 1e3}) {
    const Tables tables(cubeWithBall(5, factor), rigOf(25, 0.01));
    CorrectedGreensFunctions found = correctionPrior().corrected(tables.fitted);
    const auto greens = found.greens.take();
    const HardCase here = hard("a correction where a ball is a thousand times " +
                                   std::string(factor < 1 ? "softer" : "harder"),
                               "a compliance that is not definite");
    here.expectAtLeast("least eigenvalue over the largest", definiteness(*greens), 1e-9);
    here.expectAtMost("error at other probes, over the prior's",
                      correctionPrior().errorOf(*greens, tables.others) /
                          correctionPrior().errorOf(*correctionPrior().greens, tables.others),
                      0.8);
  }
}

TEST(HardCorrections, MostlyNoise) {
  const Tables tables(cubeWithBall(5, 10), rigOf(10, 0.5));
  CorrectedGreensFunctions found = correctionPrior().corrected(tables.fitted);
  const auto greens = found.greens.take();
  const HardCase here =
      hard("a correction by displacements with 50 % noise", "noise taken for stiffness");
  here.expectAtLeast("least eigenvalue over the largest", definiteness(*greens), 1e-9);
  here.expectAtMost("error at other probes, over the prior's",
                    correctionPrior().errorOf(*greens, tables.others) /
                        correctionPrior().errorOf(*correctionPrior().greens, tables.others),
                    1.1);
}

TEST(HardCorrections, ProbesOfTheWrongSign) {
  const Measurements sound = Tables(cubeWithBall(5, 10), rigOf(10, 0.01)).fitted;
  const auto turned = [&](int every) {
    Measurements m = sound;
    for (MeasuredDisplacement& measured : m.displacements)
      if (measured.probe % every == 0) measured.displacement = -measured.displacement;
    return m;
  };
  CorrectedGreensFunctions found = correctionPrior().corrected(turned(10));
  hard("a correction where one of ten probes has the wrong sign", "work taken out of the body")
      .expectAtLeast("least eigenvalue over the largest", definiteness(*found.greens.take()), 1e-9);
  hard("a correction where four of ten have", "work taken out of the body")
      .expectRefused([&] { correctionPrior().corrected(turned(3)); },
                     "check the signs of the forces");
}

TEST(HardCorrections, OneMarkerOfOneProbe) {
  Measurements few =
      measuredOn(cubeWithBall(5, 10).greens(), cubeWithBall(5, 1).model.mesh(), rigOf(2, 0.01));
  few.displacements.resize(2);
  CorrectionOptions given;
  given.smoothing = 1e-2;
  given.folds = 0;
  CorrectedGreensFunctions found = correctionPrior().corrected(few, given);
  hard("a correction by two displacements", "a stiffness that the rest of the body does not have")
      .expectAtLeast("least eigenvalue over the largest", definiteness(*found.greens.take()), 1e-9);
}

TEST(HardCorrections, IncompressiblePrior) {
  const CorrectionPrior prior(4, 0.5);
  const Tables tables(cubeWithBall(5, 10, 0.45), rigOf(25, 0.01));
  CorrectedGreensFunctions found = prior.corrected(tables.fitted);
  hard("a correction of an incompressible prior, ν = 0.5 for 0.45 and a ball ten times harder",
       "volume that the prior forbids to change")
      .expectAtMost("error at other probes, over the prior's",
                    prior.errorOf(*found.greens.take(), tables.others) /
                        prior.errorOf(*prior.greens, tables.others),
                    0.5);
}

}  // namespace
}  // namespace palpate::test
