// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What touching costs the servo loop in each tick: the distribution of the thread's CPU
// time, in which other processes do not count.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "haptics/point_touch.h"
#include "haptics/tool_touch.h"
#include "support/allocation_count.h"
#include "support/cpu_clock.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

constexpr int kTicks = 40000, kBallTicks = 4000, kPasses = 5;

/// CPU times of ticks that are the same in each of several passes.
class Distribution {
 public:
  explicit Distribution(int ticks = kTicks) : least_(ticks, 1) {
    all_.reserve(std::size_t(ticks) * kPasses);
  }

  void add(double seconds) {
    double& least = least_[all_.size() % least_.size()];
    least = std::min(least, seconds);
    all_.push_back(seconds);
  }
  /// Percentiles as counters, in microseconds: of all ticks, and of what each took in its quickest
  /// pass, in which no interrupt was charged to it.
  void report(benchmark::State& state) {
    for (auto& [name, times] : {std::pair<std::string, std::vector<double>&>("", all_),
                                std::pair<std::string, std::vector<double>&>("own_", least_)}) {
      std::sort(times.begin(), times.end());
      const auto micro = [&, &sorted = times](double share) {
        return 1e6 * sorted[std::min(sorted.size() - 1, std::size_t(share * sorted.size()))];
      };
      state.counters[name + "p50"] = micro(0.5);
      state.counters[name + "p99"] = micro(0.99);
      state.counters[name + "p99_9"] = micro(0.999);
      state.counters[name + "max"] = micro(1);
    }
  }

 private:
  std::vector<double> all_, least_;
};

/// A probe under friction that winds over all of a sphere at 0.1 m/s, taken as 10 cm in diameter:
/// in contact most of the time, between an eighth of an edge above and three eighths below the
/// surface.
void slide(benchmark::State& state, bool withSnapshot) {
  const int n = static_cast<int>(state.range(0));
  const auto mesh = std::make_shared<SurfaceMesh>(sphereModel(n).mesh());
  const double edge = mesh->meanEdgeLength();
  const auto stiffness =
      std::make_shared<SurfaceStiffness>(sphereGreens(n), mesh, MaskShape::Linear, 2 * edge);
  PointTouch touch(stiffness, 1, 0.3);
  ContactSnapshot snapshot = touch.makeSnapshot();
  ToolPose pose;
  Wrench wrench;
  Distribution distribution;
  double touching = 0, sliding = 0;
  int tick = 0;
  const long before = test::allocationCount();
  for (auto _ : state) {
    if (tick % kTicks == 0) touch.reset();
    const double along = 2e-3 * (tick++ % kTicks);
    const double polar = 1.6 + 1.4 * std::cos(0.061 * along);
    const double radius = 1 - edge * (0.125 - 0.25 * std::cos(1.7 * along));
    pose.position = radius * Eigen::Vector3d(std::sin(polar) * std::cos(along),
                                             std::sin(polar) * std::sin(along), std::cos(polar));
    const double start = cpuSeconds();
    touch.step(&pose, &wrench);
    if (withSnapshot) touch.fill(snapshot);
    const double taken = cpuSeconds() - start;
    state.SetIterationTime(taken);
    distribution.add(taken);
    touching += touch.contact(0).isTouching();
    sliding += touch.contact(0).isSliding();
  }
  state.counters["allocations"] = double(test::allocationCount() - before);
  state.counters["touching"] = touching / double(state.iterations());
  state.counters["sliding"] = sliding / double(state.iterations());
  distribution.report(state);
}
void tickOfPointTouch(benchmark::State& state) {
  slide(state, false);
}
void tickOfPointTouchWithSnapshot(benchmark::State& state) {
  slide(state, true);
}

