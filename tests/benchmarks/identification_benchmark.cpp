// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What identifying a material of a sphere of n vertices costs, against computing its Green's
// functions once: the samples that the response is interpolated between, and the fit itself.

#include <benchmark/benchmark.h>

#include <cmath>

#include "support/rigs.h"

namespace palpate::bench {
namespace {

/// A sphere and the displacements of 50 markers under each of so many probes.
struct Body {
  explicit Body(const benchmark::State& state)
      : model(
            test::makeModel(test::icosphere(state.range(0) == 162 ? 2 : 3), test::cap, 2e4, 0.4)) {
    RigSettings rig;
    rig.radius = 0.4;
    rig.probes = static_cast<int>(state.range(1));
    measurements = test::measuredOn(test::computeGreens(model, {}), model.mesh(), rig);
  }
  ElasticModel model;
  Measurements measurements;
};

void computeOnce(benchmark::State& state) {
  const Body body(state);
  for (auto _ : state) benchmark::DoNotOptimize(test::computeGreens(body.model, {}).get());
}

void sampleResponses(benchmark::State& state) {
  const Body body(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        test::identifierOn(body.model, body.measurements).response().sampleCount());
}

void fit(benchmark::State& state) {
  const Body body(state);
  const MaterialIdentifier identifier = test::identifierOn(body.model, body.measurements);
  for (auto _ : state)
    benchmark::DoNotOptimize(identifier.identify(body.measurements).materials.data());
}

void sizes(benchmark::internal::Benchmark* of) {
  of->ArgNames({"n", "probes"})->Unit(benchmark::kMillisecond);
  for (int n : {162, 642})
    for (int probes : {5, 50}) of->Args({n, probes});
}
BENCHMARK(computeOnce)->Apply(sizes);
BENCHMARK(sampleResponses)->Apply(sizes);
BENCHMARK(fit)->Apply(sizes);

}  // namespace
}  // namespace palpate::bench
