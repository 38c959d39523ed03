// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Factorisation and solution of a sphere's exchanged system, for all free nodes' columns and for
// few, against LAPACK's dgetrf and dgetrs on the same matrix.

#include <benchmark/benchmark.h>

#include <algorithm>

#include "bem/boundary_element_method.h"
#include "bem/exchanged_system.h"
#include "linear_algebra/iterative_solve.h"
#include "linear_algebra/multi_precision_solve.h"
#include "support/lapack_lu.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

/// A system, with copies to be destroyed by solving.
template <class Scalar>
struct Case {
  explicit Case(const benchmark::State& state) {
    const ElasticModel model = sphereModel(static_cast<int>(state.range(0)));
    const bem::BodySurface body(model, 0);
    const bem::CollocationScheme scheme(body, Collocation::Averaged);
    bem::SystemColumns wanted;
    for (int v = 0; v < body.vertexCount(); ++v)
      if (!body.fixed[v]) wanted.vertices.push_back(v);
    if (state.range(1) == 1) wanted.vertices.resize(body.vertexCount() * 4 / 100);
    if (state.range(1) == 2) wanted.vertices.resize(1);
    system = bem::assembleSystem<Scalar>(body, scheme, wanted, 1e-6, 1, {});
    matrix = AlignedBuffer<Scalar>(system.matrix.size());
    right = AlignedBuffer<Scalar>(system.right.size());
  }
  void refill() {
    std::copy_n(system.matrix.data(), matrix.size(), matrix.data());
    std::copy_n(system.right.data(), right.size(), right.data());
  }
  void report(benchmark::State& state) const {
    const double n = system.size, m = system.columns;
    state.counters["N"] = n;
    state.counters["columns"] = m;
    state.counters["flop"] = 2.0 / 3 * n * n * n + 2 * n * n * m;
  }

  bem::ExchangedSystem<Scalar> system;
  AlignedBuffer<Scalar> matrix, right;
};

/// Times `solve` on fresh copies of the system.
template <class Scalar, class Solve>
void run(benchmark::State& state, const Solve& solve) {
  Case<Scalar> problem(state);
  for (auto _ : state) {
    state.PauseTiming();
    problem.refill();
    state.ResumeTiming();
    solve(problem, problem.system.size, problem.system.stride, problem.system.columns);
  }
  problem.report(state);
}

template <class Scalar>
void solveInOnePrecision(benchmark::State& state) {
  run<Scalar>(state, [](Case<Scalar>& c, int size, int stride, int columns) {
    solveInPlace(c.matrix, size, stride, c.right, columns, {});
  });
}

void solveMixed(benchmark::State& state) {
  int steps = 0;
  run<double>(state, [&](Case<double>& c, int size, int stride, int columns) {
    steps = solveMixedInPlace(c.matrix, size, stride, c.right, columns, {}).refinementSteps;
  });
  state.counters["steps"] = steps;
}

void solveIterative(benchmark::State& state) {
  int products = 0;
  run<double>(state, [&](Case<double>& c, int size, int stride, int columns) {
    products = solveIterativeInPlace(c.matrix, size, stride, c.system.diagonalRows, c.right,
                                     columns, {}, {})
                   .refinementSteps;
  });
  state.counters["products"] = products;
}

void solveByLapack(benchmark::State& state) {
  run<double>(state, [](Case<double>& c, int size, int stride, int columns) {
    LapackLu(c.matrix.data(), size, stride).solve(c.right.data(), columns, stride);
  });
}

/// Few is 0 for all free nodes' columns, 1 for a twenty-fifth of them, 2 for one node's.
void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "few"})
      ->ArgsProduct({{162, 642, 1280}, {0, 1}})
      ->Unit(benchmark::kMillisecond);
}
BENCHMARK_TEMPLATE(solveInOnePrecision, double)->Apply(sizes);
BENCHMARK_TEMPLATE(solveInOnePrecision, float)->Apply(sizes);
BENCHMARK(solveMixed)->Apply(sizes);
BENCHMARK(solveByLapack)->Apply(sizes);
void oneNode(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "few"})->Args({1280, 2})->Unit(benchmark::kMillisecond);
}
BENCHMARK_TEMPLATE(solveInOnePrecision, double)->Apply(oneNode);
BENCHMARK(solveIterative)->Apply(oneNode);

}  // namespace
}  // namespace palpate::bench
