// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a tick of the servo loop costs besides the model: reading and judging a pose, mapping it,
// safety, writing and the snapshot, with a wall of one subtraction for a model.

#include <benchmark/benchmark.h>

#include <cmath>

#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "haptics/virtual_wall.h"

namespace palpate::bench {
namespace {

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

}  // namespace
}  // namespace palpate::bench
