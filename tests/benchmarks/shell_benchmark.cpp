// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What all Green's functions of a curved shell cost, beside a factorisation and solutions for as
// many dense columns by MUMPS alone, and by Eigen's own sparse Cholesky factors.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <Eigen/SparseCholesky>
#include <vector>

#include "shell/shell_system.h"
#include "support/thin_shells.h"

namespace palpate::bench {
namespace {

constexpr Eigen::Index kColumnsAtOnce = 96;

/// A saddle of about so many vertices, clamped at one edge.
test::ShellProblem saddleOf(benchmark::State& state) {
  const int squares = static_cast<int>(std::lround(std::sqrt(double(state.range(0))))) - 1;
  return test::shellProblem(test::plate(1, squares).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y(), 0.4 * x.x() * x.x() - 0.3 * x.y() * x.y());
  }),
                            [](const Eigen::Vector3d& x) { return x.x() < -0.499; });
}

int columnsOf(const test::ShellProblem& problem) {
  return 3 * static_cast<int>(problem.model.conditions().freeNodes().size());
}

void greensFunctions(benchmark::State& state) {
  const test::ShellProblem problem = saddleOf(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(computeShellGreensFunctions(problem.model, problem.shell));
  state.SetItemsProcessed(state.iterations() * columnsOf(problem));
}

void assemble(benchmark::State& state) {
  const test::ShellProblem problem = saddleOf(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(shell::ShellSystem(problem.model, problem.shell).entries.size);
  state.SetItemsProcessed(state.iterations() * problem.mesh().triangleCount());
}

/// Solves for that many columns, block by block.
template <class Factored>
void solveColumns(const Factored& solve, int rows, int columns) {
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(rows, kColumnsAtOnce);
  for (Eigen::Index first = 0; first < columns; first += kColumnsAtOnce) {
    block.setZero();
    for (Eigen::Index c = 0; c < kColumnsAtOnce; ++c) block((first + c) % rows, c) = 1;
    solve(block);
    benchmark::ClobberMemory();
  }
}

void mumpsAlone(benchmark::State& state) {
  const test::ShellProblem problem = saddleOf(state);
  const shell::ShellSystem system(problem.model, problem.shell);
  for (auto _ : state) {
    const SparseFactorization factored(system.entries, 0, true);
    solveColumns([&](Eigen::MatrixXd& block) { factored.solve(block); }, system.freeCount(),
                 columnsOf(problem));
  }
  state.SetItemsProcessed(state.iterations() * columnsOf(problem));
}

void plainEigen(benchmark::State& state) {
  const test::ShellProblem problem = saddleOf(state);
  const shell::ShellSystem system(problem.model, problem.shell);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < system.entries.value.size(); ++i)
    entries.emplace_back(system.entries.row[i], system.entries.column[i], system.entries.value[i]);
  Eigen::SparseMatrix<double> matrix(system.freeCount(), system.freeCount());
  matrix.setFromTriplets(entries.begin(), entries.end());
  for (auto _ : state) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored(matrix);
    solveColumns([&](Eigen::MatrixXd& block) { block = factored.solve(block).eval(); },
                 system.freeCount(), columnsOf(problem));
  }
  state.SetItemsProcessed(state.iterations() * columnsOf(problem));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("n")->Arg(169)->Arg(1089)->Arg(2601)->Unit(benchmark::kMillisecond);
}

BENCHMARK(greensFunctions)->Apply(sizes);
BENCHMARK(assemble)->Apply(sizes);
BENCHMARK(mumpsAlone)->Apply(sizes);
BENCHMARK(plainEigen)->Apply(sizes);

}  // namespace
}  // namespace palpate::bench
