// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/simulated_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/allocation_count.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

// Rounding of a few thousand steps of a 2 by 2 recursion.
constexpr double kRounding = 1e-12;

Vector3d reportOf(SimulatedDevice& device) {
  DeviceState state;
  EXPECT_TRUE(device.read(state));
  return state.pose.position;
}

TEST(SimulatedDevice, ReachesItsTerminalVelocityExponentially) {
  SimulatedDeviceSettings settings;
  SimulatedDevice device(settings);
  const Vector3d force(1, -2, 0.5);
  reportOf(device);
  for (int tick = 1; tick < 1000; ++tick) {
    device.write({force, Vector3d::Zero()});
    reportOf(device);
    const double t = 1e-3 * tick, rate = settings.damping / settings.mass;
    const Vector3d terminal = force / settings.damping;
    EXPECT_LE((device.velocity() - terminal * (1 - std::exp(-rate * t))).norm(), kRounding);
    EXPECT_LE((device.position() - terminal * (t - (1 - std::exp(-rate * t)) / rate)).norm(),
              kRounding);
    EXPECT_DOUBLE_EQ(device.time(), t);
  }
}

TEST(SimulatedDevice, SwingsInAHandAsADampedOscillator) {
  SimulatedDeviceSettings settings;
  settings.damping = 0.3;
  settings.hand.stiffness = 300;
  settings.hand.damping = 1.2;
  settings.hand.path = [](double) { return Vector3d(0.01, 0, 0); };
  SimulatedDevice device(settings);
  const double decay = (0.3 + 1.2) / (2 * settings.mass);
  const double frequency = std::sqrt(300 / settings.mass - decay * decay);
  for (int tick = 0; tick < 500; ++tick) {
    const double t = 1e-3 * tick;
    const double expected =
        0.01 * (1 - std::exp(-decay * t) *
                        (std::cos(frequency * t) + decay / frequency * std::sin(frequency * t)));
    EXPECT_NEAR(reportOf(device).x(), expected, kRounding);
  }
}

TEST(SimulatedDevice, FollowsASteadyHandAtItsSpeedLaggingByTheDampersShare) {
  SimulatedDeviceSettings settings;
  settings.hand.stiffness = 500;
  settings.hand.damping = 5;
  const Vector3d speed(0.1, 0.05, 0);
  settings.hand.path = [&](double t) -> Vector3d { return t * speed; };
  SimulatedDevice device(settings);
  for (int tick = 0; tick < 3000; ++tick) reportOf(device);
  // The hand's spring carries the device's own damping.
  EXPECT_LE((device.velocity() - speed).norm(), kRounding);
  EXPECT_LE((device.position() - device.time() * speed + 0.5 / 500 * speed).norm(), kRounding);
}

TEST(SimulatedDevice, PeriodsOfAnyLengthGiveTheSameMotion) {
  auto end = [](double period, int ticks) {
    SimulatedDeviceSettings settings;
    settings.period = period;
    settings.hand.stiffness = 1e4;
    settings.hand.path = [](double t) { return Vector3d(0.1 * t, 0, 0); };
    SimulatedDevice device(settings);
    for (int tick = 0; tick <= ticks; ++tick) reportOf(device);
    return device.position();
  };
  EXPECT_LE((end(1e-4, 1000) - end(1e-2, 10)).norm(), kRounding);
}

TEST(SimulatedDevice, AForceActsAfterItsDelay) {
  for (int delay : {0, 1, 2, 5}) {
    SimulatedDeviceSettings settings;
    settings.delay = delay;
    SimulatedDevice device(settings);
    reportOf(device);
    for (int tick = 0; tick < 10; ++tick) {
      device.write({Vector3d::UnitX() * (tick == 0), Vector3d::Zero()});
      const double before = device.velocity().x();
      reportOf(device);
      EXPECT_EQ(device.velocity().x() > before, tick == delay) << tick << " with " << delay;
    }
  }
}

