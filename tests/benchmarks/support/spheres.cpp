// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/spheres.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "bem/boundary_element_method.h"
#include "greens/dense_greens_functions.h"
#include "support/problems.h"
#include "support/shapes.h"

namespace palpate::bench {

ElasticModel sphereModel(int vertices) {
  int levels = 0, n = 12;
  for (; n < vertices; n = 4 * n - 6) ++levels;
  const double edge = std::sqrt(4 * 3.14159265358979323846 / (0.866 * vertices));
  const test::Shape shape = n == vertices ? test::icosphere(levels)
                                          : test::ringedSphere([&](double) { return edge; }, {});
  return test::makeModel(
      shape, [](const Eigen::Vector3d& x) { return x.z() < -0.79; }, 1, 0.3);
}

std::shared_ptr<const GreensFunctions> sphereGreens(int vertices) {
  static std::map<int, std::shared_ptr<const GreensFunctions>> known;
  std::shared_ptr<const GreensFunctions>& greens = known[vertices];
  if (!greens) {
    BoundaryElementOptions options;
    options.threads = 1;
    greens = computeBoundaryElementGreensFunctions(sphereModel(vertices), options).take();
  }
  return greens;
}

template <class Scalar>
std::shared_ptr<const GreensFunctions> randomGreens(int nodes) {
  GreensFunctionsInfo info;
  info.conditions = BoundaryConditions(std::vector<unsigned char>(nodes, 0));
  info.material = Material(1, 0.3);
  info.vertexAreas = Eigen::VectorXd::Constant(nodes, 1.0 / nodes);
  for (int node = 0; node < nodes; ++node) info.columnNodes.push_back(node);
  AlignedBuffer<Scalar> matrix(9 * std::size_t(nodes) * nodes);
  std::minstd_rand random(1);
  for (std::size_t i = 0; i < matrix.size(); ++i)
    matrix.data()[i] = static_cast<Scalar>(random()) / static_cast<Scalar>(random.max());
  return std::make_shared<DenseGreensFunctions<Scalar>>(std::move(info), std::move(matrix));
}

template std::shared_ptr<const GreensFunctions> randomGreens<double>(int);
template std::shared_ptr<const GreensFunctions> randomGreens<float>(int);

std::vector<int> scatteredFreeNodes(const GreensFunctions& greens, int count) {
  std::vector<int> nodes = greens.info().conditions.freeNodes();
  std::shuffle(nodes.begin(), nodes.end(), std::minstd_rand(1));
  nodes.resize(std::min<std::size_t>(count, nodes.size()));
  return nodes;
}

}  // namespace palpate::bench
