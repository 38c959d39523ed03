// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Tables 2 and 3 of James and Pai 2001 with the same rows and columns. The counters that begin with
// `paper_` are theirs: unoptimised Java on a Pentium III at 450 MHz.

#include <benchmark/benchmark.h>

#include "bem/boundary_element_method.h"
#include "contact/capacitance_matrix.h"
#include "mesh/loop_subdivision.h"
#include "support/cpu_clock.h"
#include "support/data_models.h"
#include "support/lapack_lu.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

struct Table2Row {
  const char* name;
  int steps;                      ///< of Loop subdivision from the control mesh
  double minutes, luPercent, ms;  ///< Precomp, LUD, Simulate
};
constexpr Table2Row kTable2[] = {{"nodule", 1, 1.1, 1.1, 0.05},
                                 {"kidney", 2, 7.7, 3.1, 0.13},
                                 {"spatula", 2, 45, 5.7, 0.34},
                                 {"banana_seat", 2, 25, 20.0, 0.15}};

struct Table3Row {
  int s;
  double luFactor, luSolve, sum;  ///< ms
};
constexpr Table3Row kTable3[] = {
    {10, 0.54, 0.03, 0.38}, {20, 2.7, 0.15, 0.74}, {40, 19, 0.58, 1.7}, {100, 310, 5.7, 5.7}};

/// A model of data/ as one smooth patch, its control mesh refined `steps` times.
ElasticModel paperModel(const std::string& name, int steps) {
  test::DataModel model = test::readDataModel(name);
  for (int step = 0; step < steps; ++step) {
    const SubdivisionLevel level = subdivideLoop(*model.shape.mesh());
    model.boundaryTypes = refineBoundaryTypes(level, model.boundaryTypes);
    model.shape = {level.points, level.triangles};
  }
  const Eigen::VectorXi onePatch = Eigen::VectorXi::Zero(model.shape.triangles.cols());
  return ElasticModel(model.shape.mesh(), Material(model.youngsModulus, model.poissonRatio),
                      BoundaryConditions(model.boundaryTypes), onePatch);
}

ComputedGreensFunctions precompute(const ElasticModel& model) {
  BoundaryElementOptions options;
  options.threads = 1;
  return computeBoundaryElementGreensFunctions(model, options);
}

/// Precomputation of all free columns, in seconds; LU's share as the paper counts it, against all.
void table2Precompute(benchmark::State& state, const Table2Row& row) {
  const ElasticModel model = paperModel(row.name, row.steps);
  for (auto _ : state) benchmark::DoNotOptimize(precompute(model).matrix.data());
  const double free = double(model.conditions().freeNodes().size());
  const double size = 3.0 * model.mesh().vertexCount();
  // One factorisation of a matrix of the same size.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(int(size), int(size));
  const double start = cpuSeconds();
  LapackLu(matrix.data(), int(size), int(size));
  state.counters["lu_seconds"] = cpuSeconds() - start;
  state.counters["vertices"] = model.mesh().vertexCount();
  state.counters["free"] = free;
  state.counters["faces"] = model.mesh().triangleCount();
  state.counters["paper_minutes"] = row.minutes;
  state.counters["paper_lu_percent"] = row.luPercent;
}

/// The displacement of the whole free boundary under a point contact at one vertex.
void table2Simulate(benchmark::State& state, const Table2Row& row) {
  const auto greens = precompute(paperModel(row.name, row.steps)).take();
  const std::vector<int> nodes = scatteredFreeNodes(*greens, 16);
  const Eigen::Vector3d traction(1, 2, -1);
  Eigen::VectorXd response(3 * greens->nodeCount());
  std::size_t next = 0;
  for (auto _ : state) {
    response.setZero();
    greens->accumulate(Eigen::Map<const Eigen::VectorXi>(&nodes[next], 1), traction, response);
    benchmark::ClobberMemory();
    next = (next + 1) % nodes.size();
  }
  state.counters["paper_ms"] = row.ms;
}

