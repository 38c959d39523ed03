// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Assembly of the exchanged system of a sphere at the default tolerance, near field included. A
// pair is a collocation point and a triangle; each distinct pair counts once. Instruction sets are
// compared by running this program with PALPATE_SIMD set.

#include <benchmark/benchmark.h>

#include <algorithm>

#include "bem/boundary_element_method.h"
#include "bem/exchanged_system.h"
#include "bem/influence_panels.h"
#include "bem/spatial_order.h"
#include "bem/triangle_quadrature.h"
#include "support/plain_assembly.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

const double kTolerance = BoundaryElementOptions().tolerance;

struct Case {
  explicit Case(const benchmark::State& state)
      : model(sphereModel(static_cast<int>(state.range(0)))),
        body(model, 0),
        scheme(body, state.range(1) ? Collocation::Averaged : Collocation::Vertex) {
    for (int v = 0; v < body.vertexCount(); ++v)
      if (!body.fixed[v]) wanted.vertices.push_back(v);
  }
  double pairs() const { return double(scheme.points.size()) * body.triangleCount(); }

  ElasticModel model;
  bem::BodySurface body;
  bem::CollocationScheme scheme;
  bem::SystemColumns wanted;
};

void assemble(benchmark::State& state) {
  const Case problem(state);
  const int threads = static_cast<int>(state.range(2));
  for (auto _ : state)
    benchmark::DoNotOptimize(bem::assembleSystem<double>(problem.body, problem.scheme,
                                                         problem.wanted, kTolerance, threads, {}));
  state.counters["pairs"] = problem.pairs();
}

/// Largest difference between the rows of both implementations far from their points, over the
/// largest entry. Not quite zero: eight points at a time choose one rule together.
double differenceFarAway(const Case& problem, const PlainAssembly& plain) {
  const bem::InfluencePanels panels(problem.body, problem.scheme, kTolerance);
  bem::InfluencePanels::Workspace work(panels);
  panels.compute(0, work);
  PlainAssembly::Rows h, g;
  double largest = 0, size = 0;
  for (int lane = 0; lane < panels.laneCount(0); ++lane) {
    plain.equation(lane, h, g);
    const int vertex = problem.scheme.equations[lane].vertex;
    int farthest;
    (problem.body.points.colwise() - problem.body.points.col(vertex))
        .colwise()
        .norm()
        .maxCoeff(&farthest);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double plainH = h(i, 3 * farthest + j), plainG = g(i, 3 * farthest + j);
        largest = std::max({largest, std::abs(work.h(farthest, i, j)[lane] - plainH),
                            std::abs(work.g(farthest, i, j)[lane] - plainG)});
        size = std::max({size, std::abs(plainH), std::abs(plainG)});
      }
  }
  return largest / size;
}

void assemblePlainly(benchmark::State& state) {
  const Case problem(state);
  const PlainAssembly plain(problem.body, problem.scheme, kTolerance);
  if (!(differenceFarAway(problem, plain) < 1e-5))
    return state.SkipWithError("the two assemblies differ");
  for (auto _ : state) benchmark::DoNotOptimize(plain.assemble(problem.wanted));
  state.counters["pairs"] = problem.pairs();
}

/// Integration alone, by groups of points as in the assembly; without closed forms the near
/// triangles cost what the seven-point rule costs (and mean nothing).
void integrate(benchmark::State& state) {
  const Case problem(state);
  const bool closedForms = state.range(2);
  const bem::InfluencePanels panels(problem.body, problem.scheme, kTolerance);
  std::vector<bem::PanelTriangle> triangles;
  for (int f = 0; f < problem.body.triangleCount(); ++f) triangles.push_back(panels.triangle(f));
  Eigen::Matrix3Xd positions(3, problem.scheme.points.size());
  for (int p = 0; p < positions.cols(); ++p) positions.col(p) = problem.scheme.points[p].position;
  const std::vector<int> order = bem::spatialOrder(positions);
  const std::vector<int> notOwn(triangles.size(), -1);
  std::vector<double> h(9 * bem::kLanes * std::size_t(problem.body.vertexCount()), 0.0);
  std::vector<double> g(6 * bem::kLanes * std::size_t(problem.body.nodes.count()), 0.0);
  long count = 0;

  bem::PanelTask task;
  bem::choosePanelRules(kTolerance, task.nearRule, task.farRule);
  if (!closedForms) task.nearRule.smallestDistance = 0;
  task.triangles = triangles.data();
  task.triangleCount = static_cast<int>(triangles.size());
  task.ownIndex = notOwn.data();
  task.own = nullptr;
  task.poissonRatio = problem.body.poissonRatio;
  task.h = h.data();
  task.g = g.data();
  task.closedFormCount = &count;
  for (auto _ : state)
    for (std::size_t first = 0; first + bem::kLanes <= order.size(); first += bem::kLanes) {
      for (int lane = 0; lane < bem::kLanes; ++lane)
        for (int c = 0; c < 3; ++c) task.x[c][lane] = positions(c, order[first + lane]);
      bem::integratePanel(task);
    }
  state.counters["pairs"] = problem.pairs();
  state.counters["closed_share"] =
      double(count) * bem::kLanes / double(state.iterations()) / problem.pairs();
}

constexpr auto kUnit = benchmark::kMillisecond;
BENCHMARK(assemble)
    ->ArgNames({"n", "averaged", "threads"})
    ->ArgsProduct({{162, 642, 2562}, {0, 1}, {1}})
    ->Unit(kUnit);
void assembleWallTime(benchmark::State& state) {
  assemble(state);
}
BENCHMARK(assembleWallTime)
    ->ArgNames({"n", "averaged", "threads"})
    ->ArgsProduct({{2562}, {0, 1}, {1, 2}})
    ->UseRealTime()
    ->Unit(kUnit);
BENCHMARK(assemblePlainly)
    ->ArgNames({"n", "averaged"})
    ->ArgsProduct({{162, 642, 2562}, {0, 1}})
    ->Unit(kUnit);
BENCHMARK(integrate)
    ->ArgNames({"n", "averaged", "closed"})
    ->ArgsProduct({{162, 642}, {0, 1}, {0, 1}})
    ->Unit(kUnit);

}  // namespace
}  // namespace palpate::bench
