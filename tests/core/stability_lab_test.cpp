// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/stability_lab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Eigenvalues>

#include "haptics/passivity.h"
#include "haptics/virtual_wall.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

/// Largest |z| of the sampled system by its characteristic polynomial,
/// z^d (z - 1)(z - a) + K (c1 z + c2) = 0, a = exp(-b T / m), c1, c2 the device's response to a
/// force held over a period (Franklin, Powell & Workman, "Digital control", table of z-transforms).
double spectralRadius(double stiffness, const SimulatedDeviceSettings& device) {
  const double m = device.mass, b = device.damping, x = b * device.period / m, a = std::exp(-x);
  const double c1 = m / (b * b) * (x - 1 + a), c2 = m / (b * b) * (1 - a - x * a);
  const int order = device.delay + 2;
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(order + 1);  // of z^0, z^1, ...
  coefficients[order] = 1;
  coefficients[order - 1] -= 1 + a;
  coefficients[order - 2] += a;
  coefficients[1] += stiffness * c1;
  coefficients[0] += stiffness * c2;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.diagonal(-1).setOnes();
  companion.rightCols(1) = -coefficients.head(order);
  return companion.eigenvalues().cwiseAbs().maxCoeff();
}

double criticalStiffness(const SimulatedDeviceSettings& device) {
  double stable = 1e-3, unstable = 1e8;
  while (unstable > (1 + 1e-9) * stable) {
    const double middle = std::sqrt(stable * unstable);
    (spectralRadius(middle, device) < 1 ? stable : unstable) = middle;
  }
  return stable;
}

class StabilityLabAtAWall : public testing::Test {
 protected:
  StabilityLab lab(double tolerance = 0.001) {
    settings_.tolerance = tolerance;
    return StabilityLab(wall_, settings_);
  }

  VirtualWall wall_{500, Vector3d::Zero(), Vector3d::UnitZ()};
  LabSettings settings_;
};

TEST_F(StabilityLabAtAWall, FindsTheStiffnessAtWhichTheSampledSystemsPolesLeaveTheUnitCircle) {
  // Jury's criterion without delay: a + K c2 < 1, and so K < 2 b / T (1 + b T / 6 m + ...).
  const double expected[] = {1001.11, 333.95, 200.58};
  for (int delay : {0, 1, 2}) {
    settings_.device.delay = delay;
    const double critical = criticalStiffness(settings_.device);
    EXPECT_NEAR(critical, expected[delay], 0.005) << "its digits";
    EXPECT_NEAR(lab().largestStable(), critical, 0.001 * critical) << delay;
  }
}

TEST_F(StabilityLabAtAWall, TheColgateBoundIsSafeAndNearlySharpForALightlyDampedDevice) {
  for (const ZWidthPoint& point :
       zWidth(wall_, settings_, {500, 1000, 4000}, {0.2, 1, 4}, {0, 1, 3})) {
    SimulatedDeviceSettings device = settings_.device;
    device.period = 1 / point.rate;
    device.damping = point.damping;
    device.delay = point.delay;
    EXPECT_NEAR(point.largestStable, criticalStiffness(device), 0.01 * point.largestStable);
    EXPECT_DOUBLE_EQ(point.passive, servedStiffness(point.damping, 1 / point.rate, point.delay));
    EXPECT_GT(point.largestStable, 0.99 * point.passive);
    const bool light = point.damping / point.rate < 0.01 * device.mass;
    EXPECT_LT(point.largestStable, (light ? 1.02 : 1.25) * point.passive);
  }
}

TEST_F(StabilityLabAtAWall, AHandsDampingCountsLikeTheDevices) {
  settings_.device.hand.damping = 2;
  settings_.device.hand.stiffness = 200;
  EXPECT_NEAR(lab().largestStable(), 5020, 25);
}

TEST_F(StabilityLabAtAWall, WithoutDampingNothingIsStable) {
  settings_.device.damping = 0;
  EXPECT_EQ(lab().largestStable(), 0);
  EXPECT_FALSE(lab().run(1).stable);
}

TEST_F(StabilityLabAtAWall, AtFourFifthsOfTheBoundTheWallDoesNoWorkAndTheDeviceComesToRest) {
  for (int delay : {0, 1, 2})
    for (double quantum : {0.0, 1e-5}) {
      settings_.device.delay = delay;
      settings_.device.quantum = quantum;
      const double stiffness = 0.8 * servedStiffness(0.5, 1e-3, delay);
      const LabRun run = lab().run(stiffness);
      EXPECT_TRUE(run.stable);
      EXPECT_LE(run.residual, 1e-4);
      // One quantum's force over one quantum's way is the least that can be seen.
      EXPECT_GE(run.leastEnergy, -stiffness * quantum * quantum * (1 + 1e-9));
    }
}

TEST_F(StabilityLabAtAWall, AtHalfAsMuchAgainItShakesUntilPassivityControlStepsIn) {
  const LabRun bare = lab().run(1500);
  EXPECT_FALSE(bare.stable);
  EXPECT_GT(bare.residual, 5e-4);
  EXPECT_LT(bare.leastEnergy, 0);
  EXPECT_EQ(bare.dampedTicks, 0);

  settings_.passivityControl = true;
  EXPECT_EQ(lab().run(500).dampedTicks, 0) << "what is passive is left alone";
  const LabRun controlled = lab().run(1500);
  EXPECT_TRUE(controlled.stable);
  EXPECT_LE(controlled.residual, 1e-4);
  EXPECT_GT(controlled.dampedTicks, 100);
}

