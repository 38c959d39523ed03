// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_system.h"

#include <algorithm>
#include <cstdint>
#include <Eigen/Geometry>
#include <stdexcept>

#include "greens/rigid_motions.h"

namespace palpate::fem {
namespace {

/// Beyond so many nearly incompressible materials pressures are continuous across all of them.
constexpr int kMostPressureGroups = 16;
constexpr int kCellsPerReport = 4096;

/// Blocks of the stiffness matrix, one a pair of nodes that share a cell.
class NodeBlocks {
 public:
  explicit NodeBlocks(const Eigen::MatrixXi& cells) {
    pairs_.reserve(std::size_t(cells.cols()) * cells.rows() * (cells.rows() + 1) / 2);
    for (const auto& cell : cells.colwise())
      for (int i : cell)
        for (int j : cell)
          if (i >= j) pairs_.push_back(key(i, j));
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    blocks_.assign(pairs_.size(), Eigen::Matrix3d::Zero());
  }

  Eigen::Matrix3d& at(int row, int column) {
    return blocks_[std::lower_bound(pairs_.begin(), pairs_.end(), key(row, column)) -
                   pairs_.begin()];
  }
  std::size_t size() const { return pairs_.size(); }
  int row(std::size_t i) const { return static_cast<int>(pairs_[i] >> 32); }
  int column(std::size_t i) const { return static_cast<int>(pairs_[i] & 0xffffffff); }
  const Eigen::Matrix3d& block(std::size_t i) const { return blocks_[i]; }

 private:
  static std::uint64_t key(int row, int column) { return (std::uint64_t(row) << 32) | column; }

