// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/stiffness_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/inclusions.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using namespace inclusions;

/// Probes as they are fitted, and others without noise to be predicted.
struct Rig {
  Measurements fitted, heldOut;

  explicit Rig(const SolidProblem& truth, int probes = 20) {
    const auto greens = truth.greens();
    fitted = measuredOn(greens, truth.model.mesh(), rigOf(probes, 0.01));
    heldOut = measuredOn(greens, truth.model.mesh(), rigOf(probes, 0, 77));
  }
};

TEST(StiffnessModes, MakeTheFieldThatTheyAreSaidToMake) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {4, 4, 4}).mesh();
  const Eigen::Matrix3Xd centres = centresOf(mesh);
  const Eigen::MatrixXd modes = stiffnessModes(centres, mesh.volumes(), 0.4, 200);
  const Eigen::MatrixXd covariance = modes * modes.transpose();
  for (int i = 0; i < mesh.cellCount(); i += 17)
    for (int j = 0; j < mesh.cellCount(); j += 13)
      EXPECT_NEAR(covariance(i, j),
                  std::exp(-(centres.col(i) - centres.col(j)).squaredNorm() / (2 * 0.16)), 1e-3);
  // Leading ones first, orthogonal over the volume.
  const Eigen::MatrixXd gram = modes.transpose() * mesh.volumes().asDiagonal() * modes;
  for (int k = 1; k < modes.cols(); ++k) EXPECT_LE(gram(k, k), gram(k - 1, k - 1) * (1 + 1e-9));
  EXPECT_LE((gram - Eigen::MatrixXd(gram.diagonal().asDiagonal())).norm(), 1e-9 * gram.norm());
  EXPECT_TRUE(isRefused([&] { stiffnessModes(centres, mesh.volumes(), 0, 5); }, "positive, not 0"));
  EXPECT_TRUE(isRefused([&] { stiffnessModes(centres, mesh.volumes(), 0.05, 5); },
                        "below the size of the tetrahedra, 0.138"));
  EXPECT_TRUE(isRefused([&] { stiffnessModes(centres, mesh.volumes(), 1, 0); }, "at least one"));
}

// The deviation that is expected is the one that makes the measurements most probable: of a body of
// one stiffness, on another mesh, next to none.
TEST(StiffnessField, TheDeviationThatIsExpectedIsChosen) {
  const Rig rig(cubeWithBall(6, 1));
  const FieldPrior prior(5);
  StiffnessFieldOptions options;
  options.poissonRatio = kPoisson;
  options.folds = 0;
  const StiffnessField found = prior.identified(rig.fitted, options);
  EXPECT_LE(found.expected, 0.1);
  EXPECT_GE(found.modulus.minCoeff(), 0.85 * kYoung);
  EXPECT_LE(found.modulus.maxCoeff(), 1.15 * kYoung);
  EXPECT_GE(found.uniformError, found.fit.fitError);
  EXPECT_LE(found.uniformError, 1.05 * found.fit.fitError);
  options.deviation = 1;
  const StiffnessField loose = prior.identified(rig.fitted, options);
  EXPECT_GT(loose.modulus.maxCoeff() / loose.modulus.minCoeff(), 1.8);
}

class HiddenBalls : public ::testing::TestWithParam<double> {};

// Where the prior is a body of the right modulus but for the ball. Another mesh than the rig's,
// which alone makes 1 % of difference.
TEST_P(HiddenBalls, ProbesLeftOutArePredicted) {
  const Rig rig(cubeWithBall(9, GetParam()));
  const FieldPrior prior(8);
  const Eigen::VectorXd uniform = Eigen::VectorXd::Constant(prior.mesh.cellCount(), kYoung);
  StiffnessFieldOptions options;
  options.poissonRatio = kPoisson;
  const StiffnessField found = prior.identified(rig.fitted, options);
  EXPECT_GT(prior.errorOf(uniform, kPoisson, rig.heldOut), 0.2);
  EXPECT_LE(prior.errorOf(found.modulus, kPoisson, rig.heldOut), 0.03);
  EXPECT_TRUE(found.fit.outliers.size() < 5) << found.fit.outliers.size();
  // The ball is seen where it is.
  double inside = 0, outside = 0, volumes[2] = {0, 0};
  const Eigen::Matrix3Xd centres = centresOf(prior.mesh);
  for (int c = 0; c < prior.mesh.cellCount(); ++c) {
    const double away = (centres.col(c) - kBall).norm();
    if (away < 0.2) inside += std::log(found.modulus[c]), ++volumes[0];
    if (away > 0.5) outside += std::log(found.modulus[c]), ++volumes[1];
  }
  const double ratio = std::exp(inside / volumes[0] - outside / volumes[1]);
  EXPECT_GT(GetParam() > 1 ? ratio : 1 / ratio, 3);
}