TEST_F(StabilityLabAtAWall, TheStableStiffnessIsTheDevicesWhateverTheModelsOwn) {
  const double found = lab().largestStable();
  EXPECT_NEAR(lab().stiffness(), 500, 1e-9);
  VirtualWall other(3, {0.2, 0, 0}, {1, 1, 0});
  settings_.place = {0.1, 0.1, 0.7};
  settings_.direction = {-1, -1, 0};
  StabilityLab elsewhere(other, settings_);
  EXPECT_NEAR(elsewhere.stiffness(), 3, 1e-9);
  EXPECT_NEAR(elsewhere.largestStable(), found, 0.002 * found);
}

/// Holds a tool by springs along the axes, as a surface does that it sticks to.
class Springs : public VirtualWall {
 public:
  explicit Springs(const Vector3d& stiffness)
      : VirtualWall(0, Vector3d::Zero(), Vector3d::UnitZ()), stiffness_(stiffness) {}
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override {
    wrenches[0] = {-stiffness_.cwiseProduct(poses[0].position), Vector3d::Zero()};
    return {};
  }

 private:
  Vector3d stiffness_;
};

TEST_F(StabilityLabAtAWall, TheStiffestAxisDecidesAlsoAcrossThePress) {
  const double critical = criticalStiffness(settings_.device);
  for (const Vector3d& ratio :
       {Vector3d(3, 0, 1), Vector3d(0.2, 3, 1), Vector3d(0.5, 0.7, 1), Vector3d(0, 0, 1)}) {
    Springs springs(200 * ratio);
    const StabilityLab lab(springs, settings_);
    EXPECT_NEAR(lab.stiffness(), 200 * ratio.maxCoeff(), 1e-6);
    EXPECT_NEAR(lab.pressStiffness(), 200, 1e-9);
    EXPECT_NEAR(lab.largestStable(), critical, 0.01 * critical);
  }
}

TEST_F(StabilityLabAtAWall, AStiffnessWhoseAxesLieAcrossThePressIsItsLargestEigenvalue) {
  const double critical = criticalStiffness(settings_.device);
  Springs springs({1000, 100, 100});
  settings_.direction = {1, 0, -1};
  const StabilityLab lab(springs, settings_);
  EXPECT_NEAR(lab.pressStiffness(), 550, 1e-9);
  EXPECT_NEAR(lab.stiffness(), 1000, 1e-6);
  EXPECT_NEAR(lab.largestStable(), critical, 0.01 * critical);
}

/// Stiffer by a share for every millimetre along x.
class UnevenWall : public VirtualWall {
 public:
  explicit UnevenWall(double share)
      : VirtualWall(500, Vector3d::Zero(), Vector3d::UnitZ()), share_(share) {}
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override {
    const ContactCertificate certificate = VirtualWall::step(poses, wrenches);
    wrenches[0].force *= 1 + share_ * 1e3 * poses[0].position.x();
    return certificate;
  }

 private:
  double share_;
};

TEST_F(StabilityLabAtAWall, TheVariationOfAStiffnessAlongTheWayIsTold) {
  EXPECT_NEAR(lab().variation(), 0, 1e-9);
  for (double share : {0.1, 0.5, 2.0}) {
    UnevenWall wall(share);
    // f_z = K (1 + s x / d) z at depth d: K' - K = s K (dx / d, dz / d), |K| = K sqrt(1 + s^2), and
    // the kick is three tenths of d.
    EXPECT_NEAR(StabilityLab(wall, settings_).variation(), 0.3 * share / std::hypot(1, share),
                1e-6);
  }
}

TEST_F(StabilityLabAtAWall, ReportsProgressAndStopsOnRequest) {
  int calls = 0;
  EXPECT_THROW(zWidth(wall_, settings_, {1000}, {0.5, 1}, {0},
                      Progress([&](double, const char*) { return ++calls < 2; })),
               Aborted);
  EXPECT_EQ(calls, 2);
}

TEST_F(StabilityLabAtAWall, RefusesWhatItCannotPress) {
  auto with = [&](auto change, const std::string& sentence) {
    return isRefused(
        [&] {
          LabSettings settings;
          change(settings);
          StabilityLab(wall_, settings);
        },
        sentence);
  };
  EXPECT_TRUE(with([](auto& s) { s.depth = 0; }, "the lab's depth is out of range: 0"));
  EXPECT_TRUE(with([](auto& s) { s.tolerance = 1; }, "the lab's tolerance"));
  EXPECT_TRUE(with([](auto& s) { s.direction.setZero(); }, "the lab's direction"));
  EXPECT_TRUE(with([](auto& s) { s.place[1] = NAN; }, "the lab's place"));
  EXPECT_TRUE(with([](auto& s) { s.place = {0, 0, 1}; }, "the model does not resist the press"));
  EXPECT_TRUE(with([](auto& s) { s.device.mass = -1; }, "the simulated device's mass"));
  EXPECT_TRUE(isRefused([&] { zWidth(wall_, {}, {0}, {1}, {0}); },
                        "the lab's rates must be from 10 to 100000 Hz, not 0"));
  EXPECT_TRUE(isRefused([&] { lab().run(0); }, "the lab's stiffness is out of range: 0"));
  VirtualWall two(1, Vector3d::Zero(), Vector3d::UnitZ(), 2);
  EXPECT_TRUE(isRefused([&] { StabilityLab(two, {}); }, "number of tools is out of range: 2"));
}

}  // namespace
}  // namespace palpate::test
