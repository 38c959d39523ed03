// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What two threads do to a servo loop, for ThreadSanitizer to watch: a program that reports a data
// race and fails if there is one. With the argument --race it makes one, to show that it would.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>

#include "haptics/servo_loop.h"
#include "haptics/virtual_wall.h"

using namespace palpate;

namespace {

long shared = 0;

int race() {
  std::thread other([] { ++shared; });
  ++shared;
  other.join();
  return 0;
}

/// Goes in and out of the wall, and is unplugged now and then.
class Hand : public HapticDevice {
 public:
  const DeviceInfo& info() const override { return info_; }
  bool read(DeviceState& state) noexcept override {
    if (++reads_ % 401 == 0) return false;
    state.sequence = reads_;
    state.pose.position.z() = 0.02 * std::sin(0.01 * static_cast<double>(reads_));
    return true;
  }
  bool write(const Wrench& wrench) noexcept override {
    rendered_ = wrench;
    return true;
  }

 private:
  DeviceInfo info_{"hand", 3, 0, 0, 1000};
  std::uint64_t reads_ = 0;
  Wrench rendered_;
};

std::shared_ptr<HapticDevice> makeDevice() {
  return std::make_shared<Hand>();
}

std::shared_ptr<TouchModel> makeWall(double stiffness) {
  return std::make_shared<VirtualWall>(stiffness, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(),
                                       2);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "--race") == 0) return race();
  ServoSettings settings;
  settings.rate = 4000;
  settings.passivityDamping = 10;
  SafetySettings safety;
  safety.settleSeconds = safety.rampSeconds = 0.01;
  ServoLoop loop(makeWall(100), {{makeDevice(), {}, safety}, {makeDevice(), {}, safety}}, settings);
  double sum = 0;
  for (int round = 0; round < 3; ++round) {
    loop.start();
    for (int i = 0; i < 300; ++i) {
      if (loop.update())
        for (const ToolReport& tool : loop.latest().tools) sum += tool.rendered.force.z();
      if (i % 70 == 0) loop.pause(i % 140 == 70);
      if (i % 11 == 0) loop.reset();
      if (i % 13 == 0) loop.setModel(makeWall(50 + i));
      if (i % 17 == 0) loop.setMapping(1, WorkspaceMapping());
      if (i % 19 == 0) loop.post([](TouchModel& model) noexcept { model.reset(); });
      if (i == 150) loop.clearStatistics();
      sum += loop.statistics().lateness.quantile(0.99) + loop.statistics().compute.largest();
      std::this_thread::sleep_for(std::chrono::microseconds(700));
    }
    loop.stop();
  }
  loop.runHeadless(100);
  const auto ticks = static_cast<long>(loop.statistics().ticks);
  std::printf("%ld ticks, sum %g\n", ticks, sum);
  return ticks > 100 && std::isfinite(sum) ? 0 : 1;
}
