// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The deformation sum u += (Xi E)(E^T v) of [JP01] section 4.3 against the bandwidth at which this
// machine reads the same amount of memory. Cold: a matrix many times the caches' size, walked
// through node by node. Hot: few enough columns for half of a second-level cache, again and again.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>

#include "greens/weighted_columns.h"
#include "linear_algebra/aligned_buffer.h"
#include "support/read_bandwidth.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

constexpr int kSwitched = 16;  ///< nodes of a sum

/// Columns of whole nodes that half of the second-level cache holds.
int hotColumns(int rows) {
  const long cache = std::max(sysconf(_SC_LEVEL2_CACHE_SIZE), 512L * 1024);
  return 3 * static_cast<int>(std::max(1L, cache / 2 / (3 * long(sizeof(double)) * rows)));
}

template <class Scalar>
void sumCold(benchmark::State& state) {
  const int nodes = static_cast<int>(state.range(0));
  const auto greens = randomGreens<Scalar>(nodes);
  std::vector<int> order = scatteredFreeNodes(*greens, nodes / kSwitched * kSwitched);
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(3 * kSwitched, 0.5, 1.5);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3 * nodes);
  std::size_t first = 0;
  for (auto _ : state) {
    const Eigen::Map<const Eigen::VectorXi> columns(order.data() + first, kSwitched);
    greens->accumulate(columns, weights, out);
    benchmark::ClobberMemory();
    first = first + kSwitched < order.size() ? first + kSwitched : 0;
  }
  state.counters["bytes"] = 9.0 * kSwitched * nodes * sizeof(Scalar);
}

using Read = double (*)(const void* memory, std::size_t bytes);

template <Read read>
void readCold(benchmark::State& state) {
  const std::size_t nodes = state.range(0);
  AlignedBuffer<double> matrix(9 * nodes * nodes);
  std::fill_n(matrix.data(), matrix.size(), 1.0);
  const std::size_t chunk = 9 * nodes * kSwitched;  // what one sum reads
  std::size_t first = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(read(matrix.data() + first, chunk * sizeof(double)));
    first = first + 2 * chunk <= matrix.size() ? first + chunk : 0;
  }
  state.counters["bytes"] = double(chunk * sizeof(double));
}

template <class Scalar>
void sumHot(benchmark::State& state) {
  const int rows = 3 * static_cast<int>(state.range(0)), columns = hotColumns(rows);
  AlignedBuffer<Scalar> matrix(std::size_t(rows) * columns);
  std::fill_n(matrix.data(), matrix.size(), Scalar(1));
  std::vector<const Scalar*> column;
  for (int c = 0; c < columns; ++c) column.push_back(matrix.data() + std::size_t(rows) * c);
  const std::vector<double> weights(columns, 1e-3);
  std::vector<double> out(rows, 0.0);
  for (auto _ : state) {
    for (int c = 0; c < columns; c += kColumnGroup)
      addWeightedColumns(&column[c], &weights[c], std::min(kColumnGroup, columns - c), rows,
                         out.data());
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = double(matrix.bytes());
}

template <Read read>
void readHot(benchmark::State& state) {
  const int rows = 3 * static_cast<int>(state.range(0));
  AlignedBuffer<double> matrix(std::size_t(rows) * hotColumns(rows));
  std::fill_n(matrix.data(), matrix.size(), 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(read(matrix.data(), matrix.bytes()));
  state.counters["bytes"] = double(matrix.bytes());
}

constexpr auto kUnit = benchmark::kMicrosecond;
BENCHMARK_TEMPLATE(sumCold, double)->ArgName("n")->Arg(162)->Arg(2562)->Unit(kUnit);
BENCHMARK_TEMPLATE(sumCold, float)->ArgName("n")->Arg(162)->Arg(2562)->Unit(kUnit);
BENCHMARK_TEMPLATE(readCold, readInOneStream)->ArgName("n")->Arg(162)->Arg(2562)->Unit(kUnit);
BENCHMARK_TEMPLATE(readCold, readInEightStreams)->ArgName("n")->Arg(162)->Arg(2562)->Unit(kUnit);
BENCHMARK_TEMPLATE(sumHot, double)->ArgName("n")->Arg(162)->Arg(642)->Unit(kUnit);
BENCHMARK_TEMPLATE(sumHot, float)->ArgName("n")->Arg(162)->Arg(642)->Unit(kUnit);
BENCHMARK_TEMPLATE(readHot, readInOneStream)->ArgName("n")->Arg(162)->Arg(642)->Unit(kUnit);
BENCHMARK_TEMPLATE(readHot, readInEightStreams)->ArgName("n")->Arg(162)->Arg(642)->Unit(kUnit);

}  // namespace
}  // namespace palpate::bench
