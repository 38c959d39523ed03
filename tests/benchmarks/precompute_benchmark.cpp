// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The whole precomputation of a sphere on one thread: seconds, and peak memory against the 8 (3n)^2
// bytes of one full matrix.

#include <benchmark/benchmark.h>

#include "bem/boundary_element_method.h"
#include "process_memory.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

template <Precision precision>
void precompute(benchmark::State& state) {
  const ElasticModel model = sphereModel(static_cast<int>(state.range(0)));
  BoundaryElementOptions options;
  options.precision = precision;
  options.threads = 1;
  const std::size_t before = startPeakMemory();
  for (auto _ : state) {
    const ComputedGreensFunctions result = computeBoundaryElementGreensFunctions(model, options);
    for (const auto& [stage, seconds] : result.info.diagnostics.seconds)
      state.counters[stage] = seconds;
  }
  const double rows = 3.0 * model.mesh().vertexCount();
  state.counters["peak"] = double(peakMemory() - before) / (8 * rows * rows);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("n")->Arg(162)->Arg(642)->Arg(2562)->Unit(benchmark::kSecond);
}
BENCHMARK_TEMPLATE(precompute, Precision::Double)->Name("precompute<double>")->Apply(sizes);
BENCHMARK_TEMPLATE(precompute, Precision::Mixed)->Name("precompute<mixed>")->Apply(sizes);
BENCHMARK_TEMPLATE(precompute, Precision::Float)->Name("precompute<float>")->Apply(sizes);

}  // namespace
}  // namespace palpate::bench