  std::vector<std::uint64_t> pairs_;
  std::vector<Eigen::Matrix3d> blocks_;
};

/// Six springs that hold a body and no more: three at the vertex that is farthest from its middle,
/// two at the one farthest from there, one at that farthest from the line through both.
std::vector<std::pair<int, Eigen::Vector3d>> determinateSprings(const SurfaceMesh& mesh, int body) {
  std::vector<int> vertices;
  for (int v = 0; v < mesh.vertexCount(); ++v)
    if (mesh.bodyOfVertex(v) == body) vertices.push_back(v);
  const auto farthest = [&](const auto& distance) {
    return *std::max_element(vertices.begin(), vertices.end(),
                             [&](int a, int b) { return distance(a) < distance(b); });
  };
  const Eigen::Vector3d middle = mesh.points()(Eigen::all, vertices).rowwise().mean();
  const auto point = [&](int v) -> Eigen::Vector3d { return mesh.points().col(v); };
  const int first = farthest([&](int v) { return (point(v) - middle).norm(); });
  const int second = farthest([&](int v) { return (point(v) - point(first)).norm(); });
  const Eigen::Vector3d along = (point(second) - point(first)).normalized();
  const int third = farthest([&](int v) { return along.cross(point(v) - point(first)).norm(); });
  const Eigen::Vector3d normal = along.cross(point(third) - point(first)).normalized();
  return {{first, Eigen::Vector3d::UnitX()}, {first, Eigen::Vector3d::UnitY()},
          {first, Eigen::Vector3d::UnitZ()}, {second, normal},
          {second, normal.cross(along)},     {third, normal}};
}

int groupOf(const SolidBody& body, int cell) {
  return body.materialCount() <= kMostPressureGroups ? body.materialNumber(cell) : 0;
}

}  // namespace

SolidSystem::SolidSystem(const ElasticModel& model, const SolidBody& body, SolidElement element,
                         std::vector<LoadHat> loadHats, HeldDisplacements heldOnes,
                         const std::vector<SolidProbe>& probes, const Progress& progress)
    : length(model.mesh().diagonal()),
      stiffness(body.largestStiffness()),
      hats(std::move(loadHats)),
      fixedVertices(model.conditions().fixedNodes()),
      held(std::move(heldOnes)) {
  const SolidNodes nodes(body.mesh(), element);
  placePressures(body);
  if (pressureCount > 0 && element == SolidElement::Linear)
    throw std::invalid_argument(
        "linear tetrahedra lock in nearly incompressible materials (Poisson's ratio from 0.45 on): "
        "use quadratic ones");
  placeNodes(model, body, nodes);
  addCells(body, nodes, element, progress);
  addHats(model, body, nodes);
  if (model.domain() == Domain::Unsupported) addSprings(model.mesh(), body);
  addWeight(body, nodes, element);
  addProbes(body, nodes, element, probes);
}

void SolidSystem::placePressures(const SolidBody& body) {
  for (int cell = 0; cell < body.mesh().cellCount(); ++cell)
    if (body.material(cell).isSplit())
      for (int point : body.mesh().tetrahedra().col(cell))
        pressures_.emplace_back(point, groupOf(body, cell));
  std::sort(pressures_.begin(), pressures_.end());
  pressures_.erase(std::unique(pressures_.begin(), pressures_.end()), pressures_.end());
  pressureCount = static_cast<int>(pressures_.size());
}

int SolidSystem::pressurePlace(const SolidBody& body, int cell, int corner) const {
  const std::pair<int, int> key(body.mesh().tetrahedra()(corner, cell), groupOf(body, cell));
  return firstPressure_ +
         static_cast<int>(std::lower_bound(pressures_.begin(), pressures_.end(), key) -
                          pressures_.begin());
}

void SolidSystem::placeNodes(const ElasticModel& model, const SolidBody& body,
                             const SolidNodes& nodes) {
  places_.resize(3 * nodes.count);
  std::vector<bool> isGiven(3 * nodes.count, false);
  const auto forGivenMiddles = [&](const auto& act) {
    const Eigen::Matrix3Xi& triangles = model.mesh().triangles();
    for (int f = 0; f < model.mesh().triangleCount(); ++f)
      for (int i = 0; i < 3; ++i) {
        const int a = body.pointOfVertex(triangles(i, f));
        const int b = body.pointOfVertex(triangles((i + 1) % 3, f));
        const int middle = nodes.middle(a, b);
        for (int k = 0; k < 3 && middle >= 0; ++k)
          if (isGiven[3 * a + k] && isGiven[3 * b + k]) act(3 * middle + k, 3 * a + k, 3 * b + k);
      }
  };
  for (int v = 0; v < model.mesh().vertexCount(); ++v)
    for (int k = 0; k < 3; ++k)
      isGiven[3 * body.pointOfVertex(v) + k] = model.conditions().isFixed(v) || isHeldAlong(k, v);
  forGivenMiddles([&](int at, int, int) { isGiven[at] = true; });
  int next = 0;
  for (int at = 0; at < 3 * nodes.count; ++at)
    if (!isGiven[at]) places_[at].place[0] = next++;
  firstPressure_ = next;
  firstHat_ = firstPressure_ + pressureCount;
  next = firstHat_ + 3 * static_cast<int>(hats.size());
  for (int v : fixedVertices)
    for (int k = 0; k < 3; ++k) places_[3 * body.pointOfVertex(v) + k].place[0] = next++;
  forGivenMiddles([&](int at, int a, int b) {
    NodePlace& middle = places_[at];
    middle = {{places_[a].place[0], places_[b].place[0]}, 0.5};
    if (middle.place[0] < 0) std::swap(middle.place[0], middle.place[1]);
  });
  entries.size = next;
}

void SolidSystem::addCells(const SolidBody& body, const SolidNodes& nodes, SolidElement element,
                           const Progress& progress) {
  NodeBlocks blocks(nodes.cells);
  ElementMatrices matrices;
  for (int cell = 0; cell < body.mesh().cellCount(); ++cell) {
    if (cell % kCellsPerReport == 0)
      progress.report(double(cell) / body.mesh().cellCount(), "assemble");
    Eigen::Matrix<double, 3, 4> corners;
    for (int k = 0; k < 4; ++k)
      corners.col(k) = body.mesh().points().col(body.mesh().tetrahedra()(k, cell)) / length;
    const Elasticity& material = body.material(cell);
    integrateElement(corners, element, material.stiffness() / stiffness, material.isSplit(),
                     matrices);
    const auto node = nodes.cells.col(cell);
    for (int i = 0; i < nodes.perCell(); ++i)
      for (int j = 0; j < nodes.perCell(); ++j)
        if (node[i] >= node[j])
          blocks.at(node[i], node[j]) += matrices.stiffness.block<3, 3>(3 * i, 3 * j);
    for (int v = 0; material.isSplit() && v < 4; ++v) {
      const int row = pressurePlace(body, cell, v);
      for (int u = 0; u <= v; ++u)
        entries.add(row, pressurePlace(body, cell, u),
                    -matrices.mass(v, u) * material.compressibility() * stiffness);
      for (int i = 0; i < nodes.perCell(); ++i)
        for (int k = 0; k < 3; ++k) {
          const NodePlace& at = placeOf(node[i], k);
          for (int end = 0; end < at.count(); ++end)
            entries.add(row, at.place[end], at.weight * matrices.divergence(v, 3 * i + k));
        }
    }
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        const NodePlace &row = placeOf(blocks.row(i), k), &column = placeOf(blocks.column(i), l);
        const bool isDiagonal = blocks.row(i) == blocks.column(i);
        const double value = row.weight * column.weight * blocks.block(i)(k, l);
        for (int r = 0; r < row.count(); ++r)
          for (int c = 0; c < column.count(); ++c) {
            const int a = row.place[r], b = column.place[c];
            // A node's own block holds both halves of the matrix, that of two nodes stands for its
            // transpose, too.
            if (isDiagonal && a < b) continue;
            entries.add(a, b, !isDiagonal && a == b ? 2 * value : value);
          }
      }
}

void SolidSystem::addWeight(const SolidBody& body, const SolidNodes& nodes, SolidElement element) {
  loadCount += 3;
  std::vector<double> weights(nodes.count, 0);  // of each node, as of one at its place
  const double corner = element == SolidElement::Linear ? 1.0 / 4 : -1.0 / 20, middle = 1.0 / 5;
  for (int cell = 0; cell < body.mesh().cellCount(); ++cell) {
    const double weight =
        body.relativeDensity(cell) * body.mesh().volumes()[cell] / (length * length * length);
    for (int i = 0; i < nodes.perCell(); ++i)
      weights[nodes.cells(i, cell)] += weight * (i < 4 ? corner : middle);
  }
  for (int node = 0; node < nodes.count; ++node)
    for (int k = 0; k < 3; ++k) {
      const NodePlace& at = placeOf(node, k);
      for (int end = 0; end < at.count(); ++end)
        entries.add(entries.size + k, at.place[end], -at.weight * weights[node]);
    }
  entries.size += 3;
}

void SolidSystem::addProbes(const SolidBody& body, const SolidNodes& nodes, SolidElement element,
                            const std::vector<SolidProbe>& probes) {
  probeCount = static_cast<int>(probes.size());
  for (const SolidProbe& probe : probes) {
    const auto cell = body.mesh().tetrahedra().col(probe.cell);
    const Eigen::Matrix<double, 3, 4> corners = body.mesh().points()(Eigen::all, cell) / length;
    Eigen::VectorXd values;
    Eigen::Matrix3Xd slopes;
    shapeFunctions(element, probe.barycentric, barycentricGradients(corners), values, slopes);
    const int row = entries.size;
    for (int i = 0; i < nodes.perCell(); ++i)
      for (int k = 0; k < 3; ++k) {
        const NodePlace& at = placeOf(nodes.cells(i, probe.cell), k);
        for (int end = 0; end < at.count(); ++end) {
          entries.add(row + k, at.place[end], -at.weight * values[i]);
          for (int l = 0; l < 3; ++l)
            entries.add(row + 3 + 3 * k + l, at.place[end], -at.weight * slopes(l, i));
        }
      }
    for (int v = 0; body.material(probe.cell).isSplit() && v < 4; ++v)
      entries.add(row + 12, pressurePlace(body, probe.cell, v), -probe.barycentric[v]);
    entries.size += 13;
  }
}

void SolidSystem::addSprings(const SurfaceMesh& mesh, const SolidBody& body) {
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(mesh);
  loadCount = static_cast<int>(motions.cols());
  for (int k = 0; k < mesh.bodyCount(); ++k)
    for (const auto& [vertex, direction] : determinateSprings(mesh, k)) {
      const int place = placeOf(body.pointOfVertex(vertex), 0).place[0];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) entries.add(place + i, place + j, direction[i] * direction[j]);
        const Eigen::RowVectorXd load =
            direction[i] * (direction.transpose() * motions.middleRows<3>(3 * vertex));
        for (int m = 0; m < loadCount; ++m)
          if (load[m] != 0) entries.add(entries.size + m, place + i, -load[m]);
      }
    }
  entries.size += loadCount;
}