TEST(SimulatedDevice, ItsLastForceGoesOnWhileNothingIsWritten) {
  SimulatedDeviceSettings settings;
  settings.delay = 1;
  SimulatedDevice device(settings);
  reportOf(device);
  device.write({Vector3d::UnitX(), Vector3d::Zero()});
  for (int tick = 0; tick < 2000; ++tick) reportOf(device);
  EXPECT_NEAR(device.velocity().x(), 1 / settings.damping, 1e-5);
}

TEST(SimulatedDevice, ReportsMultiplesOfItsQuantumAndMovesBetweenThem) {
  SimulatedDeviceSettings settings;
  settings.quantum = 1e-5;
  SimulatedDevice device(settings);
  reportOf(device);
  double largest = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    device.write({Vector3d(0.01, 0.003, 0), Vector3d::Zero()});
    const Vector3d position = reportOf(device);
    EXPECT_LE((position / 1e-5 - (position / 1e-5).array().round().matrix()).norm(), 1e-9);
    largest = std::max(largest, (position - device.position()).lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE(largest, 0.5e-5 * (1 + 1e-9));
  EXPECT_GT(largest, 0.4e-5);
}

TEST(SimulatedDevice, CutsForcesToItsLargest) {
  SimulatedDeviceSettings settings;
  settings.largestForce = 2;
  SimulatedDevice cut(settings), exact(settings);
  EXPECT_EQ(cut.info().largestForce, 2);
  reportOf(cut);
  reportOf(exact);
  cut.write({Vector3d(30, 40, 0), Vector3d::Zero()});
  exact.write({Vector3d(1.2, 1.6, 0), Vector3d::Zero()});
  EXPECT_LE((reportOf(cut) - reportOf(exact)).norm(), 1e-18);
}

TEST(SimulatedDevice, NumbersItsReportsAndRepeatsBitForBit) {
  SimulatedDeviceSettings settings;
  settings.delay = 2;
  settings.hand.stiffness = 100;
  settings.hand.path = [](double t) { return Vector3d(std::sin(t), 0, std::cos(3 * t)); };
  SimulatedDevice one(settings), other(settings);
  DeviceState a, b;
  for (std::uint64_t tick = 1; tick < 1000; ++tick) {
    one.read(a);
    other.read(b);
    EXPECT_EQ(a.sequence, tick);
    EXPECT_EQ(a.pose.position, b.pose.position);
    one.write({-50 * a.pose.position, Vector3d::Zero()});
    other.write({-50 * b.pose.position, Vector3d::Zero()});
  }
}

TEST(SimulatedDevice, ReadingAndWritingAllocateNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  SimulatedDeviceSettings settings;
  settings.delay = 3;
  settings.quantum = 1e-6;
  SimulatedDevice device(settings);
  DeviceState state;
  const long before = allocationCount();
  for (int tick = 0; tick < 100; ++tick) {
    device.read(state);
    device.write({Vector3d::UnitX(), Vector3d::Zero()});
  }
  EXPECT_EQ(allocationCount(), before);
}

TEST(SimulatedDevice, RefusesWhatIsNoDevice) {
  auto with = [](auto change, const char* name) {
    return isRefused(
        [&] {
          SimulatedDeviceSettings settings;
          change(settings);
          SimulatedDevice device(settings);
        },
        std::string("the simulated device's ") + name + " is out of range");
  };
  EXPECT_TRUE(with([](auto& s) { s.mass = 0; }, "mass"));
  EXPECT_TRUE(with([](auto& s) { s.mass = INFINITY; }, "mass"));
  EXPECT_TRUE(with([](auto& s) { s.damping = -1; }, "damping"));
  EXPECT_TRUE(with([](auto& s) { s.period = NAN; }, "period"));
  EXPECT_TRUE(with([](auto& s) { s.delay = -1; }, "delay"));
  EXPECT_TRUE(with([](auto& s) { s.quantum = -1; }, "quantum"));
  EXPECT_TRUE(with([](auto& s) { s.largestForce = -1; }, "largestForce"));
  EXPECT_TRUE(with([](auto& s) { s.hand.stiffness = -1; }, "hand's stiffness"));
  EXPECT_TRUE(with([](auto& s) { s.hand.damping = NAN; }, "hand's damping"));
}

}  // namespace
}  // namespace palpate::test
