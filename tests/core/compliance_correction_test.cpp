// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/compliance_correction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "support/inclusions.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using namespace inclusions;

Eigen::MatrixXd complianceOf(const GreensFunctions& greens) {
  const std::vector<int> free = greens.info().conditions.freeNodes();
  Eigen::MatrixXd result(3 * free.size(), 3 * free.size());
  greens.gather(nodeList(free), nodeList(free), result.data());
  for (std::size_t j = 0; j < free.size(); ++j)
    result.middleCols<3>(3 * j) /= greens.vertexArea(free[j]);
  return result;
}

/// A third of the free vertices are probed, each at 50 places of another mesh with 1 % noise.
class HiddenBall : public ::testing::TestWithParam<double> {};

TEST_P(HiddenBall, ProbesLeftOutArePredicted) {
  const SolidProblem truth = cubeWithBall(6, GetParam());
  const auto greens = truth.greens();
  const CorrectionPrior prior(5);
  const Measurements held = measuredOn(greens, truth.model.mesh(), rigOf(60, 0, 77));
  const int third = static_cast<int>(prior.problem.model.conditions().freeNodes().size()) / 3;
  CorrectedGreensFunctions found =
      prior.corrected(measuredOn(greens, truth.model.mesh(), rigOf(third, 0.01)));
  EXPECT_EQ(found.share, 1);
  EXPECT_LT(found.fit.holdOutError, found.priorHoldOutError);
  EXPECT_LT(found.fit.outliers.size(), 0.01 * 50 * third);
  const auto corrected = found.greens.take();
  EXPECT_GT(prior.errorOf(*prior.greens, held), 0.2);
  EXPECT_LE(prior.errorOf(*corrected, held), 0.05);
  // Reciprocal and positive definite.
  const Eigen::MatrixXd compliance = complianceOf(*corrected);
  EXPECT_LE((compliance - compliance.transpose()).norm(), 1e-12 * compliance.norm());
  EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(compliance).info(), Eigen::Success);
  // Reactions bear the forces.
  const std::vector<int> fixed = corrected->info().conditions.fixedNodes();
  const int node = corrected->info().conditions.freeNodes().back();
  Eigen::MatrixXd reactions(3 * fixed.size(), 3);
  corrected->gather(nodeList(fixed), nodeList({node}), reactions.data());
  Eigen::Matrix3d sum = corrected->vertexArea(node) * Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < fixed.size(); ++i)
    sum += corrected->vertexArea(fixed[i]) * reactions.middleRows<3>(3 * i);
  EXPECT_LE(sum.norm(), 1e-9 * corrected->vertexArea(node));
}

INSTANTIATE_TEST_SUITE_P(Factors, HiddenBall, ::testing::Values(0.1, 10));

// Exact data of a body like the prior but for its modulus: a factor, and nothing to correct.
TEST(ComplianceCorrection, AFactorIsFound) {
  const CorrectionPrior prior(4);
  const auto softer =
      prior.greens->withYoungsModulus(prior.greens->info().material.youngsModulus() / 3);
  const Measurements m = measuredOn(softer, prior.problem.model.mesh(), rigOf(6, 0));
  CorrectedGreensFunctions found = prior.corrected(m);
  EXPECT_NEAR(found.fit.parameters[0].value, 3, 1e-9);
  EXPECT_TRUE(found.fit.outliers.empty());
  EXPECT_LE(prior.errorOf(*found.greens.take(), m), 1e-9);
}

// What moves most at the markers, such as how the support yields, is the correction's, and draws
// the prior's factor less away from what holds near the contacts: by itself it would be 1.29.
TEST(ComplianceCorrection, TheFactorIsNotOfASupportThatYields) {
  const CorrectionPrior prior(4);
  const auto greens = prior.problem.greens(allColumns(prior.problem.model));
  RigSettings rig = rigOf(20, 0.01);
  rig.foundationLength = 0.3 / kYoung;  // of the model whose modulus is 1
  const Measurements m = measuredOn(greens, prior.problem.model.mesh(), rig);
  const CorrectedGreensFunctions found = prior.corrected(m);
  EXPECT_NEAR(found.fit.parameters[0].value, 1, 0.2);
}