INSTANTIATE_TEST_SUITE_P(Factors, HiddenBalls, ::testing::Values(0.1, 10));

// Of a uniform body nothing is made up: the field is uniform but for its own deviations.
TEST(StiffnessField, UniformBodiesStayUniform) {
  const Rig rig(cubeWithBall(6, 1), 10);
  const FieldPrior prior(5);
  StiffnessFieldOptions options;
  options.poisson = true;
  options.deviation = 1;
  const StiffnessField found = prior.identified(rig.fitted, options, 30);
  ASSERT_EQ(found.fit.parameters.size(), 2u);
  EXPECT_NEAR(found.fit.parameters[0].value / kYoung, 1, 0.05);
  EXPECT_NEAR(found.fit.parameters[1].value, kPoisson, 0.03);
  const Eigen::ArrayXd off = (found.modulus.array() / kYoung).log();
  EXPECT_GE((off.abs() < 2 * found.deviation.array()).cast<double>().mean(), 0.9);
  EXPECT_LT(found.determined, 32);
  EXPECT_GT(found.determined, 5);
  // More is known where more was measured: the deviation is below what was said before.
  EXPECT_LT(found.deviation.mean(), 0.7 * options.deviation);
}

TEST(StiffnessField, OutliersAreFoundAndLeftOut) {
  const SolidProblem truth = cubeWithBall(6, 0.2);
  Rig rig(truth, 10);
  const FieldPrior prior(5);
  StiffnessFieldOptions options;
  options.folds = 0;
  const StiffnessField before = prior.identified(rig.fitted, options, 30);
  for (int i = 3; i < 500; i += 20)
    rig.fitted.displacements[i].displacement += Eigen::Vector3d(0.01, -0.01, 0.01);
  const StiffnessField found = prior.identified(rig.fitted, options, 30);
  for (int i = 3; i < 500; i += 20)
    EXPECT_TRUE(std::binary_search(found.fit.outliers.begin(), found.fit.outliers.end(), i)) << i;
  EXPECT_LE(std::abs(std::log(found.fit.parameters[0].value / before.fit.parameters[0].value)),
            found.fit.parameters[0].deviation / found.fit.parameters[0].value);
}

TEST(StiffnessField, WhatCannotBeIsRefused) {
  const Rig rig(cubeWithBall(4, 1), 2);
  const FieldPrior prior(3);
  const auto refused = [&](const auto& change, const char* words) {
    StiffnessFieldOptions options;
    Measurements m = rig.fitted;
    change(options, m);
    return isRefused([&] { prior.identified(m, options, 5); }, words);
  };
  using Options = StiffnessFieldOptions;
  EXPECT_TRUE(refused([](Options& o, Measurements&) { o.deviation = -1; }, "deviation of ln E"));
  EXPECT_TRUE(refused([](Options& o, Measurements&) { o.poissonRatio = 0.6; }, "Poisson"));
  EXPECT_TRUE(refused(
      [](Options& o, Measurements&) {
        o.poisson = true;
        o.poissonUpper = 0.5;
      },
      "lower < upper < 0.4999"));
  EXPECT_TRUE(refused(
      [](Options&, Measurements& m) {
        for (auto& d : m.displacements) d.displacement = -d.displacement;
      },
      "against the forces"));
  EXPECT_TRUE(refused(
      [](Options&, Measurements& m) {
        for (auto& d : m.displacements) d.displacement.setZero();
      },
      "nothing moved"));
}

}  // namespace
}  // namespace palpate::test
