// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What it costs to find what is hidden inside a cube of n divisions: a field of stiffness, against
// the Green's functions of the cube, and a correction of these, against the modes of their
// compliance (Eigen's symmetric eigenvalues of 3 free vertices) that it is made of. Both with 50
// displacements a probe.

#include <benchmark/benchmark.h>

#include <Eigen/Eigenvalues>

#include "support/inclusions.h"

namespace palpate::bench {
namespace {

using namespace test::inclusions;

/// A ball of a tenth of the stiffness, seen on a cube of one division more.
struct Hidden {
  explicit Hidden(const benchmark::State& state)
      : divisions(static_cast<int>(state.range(0))), prior(divisions) {
    const test::SolidProblem truth = cubeWithBall(divisions + 1, 0.1);
    measurements = test::measuredOn(truth.greens(), truth.model.mesh(),
                                    rigOf(static_cast<int>(state.range(1)), 0.01));
  }
  int divisions;
  CorrectionPrior prior;
  Measurements measurements;
};

void solid(benchmark::State& state) {
  const Hidden hidden(state);
  for (auto _ : state) benchmark::DoNotOptimize(hidden.prior.problem.greens().get());
}

void modes(benchmark::State& state) {
  const Hidden hidden(state);
  const GreensFunctions& greens = *hidden.prior.greens;
  const std::vector<int> free = greens.info().conditions.freeNodes();
  Eigen::MatrixXd compliance(3 * free.size(), 3 * free.size());
  greens.gather(nodeList(free), nodeList(free), compliance.data());
  for (auto _ : state)
    benchmark::DoNotOptimize(
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(compliance).eigenvalues().data());
}

/// The equations once, of a smoothing that is known.
void correctOnce(benchmark::State& state) {
  const Hidden hidden(state);
  CorrectionOptions options;
  options.smoothing = 0.3;
  options.folds = 0;
  options.leaveOutOutliers = false;
  for (auto _ : state)
    benchmark::DoNotOptimize(hidden.prior.corrected(hidden.measurements, options).smoothing);
}

/// With outliers, and a smoothing chosen by probes left out.
void correct(benchmark::State& state) {
  const Hidden hidden(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(hidden.prior.corrected(hidden.measurements).smoothing);
}

void field(benchmark::State& state) {
  const Hidden hidden(state);
  const FieldPrior prior(hidden.divisions);
  StiffnessFieldOptions options;
  options.folds = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(prior.identified(hidden.measurements, options, 20).modulus.data());
}

void sizes(benchmark::internal::Benchmark* of) {
  of->ArgNames({"n", "probes"})->Unit(benchmark::kMillisecond);
  for (int n : {3, 5, 7})
    for (int probes : {5, 20}) of->Args({n, probes});
}
BENCHMARK(solid)->Apply(sizes);
BENCHMARK(modes)->Apply(sizes);
BENCHMARK(correctOnce)->Apply(sizes);
BENCHMARK(correct)->Apply(sizes);
BENCHMARK(field)->Apply(sizes);

}  // namespace
}  // namespace palpate::bench