/// Where a ball is that rubs over all of a sphere at 0.1 m/s, taken as 10 cm in diameter.
ToolPose rubbing(int tick, double radius, double depth) {
  const double along = 2e-3 * tick, polar = 1.2 + 0.5 * std::cos(0.5 * along);
  const double height = 1 + radius - depth * std::min(1.0, tick / 200.0);
  ToolPose pose;
  pose.position = height * Eigen::Vector3d(std::sin(polar) * std::cos(along),
                                           std::sin(polar) * std::sin(along), std::cos(polar));
  return pose;
}

/// The depth at which the mean of its contacts is s, from that of a smooth surface on: contacts
/// grow as the depth does.
double depthOf(ToolTouch& touch, int n, int s, double radius) {
  double depth = s * 4.0 * (radius + 1) / (n * radius);  // pi a^2 = s vertex areas, a^2 = R_e depth
  for (int trial = 0; trial < 4; ++trial) {
    double contacts = 0;
    touch.reset();
    for (int tick = 0; tick < kBallTicks; ++tick) {
      const ToolPose pose = rubbing(tick, radius, depth);
      Wrench wrench;
      contacts += touch.step(&pose, &wrench).contactCount;
    }
    depth *= s * kBallTicks / contacts;
  }
  return depth;
}

/// That ball under friction, so deep that s vertices bear a force on average: the whole unilateral
/// problem, with vertices that come, go, stick and slip, by the settings of a session.
void tickOfBall(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0)), s = static_cast<int>(state.range(1));
  const auto mesh = std::make_shared<SurfaceMesh>(sphereModel(n).mesh());
  const double radius = s > 50 ? 1 : 0.6;
  UnilateralContactSettings settings;
  settings.solver.largestUpdates = 12;
  ToolTouch touch(sphereGreens(n), mesh,
                  {std::make_shared<RigidTouchTool>(std::make_shared<SphereShape>(radius))}, 0.3,
                  settings);
  const double depth = depthOf(touch, n, s, radius);
  Wrench wrench;
  Distribution distribution(kBallTicks);
  double contacts = 0, cut = 0, worst = 0;
  int tick = 0;
  const long before = test::allocationCount();
  for (auto _ : state) {
    if (tick % kBallTicks == 0) touch.reset();
    const ToolPose pose = rubbing(tick++ % kBallTicks, radius, depth);
    const double start = cpuSeconds();
    const ContactCertificate certificate = touch.step(&pose, &wrench);
    const double taken = cpuSeconds() - start;
    state.SetIterationTime(taken);
    distribution.add(taken);
    contacts += certificate.contactCount;
    cut += certificate.budgetCut;
    worst = std::max(worst, certificate.residual);
  }
  state.counters["allocations"] = double(test::allocationCount() - before);
  state.counters["contacts"] = contacts / double(state.iterations());
  state.counters["cut"] = cut;
  state.counters["residual"] = worst;
  distribution.report(state);
}

/// What the clock itself adds to each of these.
void emptyTick(benchmark::State& state) {
  Distribution distribution;
  for (auto _ : state) {
    const double start = cpuSeconds();
    benchmark::ClobberMemory();
    const double taken = cpuSeconds() - start;
    state.SetIterationTime(taken);
    distribution.add(taken);
  }
  distribution.report(state);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("n")->Arg(162)->Arg(642)->Arg(2562)->Unit(benchmark::kMicrosecond);
  benchmark->UseManualTime()->Iterations(kTicks * kPasses);
}
BENCHMARK(tickOfPointTouch)->Apply(sizes);
BENCHMARK(tickOfPointTouchWithSnapshot)->Apply(sizes);
BENCHMARK(tickOfBall)
    ->ArgNames({"n", "s"})
    ->Args({162, 10})
    ->Args({2562, 40})
    ->Args({2562, 100})
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime()
    ->Iterations(kBallTicks* kPasses);
BENCHMARK(emptyTick)->Unit(benchmark::kMicrosecond)->UseManualTime()->Iterations(kTicks* kPasses);

}  // namespace
}  // namespace palpate::bench
