// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What importing a matrix of n nodes costs, against LAPACK's inverse of the same by Cholesky.

#include <benchmark/benchmark.h>

#include <cmath>

#include "linear_algebra/lapack.h"
#include "support/given_bodies.h"
#include "support/half_space.h"

extern "C" void dpotri_(const char*, const int*, double*, const int*, int*, std::size_t);

namespace palpate::bench {
namespace {

/// A plate of about so many vertices, and its matrices.
struct Plate {
  explicit Plate(benchmark::State& state)
      : divisions(2 * static_cast<int>(std::sqrt(double(state.range(0))) / 2)),
        shape(test::plate(1, divisions)) {
    const test::HalfSpace body = test::halfSpace(shape, 0.3, true, 1e4);
    compliance = test::forceCompliance(*body.greens, test::nodesUpTo(body.mesh->vertexCount()));
  }
  Eigen::MatrixXd inverse() const {
    const int size = static_cast<int>(compliance.rows());
    Eigen::MatrixXd matrix = compliance;
    lapack::potrf(size, matrix.data(), size);
    int failed = 0;
    dpotri_("L", &size, matrix.data(), &size, &failed, 1);
    return matrix;
  }
  GivenMatrix stiffness() const {
    return test::given(Eigen::MatrixXd(inverse().selfadjointView<Eigen::Lower>()));
  }

  int divisions;
  test::Shape shape;
  Eigen::MatrixXd compliance;
};

void import(benchmark::State& state, const test::Shape& surface, MatrixKind kind,
            const GivenMatrix& matrix, const NodeTable& nodes) {
  const ElasticModel model = test::givenModel(surface);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        importGreensFunctions(model, kind, matrix, nodes).greens.matrix.data());
}

void invertByLapack(benchmark::State& state) {
  const Plate plate(state);
  for (auto _ : state) benchmark::DoNotOptimize(plate.inverse().data());
}

void importCompliance(benchmark::State& state) {
  const Plate plate(state);
  import(state, plate.shape, MatrixKind::Compliance, test::given(plate.compliance), {});
}

void importStiffness(benchmark::State& state) {
  const Plate plate(state);
  import(state, plate.shape, MatrixKind::Stiffness, plate.stiffness(), {});
}

/// Every second vertex of each row is the surface's, the other three quarters are condensed out.
void importCondensed(benchmark::State& state) {
  const Plate plate(state);
  import(state, test::plate(1, plate.divisions / 2), MatrixKind::Stiffness, plate.stiffness(),
         test::nodesAt(plate.shape.points));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("n")->Arg(162)->Arg(2000)->Unit(benchmark::kMillisecond);
}

BENCHMARK(invertByLapack)->Apply(sizes);
BENCHMARK(importCompliance)->Apply(sizes);
BENCHMARK(importStiffness)->Apply(sizes);
BENCHMARK(importCondensed)->Apply(sizes);

}  // namespace
}  // namespace palpate::bench
