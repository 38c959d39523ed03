// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What happens at haptic rates: updates of the inverse capacitance matrix against the best
// factorisation afresh, and whole ticks of the servo loop, with the heap allocations they make.

#include <benchmark/benchmark.h>

#include <Eigen/LU>
#include <random>

#include "contact/capacitance_matrix.h"
#include "contact/mask_settings.h"
#include "contact/point_contact.h"
#include "support/allocation_count.h"
#include "support/cpu_clock.h"
#include "support/lapack_lu.h"
#include "support/spheres.h"

namespace palpate::bench {
namespace {

/// s constrained free nodes of a sphere, and one more that is not.
struct Contact {
  explicit Contact(const benchmark::State& state)
      : greens(sphereGreens(static_cast<int>(state.range(0)))),
        nodes(scatteredFreeNodes(*greens, static_cast<int>(state.range(1)) + 1)),
        other(nodes.back()) {
    nodes.pop_back();
  }
  CapacitanceMatrix matrix() const {
    return CapacitanceMatrix(greens, switchesOfNodes(nodes),
                             3 * static_cast<int>(nodes.size()) + 3);
  }

  std::shared_ptr<const GreensFunctions> greens;
  std::vector<int> nodes;
  int other;
};

/// Gathers C and factors it; `factor` gets the matrix to destroy.
template <class Factor>
void factorAfresh(benchmark::State& state, const Factor& factor) {
  const Contact contact(state);
  const int size = 3 * static_cast<int>(contact.nodes.size());
  Eigen::MatrixXd c(size, size);
  for (auto _ : state) {
    contact.greens->gather(nodeList(contact.nodes), nodeList(contact.nodes), c.data());
    factor(c);
  }
}
void factorByEigen(benchmark::State& state) {
  factorAfresh(state, [](Eigen::MatrixXd& c) {
    benchmark::DoNotOptimize(Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>(c).matrixLU().data());
  });
}
void factorByLapack(benchmark::State& state) {
  factorAfresh(state, [](Eigen::MatrixXd& c) {
    LapackLu(c.data(), static_cast<int>(c.rows()), static_cast<int>(c.rows()));
    benchmark::ClobberMemory();
  });
}

/// An addition and the removal of the same node; times one of the two.
void update(benchmark::State& state, bool timeAddition) {
  const Contact contact(state);
  CapacitanceMatrix matrix = contact.matrix();
  const std::vector<ConstraintSwitch> switches = switchesOfNodes({contact.other});
  for (auto _ : state) {
    const double start = cpuSeconds();
    matrix.add(switches.data(), 3);
    const double middle = cpuSeconds();
    matrix.removeNode(contact.other);
    state.SetIterationTime(timeAddition ? middle - start : cpuSeconds() - middle);
  }
}
void addNode(benchmark::State& state) {
  update(state, true);
}
void removeNode(benchmark::State& state) {
  update(state, false);
}

/// A tick in which one node enters the contact, and all tractions follow. It leaves untimed.
void tickWithOneAddition(benchmark::State& state) {
  const Contact contact(state);
  CapacitanceMatrix matrix = contact.matrix();
  const Eigen::VectorXd displacement = Eigen::VectorXd::LinSpaced(matrix.size() + 3, 1e-3, 2e-3);
  Eigen::VectorXd tractions(matrix.size() + 3);
  const std::vector<ConstraintSwitch> switches = switchesOfNodes({contact.other});
  const long before = test::allocationCount();
  for (auto _ : state) {
    const double start = cpuSeconds();
    matrix.add(switches.data(), 3);
    matrix.solve(displacement.data(), tractions.data());
    benchmark::ClobberMemory();
    state.SetIterationTime(cpuSeconds() - start);
    matrix.removeNode(contact.other);
  }
  state.counters["allocations"] = double(test::allocationCount() - before);
}

/// A tick in which one node of the contact leaves, another one enters, and all tractions follow.
void tickWithOneChange(benchmark::State& state) {
  const Contact contact(state);
  CapacitanceMatrix matrix = contact.matrix();
  const int size = matrix.size();
  const Eigen::VectorXd displacement = Eigen::VectorXd::LinSpaced(size, 1e-3, 2e-3);
  Eigen::VectorXd tractions(size);
  std::vector<std::vector<ConstraintSwitch>> switches;
  for (int node : contact.nodes) switches.push_back(switchesOfNodes({node}));
  switches.push_back(switchesOfNodes({contact.other}));
  std::size_t leaves = 0, enters = switches.size() - 1;  // what entered last leaves a round later
  const long before = test::allocationCount();
  for (auto _ : state) {
    matrix.removeNode(switches[leaves][0].node);
    matrix.add(switches[enters].data(), 3);
    matrix.solve(displacement.data(), tractions.data());
    benchmark::ClobberMemory();
    enters = leaves;
    leaves = (leaves + 1) % switches.size();
  }
  state.counters["allocations"] = double(test::allocationCount() - before);
}

/// A point in a random walk over the free surface: its haptic stiffness by interpolation, its
/// force.
void tickOfPointContact(benchmark::State& state) {
  const auto greens = sphereGreens(static_cast<int>(state.range(0)));
  const ElasticModel model = sphereModel(static_cast<int>(state.range(0)));
  const auto mesh = std::make_shared<SurfaceMesh>(model.mesh());
  const SurfaceStiffness stiffness(greens, mesh, MaskShape::Linear, 2 * mesh->meanEdgeLength());
  std::minstd_rand random(1);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), displacement(1e-3, 2e-3, -1e-3);
  const Eigen::Vector3d barycentric(0.2, 0.3, 0.5);
  const long before = test::allocationCount();
  for (auto _ : state) {
    const int triangle = static_cast<int>(random() % mesh->triangleCount());
    force = stiffness.hapticAt(triangle, barycentric) * displacement;
    benchmark::DoNotOptimize(force);
  }
  state.counters["allocations"] = double(test::allocationCount() - before);
}

/// All of fig. 8 at a contact that stays: force, elastic and haptic points.
void tickOfStickingContact(benchmark::State& state) {
  const auto greens = sphereGreens(static_cast<int>(state.range(0)));
  const ElasticModel model = sphereModel(static_cast<int>(state.range(0)));
  const auto mesh = std::make_shared<SurfaceMesh>(model.mesh());
  const auto stiffness = std::make_shared<SurfaceStiffness>(greens, mesh, MaskShape::Linear,
                                                            2 * mesh->meanEdgeLength());
  const PointContact contact(stiffness, nearestSurfacePoint(*mesh, {0.3, 0.2, 0.9}));
  const long before = test::allocationCount();
  for (auto _ : state) {
    const ContactResponse response = contact.displace({1e-3, 2e-3, -1e-3});
    benchmark::DoNotOptimize(response.elasticPoint.data());
    benchmark::ClobberMemory();
  }
  state.counters["allocations"] = double(test::allocationCount() - before);
}

/// The masks of all free vertices, radius of two mean edges; kind as in MaskKind, -1 the linear one
/// by geodesic distance.
void masksOfAllVertices(benchmark::State& state) {
  const ElasticModel model = sphereModel(static_cast<int>(state.range(0)));
  const int kind = static_cast<int>(state.range(1));
  const MaskSettings settings{static_cast<MaskKind>(std::max(0, kind)),
                              2 * model.mesh().meanEdgeLength(),
                              kind < 0 ? MaskDistance::Geodesic : MaskDistance::Euclidean};
  double nodes = 0;
  const std::vector<int> free = model.conditions().freeNodes();
  for (auto _ : state) {
    const auto masks = makeMasks(model.mesh(), model.conditions(), settings);
    nodes = 0;
    for (int v : free) nodes += double(masks->at(v).nodes.size()) / double(free.size());
  }
  state.counters["nodes"] = nodes;
}

/// The stiffnesses of all free vertices under such masks.
void stiffnessOfAllVertices(benchmark::State& state) {
  const auto greens = sphereGreens(static_cast<int>(state.range(0)));
  const ElasticModel model = sphereModel(static_cast<int>(state.range(0)));
  const auto mesh = std::make_shared<SurfaceMesh>(model.mesh());
  const auto masks = makeMasks(
      *mesh, model.conditions(),
      {static_cast<MaskKind>(state.range(1)), 2 * mesh->meanEdgeLength(), MaskDistance::Euclidean});
  for (auto _ : state) {
    const SurfaceStiffness stiffness(greens, mesh, *masks);
    benchmark::DoNotOptimize(stiffness.rigidStiffness());
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "s"})
      ->ArgsProduct({{162, 642}, {40, 100}})
      ->Unit(benchmark::kMicrosecond);
}
BENCHMARK(factorByEigen)->Apply(sizes);
BENCHMARK(factorByLapack)->Apply(sizes);
BENCHMARK(addNode)->Apply(sizes)->UseManualTime();
BENCHMARK(removeNode)->Apply(sizes)->UseManualTime();
BENCHMARK(tickWithOneAddition)->Apply(sizes)->UseManualTime();
BENCHMARK(tickWithOneChange)->Apply(sizes);
BENCHMARK(tickOfPointContact)->ArgName("n")->Arg(162)->Arg(642)->Unit(benchmark::kMicrosecond);
BENCHMARK(tickOfStickingContact)->ArgName("n")->Arg(162)->Arg(642)->Unit(benchmark::kMicrosecond);
BENCHMARK(masksOfAllVertices)
    ->ArgNames({"n", "kind"})
    ->ArgsProduct({{642, 2562}, {-1, 0, 4, 5}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(stiffnessOfAllVertices)
    ->ArgNames({"n", "kind"})
    ->ArgsProduct({{642}, {0, 4, 5}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace palpate::bench
