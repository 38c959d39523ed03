// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The servo loop with its devices: what it costs besides the model, and how it keeps time while
// another thread deforms the whole surface for pictures.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "haptics/snapshot_deformation.h"
#include "haptics/tool_touch.h"
#include "haptics/virtual_wall.h"
#include "support/cpu_clock.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

/// Reading and judging a pose, mapping it, safety, writing and the snapshot, with a wall of one
/// subtraction for a model.
void tickWithoutModel(benchmark::State& state) {
  const int toolCount = static_cast<int>(state.range(0));
  std::vector<ServoTool> tools;
  for (int t = 0; t < toolCount; ++t) {
    SimulatedDeviceSettings device;
    device.hand.stiffness = 100;
    device.hand.path = [](double time) { return Eigen::Vector3d(0, 0, 0.02 * std::sin(5 * time)); };
    tools.push_back({std::make_shared<SimulatedDevice>(device), {}, {}});
  }
  ServoLoop loop(std::make_shared<VirtualWall>(150, Eigen::Vector3d::Zero(),
                                               Eigen::Vector3d::UnitZ(), toolCount),
                 tools);
  loop.runHeadless(1000);
  loop.clearStatistics();
  for (auto _ : state) loop.runHeadless(1);
  const LatencyHistogram& compute = loop.statistics().compute;
  state.counters["p50_us"] = 1e6 * compute.quantile(0.5);
  state.counters["p99_us"] = 1e6 * compute.quantile(0.99);
  state.counters["p999_us"] = 1e6 * compute.quantile(0.999);
}
BENCHMARK(tickWithoutModel)->ArgName("tools")->Arg(1)->Arg(2)->Arg(5);

/// A hand that leads a ball round a pole of the unit sphere, pressed in by a depth, once in four
/// seconds.
ServoTool strokingHand(double pole, double radius, double depth) {
  SimulatedDeviceSettings device;
  device.hand.stiffness = 400;
  device.hand.damping = 4;
  device.hand.path = [=](double time) -> Eigen::Vector3d {
    const double turn = 1.5708 * time, tilt = pole + 0.3 * std::sin(turn), out = 1 + radius - depth;
    return out * Eigen::Vector3d(std::sin(tilt), 0.3 * std::cos(turn), std::cos(tilt)).normalized();
  };
  return {std::make_shared<SimulatedDevice>(device), {}, {}};
}

/// Devices that rub balls of a fifth of the sphere's radius with friction, at 1 kHz on the real
/// clock, while this thread deforms all vertices sixty times a second.
void devicesBesideFrames(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const int toolCount = static_cast<int>(state.range(0)), n = static_cast<int>(state.range(1));
  constexpr double radius = 0.2, depth = 0.04;
  const auto mesh = std::make_shared<SurfaceMesh>(sphereModel(n).mesh());
  const auto greens = sphereGreens(n);
  UnilateralContactSettings settings;
  settings.solver.largestUpdates = 12;
  const auto ball = std::make_shared<RigidTouchTool>(std::make_shared<SphereShape>(radius));
  std::vector<ServoTool> hands;
  for (int t = 0; t < toolCount; ++t) hands.push_back(strokingHand(0.6 - 1.2 * t, radius, depth));
  ServoLoop loop(std::make_shared<ToolTouch>(
                     greens, mesh, std::vector<std::shared_ptr<const TouchTool>>(toolCount, ball),
                     0.3, settings),
                 hands);
  SnapshotDeformation deformation(greens);
  std::vector<double> frames;
  double contacts = 0;
  for (auto _ : state) {
    loop.start();
    const auto begin = Clock::now();
    const auto frameTime =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / 60));
    for (int frame = 1; frame <= 60 * state.range(2); ++frame) {
      std::this_thread::sleep_until(begin + frame * frameTime);
      if (frame == 30) loop.clearStatistics();  // the start-up ramp
      loop.update();
      const double start = cpuSeconds();
      deformation.computeAll(loop.latest().contact);
      frames.push_back(cpuSeconds() - start);
      contacts += loop.latest().contact.certificate.contactCount;
    }
    state.counters["frames_a_second"] =
        60.0 * state.range(2) / std::chrono::duration<double>(Clock::now() - begin).count();
    loop.stop();
  }
  std::sort(frames.begin(), frames.end());
  state.counters["contacts"] = contacts / frames.size();
  state.counters["frame_p50"] = 1e6 * frames[frames.size() / 2];
  state.counters["frame_max"] = 1e6 * frames.back();
  const ServoStatistics& statistics = loop.statistics();
  state.counters["missed"] = static_cast<double>(statistics.missedTicks.load());
  for (const auto& [name, times] :
       {std::pair("", &statistics.compute), std::pair("late_", &statistics.lateness)})
    for (const auto& [word, share] : {std::pair("p50", 0.5), std::pair("p99", 0.99),
                                      std::pair("p99_9", 0.999), std::pair("max", 1.0)})
      state.counters[std::string(name) + word] = 1e6 * times->quantile(share);
}
BENCHMARK(devicesBesideFrames)
    ->ArgNames({"tools", "n", "seconds"})
    ->Args({1, 162, 1})
    ->Args({2, 2562, 20})
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
}  // namespace palpate::bench