/// s nodes of the spatula, its capacitance matrix, and right-hand sides.
struct Updates {
  explicit Updates(int s)
      : greens(shared()), nodes(scatteredFreeNodes(*greens, s)), c(3 * s, 3 * s), right(3 * s) {
    greens->gather(nodeList(nodes), nodeList(nodes), c.data());
    right.setLinSpaced(1e-3, 2e-3);
  }
  static const std::shared_ptr<const GreensFunctions>& shared() {
    static const auto greens = precompute(paperModel("spatula", 2)).take();
    return greens;
  }
  std::shared_ptr<const GreensFunctions> greens;
  std::vector<int> nodes;
  Eigen::MatrixXd c;
  Eigen::VectorXd right;
};

void table3Factor(benchmark::State& state, const Table3Row& row) {
  const Updates updates(row.s);
  Eigen::MatrixXd c;
  for (auto _ : state) {
    c = updates.c;
    LapackLu(c.data(), 3 * row.s, 3 * row.s);
    benchmark::ClobberMemory();
  }
  state.counters["paper_ms"] = row.luFactor;
}

void table3Solve(benchmark::State& state, const Table3Row& row) {
  Updates updates(row.s);
  const LapackLu lu(updates.c.data(), 3 * row.s, 3 * row.s);
  Eigen::VectorXd x;
  for (auto _ : state) {
    x = updates.right;
    lu.solve(x.data(), 1, 3 * row.s);
    benchmark::ClobberMemory();
  }
  state.counters["paper_ms"] = row.luSolve;
}

/// In place of the solve: the kept inverse applied.
void table3Apply(benchmark::State& state, const Table3Row& row) {
  const Updates updates(row.s);
  const CapacitanceMatrix matrix(updates.greens, switchesOfNodes(updates.nodes));
  Eigen::VectorXd x(3 * row.s);
  for (auto _ : state) {
    matrix.solve(updates.right.data(), x.data());
    benchmark::ClobberMemory();
  }
  state.counters["paper_ms"] = row.luSolve;
}

/// In place of the factorisation: the kept inverse after one node has left and come back.
void table3Update(benchmark::State& state, const Table3Row& row) {
  const Updates updates(row.s);
  CapacitanceMatrix matrix(updates.greens, switchesOfNodes(updates.nodes));
  const std::vector<ConstraintSwitch> back = switchesOfNodes({updates.nodes[0]});
  for (auto _ : state) {
    matrix.removeNode(updates.nodes[0]);
    matrix.add(back.data(), 3);
    benchmark::ClobberMemory();
  }
  state.counters["paper_ms"] = row.luFactor;
}

/// The sum over all nodes; `nodes` lets it be scaled to the paper's 100.
void table3Sum(benchmark::State& state, const Table3Row& row) {
  const Updates updates(row.s);
  Eigen::VectorXd response(3 * updates.greens->nodeCount());
  for (auto _ : state) {
    response.setZero();
    updates.greens->accumulate(nodeList(updates.nodes), updates.right, response);
    benchmark::ClobberMemory();
  }
  state.counters["nodes"] = updates.greens->nodeCount();
  state.counters["paper_ms"] = row.sum;
}

const int registered = [] {
  using benchmark::RegisterBenchmark;
  for (const Table2Row& row : kTable2) {
    const std::string name = row.name;
    RegisterBenchmark(("table2Precompute/" + name).c_str(), table2Precompute, row)
        ->Unit(benchmark::kSecond);
    RegisterBenchmark(("table2Simulate/" + name).c_str(), table2Simulate, row)
        ->Unit(benchmark::kMillisecond);
  }
  using Measure = void (*)(benchmark::State&, const Table3Row&);
  const std::pair<const char*, Measure> columns[] = {{"table3Factor", table3Factor},
                                                     {"table3Solve", table3Solve},
                                                     {"table3Sum", table3Sum},
                                                     {"table3Update", table3Update},
                                                     {"table3Apply", table3Apply}};
  for (const auto& [name, measure] : columns)
    for (const Table3Row& row : kTable3)
      RegisterBenchmark((std::string(name) + "/s:" + std::to_string(row.s)).c_str(), measure, row)
          ->Unit(benchmark::kMillisecond);
  return 0;
}();

}  // namespace
}  // namespace palpate::bench
