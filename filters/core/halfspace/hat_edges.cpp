// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "halfspace/hat_edges.h"

#include <map>

#include "halfspace/hat_integrals_kernel.h"

namespace palpate {
namespace {

/// Gauss-Legendre on [-1, 1] (Abramowitz & Stegun, table 25.4).
constexpr double kGaussPlaces[kHatGroup / 2] = {0.1834346424956498, 0.5255324099163290,
                                                0.7966664774136267, 0.9602898564975363};
constexpr double kGaussWeights[kHatGroup / 2] = {0.3626837833783620, 0.3137066458778873,
                                                 0.2223810344533745, 0.1012285362903763};

/// Edges or lines before they are put in groups; see HatEdge.
struct Edge {
  Eigen::Vector2d start, end;
  double slope, atStart, atEnd;
};

std::vector<double> inGroups(const std::vector<Edge>& edges) {
  const Edge idle{{3, 0}, {0, 3}, 0, 0, 0};
  const std::size_t groups = (edges.size() + kHatGroup - 1) / kHatGroup;
  std::vector<double> numbers(groups * kHatGroup * kHatEdgeSize);
  for (std::size_t i = 0; i < groups * kHatGroup; ++i) {
    const Edge& e = i < edges.size() ? edges[i] : idle;
    const double values[kHatEdgeSize] = {e.start.x(), e.start.y(), e.end.x(), e.end.y(),
                                         e.slope,     e.atStart,   e.atEnd};
    for (int which = 0; which < kHatEdgeSize; ++which)
      numbers[(i / kHatGroup * kHatEdgeSize + which) * kHatGroup + i % kHatGroup] = values[which];
  }
  return numbers;
}

/// The hat on the outer edge, where it is zero.
Edge outerEdge(const HatSector& sector) {
  return {sector.a, sector.b, (sector.b - sector.a).norm() / sector.doubleArea(), 0, 0};
}

/// Along the sector's sides, both outwards: what is on the left of a, and of b less what is on its
/// right.
Edge spokeA(const HatSector& s) {
  return {{0, 0}, s.a, (s.b - s.a).dot(s.a) / (s.a.norm() * s.doubleArea()), 1, 0};
}
Edge spokeB(const HatSector& s) {
  return {{0, 0}, s.b, (s.a - s.b).dot(s.b) / (s.b.norm() * s.doubleArea()), -1, 0};
}

}  // namespace

double HatSector::doubleArea() const {
  // From the two sides that are the shorter ones: the least rounding in needles.
  const Eigen::Vector2d outer = b - a;
  return outer.squaredNorm() < b.squaredNorm() ? a.x() * outer.y() - a.y() * outer.x()
                                               : a.x() * b.y() - a.y() * b.x();
}

int HatSector::apex() const {
  const double sides[] = {(b - a).squaredNorm(), b.squaredNorm(), a.squaredNorm()};
  return sides[0] >= sides[1] && sides[0] >= sides[2] ? 0 : sides[1] >= sides[2] ? 1 : 2;
}

Eigen::Vector2d HatSector::corner(int k) const {
  return k == 0 ? Eigen::Vector2d(0, 0) : k == 1 ? a : b;
}

double HatSector::longestSide() const {
  const int k = apex();
  return (corner((k + 1) % 3) - corner((k + 2) % 3)).norm();
}

std::vector<double> hatEdges(const std::vector<HatSector>& sectors) {
  std::vector<Edge> edges;
  std::map<int, Edge> spokes;  // by the vertex at their end
  const auto addSpoke = [&](int vertex, const Edge& edge) {
    const auto [spoke, isNew] = spokes.try_emplace(vertex, edge);
    if (isNew) return;
    spoke->second.slope += edge.slope;
    spoke->second.atStart += edge.atStart;
  };
  for (const HatSector& sector : sectors) {
    edges.push_back(outerEdge(sector));
    addSpoke(sector.aVertex, spokeA(sector));
    addSpoke(sector.bVertex, spokeB(sector));
  }
  for (const auto& [vertex, spoke] : spokes) edges.push_back(spoke);
  return inGroups(edges);
}

std::vector<double> needleEdges(const HatSector& sector) {
  return inGroups({outerEdge(sector), spokeA(sector), spokeB(sector)});
}

std::vector<double> needleLines(const HatSector& sector) {
  const int k = sector.apex(), sides[] = {(k + 1) % 3, (k + 2) % 3};
  const Eigen::Vector2d tip = sector.corner(k);
  const auto hat = [](int corner) { return corner == 0 ? 1. : 0.; };
  const Eigen::Vector2d side = sector.corner(sides[1]) - sector.corner(sides[0]);
  const double share = side.dot(tip - sector.corner(sides[0])) / side.squaredNorm();
  const Eigen::Vector2d foot = sector.corner(sides[0]) + share * side;
  const double atFoot = hat(sides[0]) + share * (hat(sides[1]) - hat(sides[0]));
  std::vector<Edge> lines;
  for (int part = 0; part < 2; ++part) {
    const Eigen::Vector2d start = sector.corner(sides[part]);
    const double doubleArea = (part == 0 ? share : 1 - share) * sector.doubleArea();
    for (int i = 0; i < kHatGroup; ++i) {
      const double place = (1 + (i % 2 ? 1 : -1) * kGaussPlaces[i / 2]) / 2;
      const Eigen::Vector2d end = foot + place * (tip - foot);
      lines.push_back({start, end,
                       doubleArea * kGaussWeights[i / 2] / 2 / (end - start).squaredNorm(),
                       hat(sides[part]), atFoot + place * (hat(k) - atFoot)});
    }
  }
  return inGroups(lines);
}

}  // namespace palpate
