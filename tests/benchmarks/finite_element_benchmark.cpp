// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What all Green's functions of a solid body cost by finite elements: beside the bare Schur
// complement of the same matrix (MUMPS), and beside boundary elements of the same error. The body
// is a cantilever of 1 by 1 by 8, sheared at its end, whose mean displacement is known to 1e-5
// (hp finite elements: 2055.45 for E = 1, nu = 0.3); "error" is relative to that.

#include <benchmark/benchmark.h>

#include "fem/solid_system.h"
#include "support/solids.h"

namespace palpate::bench {
namespace {

using test::SolidProblem;

constexpr double kShear = 2055.45;

SolidProblem cantilever(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  return test::solidProblem(
      test::kuhnBox({1, 1, 8}, {n, n, 8 * n}).mesh(), [](const auto& x) { return x.z() < 1e-9; }, 1,
      0.3);
}

/// Of the mean displacement of the end under a unit shear all over it.
double errorOf(const GreensFunctions& greens, const ElasticModel& model) {
  const SurfaceMesh& mesh = model.mesh();
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, mesh.triangleCount()), applied;
  const auto isEnd = [&](int f) { return mesh.triangleNormals()(2, f) > 0.5; };
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (isEnd(f)) tractions(0, f) = 1;
  const Eigen::Matrix3Xd u =
      solveFaceTractions(greens, mesh, model.smoothPatches(), tractions, applied);
  double mean = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (isEnd(f)) mean += mesh.triangleAreas()[f] * u(0, mesh.triangles().col(f)).mean();
  return std::abs(mean / kShear - 1);
}

void finiteElements(benchmark::State& state) {
  const SolidProblem problem = cantilever(state);
  FiniteElementOptions options;
  options.reciprocal = false;
  options.patchColumns = true;
  double error = 0;
  for (auto _ : state) {
    const auto greens = problem.greens(options);
    state.PauseTiming();
    error = errorOf(*greens, problem.model);
    state.ResumeTiming();
  }
  state.counters["error"] = error;
  state.counters["vertices"] = problem.model.mesh().vertexCount();
}

void boundaryElements(benchmark::State& state) {
  const SolidProblem problem = cantilever(state);
  BoundaryElementOptions options = test::raw();
  options.patchColumns = true;
  options.threads = 1;
  double error = 0;
  for (auto _ : state) {
    const auto greens = test::computeGreens(problem.model, options);
    state.PauseTiming();
    error = errorOf(*greens, problem.model);
    state.ResumeTiming();
  }
  state.counters["error"] = error;
  state.counters["vertices"] = problem.model.mesh().vertexCount();
}

/// As it is served by default: reciprocal, no patches.
void servedFiniteElements(benchmark::State& state) {
  const SolidProblem problem = cantilever(state);
  for (auto _ : state) benchmark::DoNotOptimize(problem.greens());
}

fem::SolidSystem systemOf(const SolidProblem& problem) {
  std::vector<fem::LoadHat> hats;
  for (int v : problem.model.conditions().freeNodes()) hats.push_back({v, -1});
  return {problem.model, problem.body, SolidElement::Quadratic, std::move(hats), {}, {},
          Progress()};
}

void assemble(benchmark::State& state) {
  const SolidProblem problem = cantilever(state);
  for (auto _ : state) benchmark::DoNotOptimize(systemOf(problem).entries.size);
}

void bareSchur(benchmark::State& state) {
  const fem::SolidSystem system = systemOf(cantilever(state));
  for (auto _ : state) {
    SparseFactorization factored(system.entries, system.keptCount(), true);
    benchmark::DoNotOptimize(factored.schurComplement().data());
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("n")->Arg(2)->Arg(3)->Arg(4)->Unit(benchmark::kMillisecond);
}

BENCHMARK(finiteElements)->Apply(sizes);
BENCHMARK(servedFiniteElements)->Apply(sizes);
BENCHMARK(assemble)->Apply(sizes);
BENCHMARK(bareSchur)->Apply(sizes);
BENCHMARK(boundaryElements)->Apply(sizes)->Arg(6);

}  // namespace
}  // namespace palpate::bench
