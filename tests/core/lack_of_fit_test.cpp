// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/lack_of_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/refusals.h"

namespace palpate::test {
namespace {

/// Markers on a wavy sheet under some probes.
struct Rig {
  Measurements measurements;
  Eigen::Matrix3Xd places;

  /// @param isShared  whether all probes see the same markers.
  Rig(int probes, int markers, bool isShared) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    measurements.probes.resize(probes);
    places.resize(3, probes * markers);
    for (int p = 0; p < probes; ++p)
      for (int m = 0; m < markers; ++m) {
        const int row = p * markers + m;
        const double x = uniform(random), y = uniform(random);
        places.col(row) = Eigen::Vector3d(x, y, 0.1 * std::sin(6 * x));
        if (isShared && p > 0) places.col(row) = places.col(m);
        MeasuredDisplacement u;
        u.probe = p;
        u.row = row;
        measurements.displacements.push_back(u);
      }
  }

  int rows() const { return static_cast<int>(places.cols()); }
};

/// Normal, of a deviation at each row.
Eigen::VectorXd noiseOf(int rows, std::mt19937& random, const std::function<double(int)>& size) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(3 * rows);
  for (int i = 0; i < 3 * rows; ++i) noise[i] = size(i / 3) * normal(random);
  return noise;
}

/// How many sets chance would have go together as much with at most a probability.
int setsWithin(double probability, int sets, const MarkerNeighbours& neighbours,
               const std::function<Eigen::VectorXd()>& residuals) {
  int count = 0;
  for (int set = 0; set < sets; ++set)
    count += neighbourCorrelation(neighbours, residuals()).byChance <= probability;
  return count;
}

// The probabilities are exact: what is allowed is what 500 throws of such a coin stay within but
// for one case in 10^4.
void expectAsOftenAsSaid(const Rig& rig, const std::function<Eigen::VectorXd()>& residuals) {
  constexpr int kSets = 500;
  const MarkerNeighbours neighbours(rig.measurements, rig.places);
  EXPECT_NEAR(setsWithin(0.05, kSets, neighbours, residuals), 0.05 * kSets, 18);
  EXPECT_LE(setsWithin(0.001, kSets, neighbours, residuals), 5);
}

TEST(LackOfFit, IndependentNoiseIsCalledUnlikelyAsOftenAsItIs) {
  std::mt19937 random(1);
  for (bool isShared : {true, false}) {
    const Rig rig(3, 25, isShared);
    expectAsOftenAsSaid(rig, [&] { return noiseOf(rig.rows(), random, [](int) { return 1.0; }); });
  }
}

TEST(LackOfFit, SoIsNoiseOfAnotherSizeAtEachPlace) {
  const Rig rig(3, 25, true);
  std::mt19937 random(2);
  expectAsOftenAsSaid(rig, [&] {
    return noiseOf(rig.rows(), random, [&](int row) { return std::exp(3 * rig.places(0, row)); });
  });
}

// A marker whose place is told wrongly is off under all probes.
TEST(LackOfFit, SoIsWhatMarkersAreOffUnderAllProbesAlike) {
  const Rig rig(3, 25, true);
  std::mt19937 random(3);
  expectAsOftenAsSaid(rig, [&] {
    const Eigen::VectorXd once = noiseOf(25, random, [](int) { return 1.0; });
    Eigen::VectorXd all = noiseOf(rig.rows(), random, [](int) { return 0.3; });
    for (int p = 0; p < 3; ++p) all.segment(75 * p, 75) += (1 + p) * once;
    return all;
  });
}

TEST(LackOfFit, SmoothMisfitOfHalfTheNoiseIsFound) {
  std::mt19937 random(4);
  for (bool isShared : {true, false}) {
    const Rig rig(5, 50, isShared);
    const MarkerNeighbours neighbours(rig.measurements, rig.places);
    const auto residuals = [&] {
      Eigen::VectorXd all = noiseOf(rig.rows(), random, [](int) { return 1.0; });
      for (int row = 0; row < rig.rows(); ++row)
        all[3 * row + 2] +=
            0.5 * std::sqrt(6.0) *
            std::sin(4 * rig.places(0, row) + rig.measurements.displacements[row].probe);
      return all;
    };
    EXPECT_GE(setsWithin(0.001, 100, neighbours, residuals), 95);
  }
}

TEST(LackOfFit, FewMarkersTellNothing) {
  const Rig rig(3, 5, true);
  const MarkerNeighbours neighbours(rig.measurements, rig.places);
  const NeighbourCorrelation found =
      neighbourCorrelation(neighbours, Eigen::VectorXd::Ones(3 * rig.rows()));
  EXPECT_NEAR(found.correlation, 1, 1e-12);
  EXPECT_GT(found.byChance, 0.03);  // one of 2^4 changes of sign is none
  EXPECT_EQ(neighbourCorrelation(neighbours, Eigen::VectorXd::Zero(3 * rig.rows())).byChance, 1);
}

TEST(LackOfFit, NeighboursAreSeenByOneProbe) {
  const Rig rig(4, 30, false);
  const MarkerNeighbours neighbours(rig.measurements, rig.places);
  ASSERT_EQ(neighbours.placeCount(), 120);
  for (const auto& [a, b] : neighbours.pairs()) EXPECT_EQ(a / 30, b / 30);
  EXPECT_GE(neighbours.pairs().size(), 3 * 120u);  // six of each, some of them mutual
  EXPECT_EQ(MarkerNeighbours(Rig(4, 30, true).measurements, Rig(4, 30, true).places).placeCount(),
            30);
}

TEST(LackOfFit, IsWarnedOfWithByHowMuchDeviationsAreTooSmall) {
  MaterialIdentification result;
  result.fitError = 0.1;
  result.neighbours = {0.4, 0.0005};
  IdentifiedParameter modulus;
  modulus.deviation = 2;
  modulus.probewiseDeviation = 9;
  result.parameters = {modulus};
  warnOfLackOfFit(result);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(contains(result.warnings[0], "correlation 0.4"));
  EXPECT_TRUE(contains(result.warnings[0], "up to 4.5 times"));
  result.neighbours.byChance = 0.002;
  warnOfLackOfFit(result);
  result.neighbours.byChance = 0.0005;
  result.interpolationError = 0.05;  // which residuals may be of
  warnOfLackOfFit(result);
  EXPECT_EQ(result.warnings.size(), 1u);
}

}  // namespace
}  // namespace palpate::test
