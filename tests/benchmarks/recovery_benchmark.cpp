// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What recovering a contact on a sphere of n vertices from so many markers costs, with and without
// deviations, against one factorisation of the same size: the orthogonal one of a dense matrix of
// three columns a free vertex and three rows a marker, or its transpose where that is less.

#include <benchmark/benchmark.h>

#include <Eigen/QR>

#include "support/recoveries.h"

namespace palpate::bench {
namespace {

struct Case {
  explicit Case(const benchmark::State& state)
      : body(test::makeModel(test::icosphere(state.range(0) == 162 ? 2 : 3), test::cap, 2e4, 0.4)) {
    const Eigen::Vector3d place = Eigen::Vector3d(0.5, 0.3, 0.7).normalized();
    observed = test::observedOn(body, displacementUnder(body, {{place, -place, 0.3}}), body.mesh(),
                                static_cast<int>(state.range(1)), 0.01, 1);
  }
  test::TouchedBody body;
  ObservedDisplacements observed;
};

void factorOnce(benchmark::State& state) {
  const Case here(state);
  const Eigen::Index columns = 3 * here.body.greens->info().conditions.freeNodes().size(),
                     rows = 3 * here.observed.displacements.cols();
  const Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Random(std::max(rows, columns), std::min(rows, columns));
  for (auto _ : state)
    benchmark::DoNotOptimize(Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).matrixQR().data());
}

void recover(benchmark::State& state) {
  const Case here(state);
  RecoveryOptions options;
  options.samples = static_cast<int>(state.range(2));
  for (auto _ : state)
    benchmark::DoNotOptimize(test::recoverOn(here.body, here.observed, options).force.data());
}

void sizes(benchmark::internal::Benchmark* of) {
  of->ArgNames({"n", "markers"})->Unit(benchmark::kMillisecond);
  for (int n : {162, 642})
    for (int markers : {30, 100, 300, 1000}) of->Args({n, markers});
}
void sizesAndSamples(benchmark::internal::Benchmark* of) {
  of->ArgNames({"n", "markers", "samples"})->Unit(benchmark::kMillisecond);
  for (int n : {162, 642})
    for (int markers : {30, 100, 300, 1000})
      for (int samples : {0, 50}) of->Args({n, markers, samples});
}
BENCHMARK(factorOnce)->Apply(sizes);
BENCHMARK(recover)->Apply(sizesAndSamples);

}  // namespace
}  // namespace palpate::bench
