// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/report_velocity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/servo_loop.h"
#include "haptics/virtual_wall.h"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

TEST(ReportVelocity, IsThatBetweenTheLastTwoReports) {
  ReportVelocity velocity;
  const Vector3d speed(0.1, 0, -0.2);
  for (int tick = 0; tick < 100; ++tick) {
    const int report = tick / 10;
    velocity.advance(report, 1e-2 * report * speed, 1e-3);
    if (report > 0) {
      EXPECT_LE((velocity.value() - speed).norm(), 1e-12) << tick;
    } else {
      EXPECT_TRUE(velocity.value().isZero(0));
    }
  }
}

/// A hand that no longer reports may have stopped: what it could still be moving by is less and
/// less.
TEST(ReportVelocity, FadesWhereTheNextReportIsLate) {
  ReportVelocity velocity;
  velocity.advance(1, Vector3d::Zero(), 1e-3);
  velocity.advance(2, Vector3d(1e-3, 0, 0), 1e-3);
  for (int late = 1; late < 10; ++late) {
    velocity.advance(2, Vector3d(1e-3, 0, 0), 1e-3);
    EXPECT_NEAR(velocity.value().x(), 1. / late, 1e-12);
  }
  velocity.restart();
  EXPECT_TRUE(velocity.value().isZero(0));
  velocity.advance(3, Vector3d(1, 0, 0), 1e-3);  // how it came there is not known
  EXPECT_TRUE(velocity.value().isZero(0));
}

/// Swings through a wall's surface, reports every so many ticks, and keeps what it is given.
struct SwingingDevice final : HapticDevice {
  explicit SwingingDevice(int interval) : interval(interval) {
    description.name = "swinging";
    description.largestForce = 10;
    description.reportRate = 1000. / interval;
  }
  const DeviceInfo& info() const override { return description; }
  bool read(DeviceState& state) noexcept override {
    const long report = tick++ / interval;
    state.sequence = report + 1;
    state.pose = {};
    state.pose.position.z() = 0.005 * std::cos(2 * kPi * 2 * 1e-3 * interval * report);
    return true;
  }
  bool write(const Wrench& wrench) noexcept override {
    forces.push_back(wrench.force.z());
    return true;
  }
  DeviceInfo description;
  int interval;
  long tick = 0;
  std::vector<double> forces;
};

double largestChange(int interval, double damping) {
  const auto device = std::make_shared<SwingingDevice>(interval);
  ServoTool tool;
  tool.device = device;
  tool.safety.forceSlew = 1e6;
  ServoSettings settings;
  settings.passivityDamping = damping;
  ServoLoop loop(std::make_shared<VirtualWall>(1000, Vector3d::Zero(), Vector3d::UnitZ()), {tool},
                 settings);
  loop.runHeadless(3000);
  double largest = 0;
  for (std::size_t i = 1500; i < device->forces.size(); ++i)
    largest = std::max(largest, std::abs(device->forces[i] - device->forces[i - 1]));
  return largest;
}

/// The wall alone changes the force by its stiffness times the way between two reports. The damping
/// adds no more than its own change: twice its coefficient times the largest speed, 0.063 m/s.
TEST(ReportVelocity, LetsPassivityDampingOfASlowDeviceActWithoutSpikes) {
  for (const int interval : {1, 10, 20}) {
    const double alone = largestChange(interval, 0), damped = largestChange(interval, 2);
    EXPECT_LE(damped, alone + 2 * 2 * 0.063) << interval;
    RecordProperty("change of force, reports every " + std::to_string(interval) + " ticks",
                   std::to_string(alone) + " N, damped " + std::to_string(damped));
  }
}

}  // namespace
}  // namespace palpate::test
