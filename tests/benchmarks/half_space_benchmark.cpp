// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a block of a half-space's Green's functions costs where it is computed when asked for: for
// neighbours, in closed form, and for vertices far from each other, by point loads.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "support/half_space.h"

namespace palpate::bench {
namespace {

constexpr int kColumns = 16;

/// A disc of about so many vertices.
test::HalfSpace discOf(benchmark::State& state) {
  const int rings = static_cast<int>(std::sqrt(state.range(0) / 3.));
  return test::halfSpace(test::disc(1, rings), 0.3, state.range(1) != 0);
}

/// Blocks of the columns in the middle for the rows that are nearest to it, or farthest.
template <bool isFar>
void gatherBlocks(benchmark::State& state) {
  const test::HalfSpace body = discOf(state);
  const int count = std::min(body.greens->nodeCount() / 3, 300);
  const Eigen::VectorXi columns = Eigen::VectorXi::LinSpaced(kColumns, 0, kColumns - 1);
  const int first = isFar ? body.greens->nodeCount() - count : 0;
  const Eigen::VectorXi rows = Eigen::VectorXi::LinSpaced(count, first, first + count - 1);
  Eigen::MatrixXd blocks(3 * count, 3 * kColumns);
  for (auto _ : state) {
    body.greens->gather(rows, columns, blocks.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * count * kColumns);
}

void makeTables(benchmark::State& state) {
  const test::HalfSpace body = discOf(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(HalfSpaceGreensFunctions(body.greens->info(), *body.mesh).bytes());
  state.counters["bytes"] = static_cast<double>(body.greens->bytes());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "reciprocal"})->ArgsProduct({{162, 2562}, {0, 1}});
}

BENCHMARK_TEMPLATE(gatherBlocks, false)->Name("gatherNear")->Apply(sizes);
BENCHMARK_TEMPLATE(gatherBlocks, true)->Name("gatherFar")->Apply(sizes);
BENCHMARK(makeTables)->Apply(sizes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace palpate::bench