void SolidSystem::addHats(const ElasticModel& model, const SolidBody& body,
                          const SolidNodes& nodes) {
  const SurfaceMesh& mesh = model.mesh();
  std::vector<std::vector<int>> hatsOf(mesh.vertexCount());
  for (std::size_t h = 0; h < hats.size(); ++h)
    hatsOf[hats[h].vertex].push_back(static_cast<int>(h));
  std::vector<Eigen::Triplet<double>> products;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const double area = mesh.triangleAreas()[f] / (length * length);
    for (int i = 0; i < 3; ++i) {
      const int vertex = mesh.triangles()(i, f);
      for (int j = 0; j < 3; ++j)
        products.emplace_back(vertex, mesh.triangles()(j, f), area / (i == j ? 6 : 12));
      for (int h : hatsOf[vertex]) {
        if (hats[h].patch >= 0 && hats[h].patch != model.smoothPatches()[f]) continue;
        const auto load = [&](int node, double integral) {
          for (int k = 0; k < 3; ++k) {
            const NodePlace& at = placeOf(node, k);
            for (int end = 0; !isHeldAlong(k, vertex) && end < at.count(); ++end)
              entries.add(firstHat_ + 3 * h + k, at.place[end], at.weight * area * integral);
          }
        };
        for (int j = 0; j < 3; ++j) {
          const int corner = body.pointOfVertex(mesh.triangles()(j, f));
          const int next = body.pointOfVertex(mesh.triangles()((j + 1) % 3, f));
          const int middle = nodes.middle(corner, next);
          if (middle < 0) {
            load(corner, j == i ? 1.0 / 6 : 1.0 / 12);
          } else {
            load(corner, j == i ? 1.0 / 30 : -1.0 / 60);
            load(middle, j == i || (j + 1) % 3 == i ? 2.0 / 15 : 1.0 / 15);
          }
        }
      }
    }
  }
  hatProducts.resize(mesh.vertexCount(), mesh.vertexCount());
  hatProducts.setFromTriplets(products.begin(), products.end());
}

SplitEntries::SplitEntries(const SymmetricEntries& all, int first) {
  own.size = first;
  std::vector<Eigen::Triplet<double>> couplings, corners;
  for (std::size_t i = 0; i < all.value.size(); ++i) {
    const int row = all.row[i], column = all.column[i];
    if (row < first)
      own.add(row, column, all.value[i]);
    else if (column < first)
      couplings.emplace_back(row - first, column, all.value[i]);
    else
      corners.emplace_back(row - first, column - first, all.value[i]);
  }
  const int kept = all.size - first;
  coupling.resize(kept, first);
  coupling.setFromTriplets(couplings.begin(), couplings.end());
  corner.resize(kept, kept);
  corner.setFromTriplets(corners.begin(), corners.end());
}

void requireHeld(const SparseFactorization& factored, int pressureCount) {
  if (factored.negativePivots() != pressureCount)
    throw std::runtime_error("the sparse system is singular: a part of the body is not held");
}

}  // namespace palpate::fem