// A correction that follows its noise leaves residuals far below it: no reason to leave any out.
TEST(ComplianceCorrection, SoundDisplacementsAreNotLeftOut) {
  const SolidProblem truth = cubeWithBall(5, 1, 0.45);
  const CorrectionPrior prior(4, -0.3);
  for (unsigned seed : {1, 2, 3}) {
    const Measurements m = measuredOn(truth.greens(), truth.model.mesh(), rigOf(20, 0.01, seed));
    const CorrectedGreensFunctions found = prior.corrected(m);
    EXPECT_LE(found.fit.outliers.size(), 0.01 * m.displacements.size());
  }
}

// 5 % of the displacements are wrong by as much as the largest: they are found, and the correction
// is nearly as good as without them.
TEST(ComplianceCorrection, OutliersTakeNothingFromTheCorrection) {
  const SolidProblem truth = cubeWithBall(5, 10);
  const auto greens = truth.greens();
  const CorrectionPrior prior(4);
  const Measurements held = measuredOn(greens, truth.model.mesh(), rigOf(20, 0, 77));
  RigSettings rig = rigOf(25, 0.01);
  CorrectedGreensFunctions sound = prior.corrected(measuredOn(greens, truth.model.mesh(), rig));
  rig.outliers = 0.05;
  CorrectedGreensFunctions found = prior.corrected(measuredOn(greens, truth.model.mesh(), rig));
  EXPECT_GE(found.fit.outliers.size(), 0.05 * 25 * rig.markers);
  EXPECT_LE(prior.errorOf(*found.greens.take(), held),
            1.1 * prior.errorOf(*sound.greens.take(), held));
}

// One displacement of 1250 is against the forces, a hundred times as large.
TEST(ComplianceCorrection, OneGrossOutlierTakesNothing) {
  const SolidProblem truth = cubeWithBall(5, 10);
  const auto greens = truth.greens();
  const CorrectionPrior prior(4);
  const Measurements held = measuredOn(greens, truth.model.mesh(), rigOf(20, 0, 77));
  Measurements m = measuredOn(greens, truth.model.mesh(), rigOf(25, 0.01));
  const double sound = prior.errorOf(*prior.corrected(m).greens.take(), held);
  m.displacements[7].displacement *= -100;
  CorrectedGreensFunctions found = prior.corrected(m);
  EXPECT_EQ(std::count(found.fit.outliers.begin(), found.fit.outliers.end(), 7), 1);
  EXPECT_LE(prior.errorOf(*found.greens.take(), held), 1.02 * sound);
}

// In few modes the correction is one of the prior's leading modes alone.
TEST(ComplianceCorrection, FewModesSpanTheCorrection) {
  const SolidProblem truth = cubeWithBall(5, 0.1);
  const CorrectionPrior prior(4);
  CorrectionOptions options;
  options.modes = 7;
  CorrectedGreensFunctions found =
      prior.corrected(measuredOn(truth.greens(), truth.model.mesh(), rigOf(10, 0.01)), options);
  const Eigen::MatrixXd change = complianceOf(*found.greens.take()) -
                                 found.fit.parameters[0].value * complianceOf(*prior.greens);
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(change).singularValues();
  EXPECT_GT(values[6], 1e-6 * values[0]);
  EXPECT_LE(values[7], 1e-9 * values[0]);
}

TEST(ComplianceCorrection, WhatCannotBeIsRefused) {
  const CorrectionPrior prior(3);
  const Measurements sound = measuredOn(prior.greens, prior.problem.model.mesh(), rigOf(2, 0.01));
  const auto refused = [&](const auto& change, const char* words) {
    CorrectionOptions options;
    Measurements m = sound;
    change(options, m);
    return isRefused([&] { prior.corrected(m, options); }, words);
  };
  EXPECT_TRUE(refused([](auto& o, auto&) { o.modes = 1000; }, "modes, not 1000"));
  EXPECT_TRUE(refused([](auto& o, auto&) { o.smoothing = -1; }, "must be positive"));
  EXPECT_TRUE(refused([](auto& o, auto&) { o.folds = 0; }, "a smoothing must be given"));
  EXPECT_TRUE(refused([](auto&, auto& m) { m.displacements.resize(1); }, "at least two"));
  EXPECT_TRUE(refused(
      [](auto&, auto& m) {
        for (auto& d : m.displacements) d.displacement = -d.displacement;
      },
      "against the forces"));
  EXPECT_TRUE(refused(
      [](auto&, auto& m) {
        for (auto& d : m.displacements) d.displacement.setZero();
      },
      "nothing moved"));
}

}  // namespace
}  // namespace palpate::test
