// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/next_probes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/LU>
#include <numeric>
#include <random>

#include "support/refusals.h"
#include "support/rigs.h"

namespace palpate::test {
namespace {

constexpr double kNoise = 1e-4;

/// A body, one probe on it, and what others would tell.
struct Body {
  explicit Body(const Shape& shape = icosphere(2), const Place& fixed = cap)
      : model(makeModel(shape, fixed, 2e4, 0.42)) {}

  ElasticModel model;
  Measurements measurements = [this] {
    RigSettings rig;
    rig.radius = 0.4;
    rig.probes = 1;
    rig.markers = 30;
    return measuredOn(computeGreens(model, {}), model.mesh(), rig);
  }();
  Eigen::Vector2d material{2e4, 0.42};
  Measurements candidates = candidateProbes(model.mesh(), model.conditions(), measurements, 16);
  Eigen::MatrixXd present =
      informationOfProbes(identifierOn(model, measurements), material, measurements, kNoise)[0];
  std::vector<Eigen::MatrixXd> information =
      informationOfProbes(identifierOn(model, candidates), material, candidates, kNoise);
};

/// The area of the ellipse of confidence, about.
double areaOf(const Eigen::MatrixXd& information) {
  return 1 / std::sqrt(information.determinant());
}

std::vector<ChosenProbe> chosenOn(const Body& body, int count) {
  return chooseProbes(body.present, body.information, contactVertices(body.candidates), count);
}

/// How often random candidates tell less than `count` chosen ones, `times` as many of them.
double shareWorse(const Body& body, int count, int times) {
  const double chosen = areaOf(chosenOn(body, count).back().information);
  std::mt19937 random(1);
  constexpr int kDraws = 400;
  int worse = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::MatrixXd information = body.present;
    for (int i = 0; i < times * count; ++i)
      information += body.information[random() % body.information.size()];
    worse += areaOf(information) > chosen;
  }
  return double(worse) / kDraws;
}

TEST(NextProbes, OfAHeldBarTellMoreThanTwiceAsManyRandomOnes) {
  const Body bar(box({1, 1, 4}, {3, 3, 12}), [](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  for (int count : {2, 3, 5}) EXPECT_GE(shareWorse(bar, count, 2), 0.9) << count;
}

// Places on a ball are much alike: the median of twice as many random probes tells about as much.
TEST(NextProbes, OfABallTellMoreThanAsManyRandomOnes) {
  const Body ball;
  for (int count : {1, 2, 3}) {
    EXPECT_GE(shareWorse(ball, count, 1), 0.95) << count;
    EXPECT_GE(shareWorse(ball, count, 2), 0.4) << count;
  }
}

TEST(NextProbes, EachIsTheBestAtAnotherPlace) {
  const Body body;
  const std::vector<int> places = contactVertices(body.candidates);
  const std::vector<ChosenProbe> chosen = chosenOn(body, 2);
  for (std::size_t c = 0; c < body.information.size(); ++c) {
    const Eigen::MatrixXd& other = body.information[c];
    EXPECT_LE((body.present + other).determinant(),
              chosen[0].information.determinant() * (1 + 1e-12));
    if (places[c] == places[chosen[0].candidate]) continue;
    EXPECT_LE((chosen[0].information + other).determinant(),
              chosen[1].information.determinant() * (1 + 1e-12));
  }
  EXPECT_TRUE(isRefused([&] { chooseProbes(body.present, {}, {}, 1); }, "no candidate"));
  EXPECT_TRUE(isRefused([&] { chooseProbes(body.present, body.information, {1}, 1); },
                        "80 candidates, but 1 places"));
}

// One place tells by far most: it is taken once, then the others, then it again.
TEST(NextProbes, NoPlaceIsChosenTwiceBeforeAllAre) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  const std::vector<Eigen::MatrixXd> candidates{one, 100 * one, 90 * one, 2 * one};
  std::vector<int> order;
  for (const ChosenProbe& probe : chooseProbes(one, candidates, {4, 7, 7, 9}, 4))
    order.push_back(probe.candidate);
  EXPECT_EQ(order, (std::vector<int>{1, 3, 0, 1}));
}

// Against five of each candidate, all as if at places of their own.
TEST(NextProbes, OtherPlacesTellAlmostAsMuchAsTheBestOneAgain) {
  const Body bar(box({1, 1, 4}, {3, 3, 12}), [](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  for (const Body& body : {bar, Body()}) {
    std::vector<Eigen::MatrixXd> anyAgain;
    for (int copy = 0; copy < 5; ++copy)
      anyAgain.insert(anyAgain.end(), body.information.begin(), body.information.end());
    std::vector<int> apart(anyAgain.size());
    std::iota(apart.begin(), apart.end(), 0);
    for (int count : {2, 3, 5}) {
      const double repeated =
          areaOf(chooseProbes(body.present, anyAgain, apart, count).back().information);
      EXPECT_LE(areaOf(chosenOn(body, count).back().information), 1.2 * repeated) << count;
    }
  }
}

TEST(NextProbes, CandidatesAreFreeAndApart) {
  const Body body;
  ASSERT_EQ(body.candidates.probes.size(), 80u);
  EXPECT_EQ(body.candidates.displacements.size(), 80u * 30);
  double nearest = INFINITY;
  for (std::size_t a = 0; a < 80; a += 5) {
    const int vertex = body.candidates.probes[a].contact.vertex;
    EXPECT_FALSE(body.model.conditions().isFixed(vertex));
    for (std::size_t b = 0; b < a; b += 5)
      nearest = std::min(nearest,
                         (body.model.mesh().points().col(vertex) -
                          body.model.mesh().points().col(body.candidates.probes[b].contact.vertex))
                             .norm());
  }
  EXPECT_GT(nearest, 0.5) << "sixteen on a sphere can be 0.8 apart";
}

TEST(NextProbes, InformationIsThatOfTheFit) {
  const Body body;
  const auto identifier = identifierOn(body.model, body.measurements);
  Measurements exact = body.measurements;
  const Eigen::Matrix3Xd displacements = identifier.predict(body.material, exact);
  for (std::size_t i = 0; i < exact.displacements.size(); ++i) {
    exact.displacements[i].displacement = displacements.col(i);
    exact.displacements[i].deviation.setConstant(kNoise);
  }
  const auto result = identifier.identify(exact);
  const Eigen::MatrixXd covariance = body.present.inverse();
  EXPECT_NEAR(result.parameters[0].deviation / result.parameters[0].value,
              std::sqrt(covariance(0, 0)), 1e-3 * std::sqrt(covariance(0, 0)));
  EXPECT_NEAR(result.parameters[1].deviation, std::sqrt(covariance(1, 1)),
              1e-3 * std::sqrt(covariance(1, 1)));
  EXPECT_TRUE(isRefused([&] { informationOfProbes(identifier, body.material, exact, 0); },
                        "depends on the noise"));
}

}  // namespace
}  // namespace palpate::test
