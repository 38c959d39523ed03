// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_system.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

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

int groupOf(const SolidBody& body, int cell) {
  return body.materialCount() <= kMostPressureGroups ? body.materialNumber(cell) : 0;
}

}  // namespace

SolidSystem::SolidSystem(const ElasticModel& model, const SolidBody& body, SolidElement element,
                         std::vector<LoadHat> loadHats, const Progress& progress)
    : length(model.mesh().diagonal()),
      stiffness(body.largestStiffness()),
      hats(std::move(loadHats)),
      fixedVertices(model.conditions().fixedNodes()) {
  const SolidNodes nodes(body.mesh(), element);
  placePressures(body);
  if (pressureCount > 0 && element == SolidElement::Linear)
    throw std::invalid_argument(
        "linear tetrahedra lock in nearly incompressible materials (Poisson's ratio from 0.45 on): "
        "use quadratic ones");
  placeNodes(model, body, nodes);
  addCells(body, nodes, element, progress);
  addLoads(model, body, nodes);
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
  places_.resize(nodes.count);
  std::vector<bool> isHeld(nodes.count, false);
  const Eigen::Matrix3Xi& triangles = model.mesh().triangles();
  for (int v : fixedVertices) isHeld[body.pointOfVertex(v)] = true;
  const auto forFixedEdges = [&](const auto& act) {
    for (int f = 0; f < model.mesh().triangleCount(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int a = triangles(k, f), b = triangles((k + 1) % 3, f);
        if (!model.conditions().isFixed(a) || !model.conditions().isFixed(b)) continue;
        const int middle = nodes.middle(body.pointOfVertex(a), body.pointOfVertex(b));
        if (middle >= 0) act(middle, body.pointOfVertex(a), body.pointOfVertex(b));
      }
  };
  forFixedEdges([&](int middle, int, int) { isHeld[middle] = true; });
  int next = 0;
  for (int node = 0; node < nodes.count; ++node)
    if (!isHeld[node]) {
      places_[node].place[0] = next;
      next += 3;
    }
  firstPressure_ = next;
  firstHat_ = firstPressure_ + pressureCount;
  next = firstHat_ + 3 * static_cast<int>(hats.size());
  for (int v : fixedVertices) {
    places_[body.pointOfVertex(v)].place[0] = next;
    next += 3;
  }
  forFixedEdges([&](int middle, int a, int b) {
    places_[middle].place[0] = places_[a].place[0];
    places_[middle].place[1] = places_[b].place[0];
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
        for (int end = 0; end < places_[node[i]].count(); ++end)
          for (int k = 0; k < 3; ++k)
            entries.add(row, places_[node[i]].place[end] + k,
                        places_[node[i]].weight() * matrices.divergence(v, 3 * i + k));
    }
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const NodePlace &row = places_[blocks.row(i)], &column = places_[blocks.column(i)];
    const bool isDiagonal = blocks.row(i) == blocks.column(i);
    const double weight = row.weight() * column.weight();
    for (int r = 0; r < row.count(); ++r)
      for (int c = 0; c < column.count(); ++c)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) {
            const int a = row.place[r] + k, b = column.place[c] + l;
            const double value = weight * blocks.block(i)(k, l);
            // A node's own block holds both halves of the matrix, that of two nodes stands for its
            // transpose, too.
            if (isDiagonal && a < b) continue;
            entries.add(a, b, !isDiagonal && a == b ? 2 * value : value);
          }
  }
}

void SolidSystem::addLoads(const ElasticModel& model, const SolidBody& body,
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
          const NodePlace& at = places_[node];
          for (int end = 0; end < at.count(); ++end)
            for (int k = 0; k < 3; ++k)
              entries.add(firstHat_ + 3 * h + k, at.place[end] + k, at.weight() * area * integral);
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

}  // namespace palpate::fem
