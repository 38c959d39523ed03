// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "halfspace/hat_integrals.h"

#include <algorithm>
#include <limits>

#include "halfspace/hat_edges.h"
#include "halfspace/hat_integrals_kernel.h"
#include "halfspace/point_loads.h"
#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void addHatEdges(const double*, int, double, double, double*))
PALPATE_DECLARE_KERNEL(void addLineLoads(const double*, int, double, double, double*))
PALPATE_DECLARE_KERNEL(void addPointLoads(const double*, const double*, int, double, double,
                                          double*))

void addHatEdges(const double* edges, int groupCount, double x, double y, double* moments) {
  PALPATE_DISPATCH(addHatEdges(edges, groupCount, x, y, moments))
}
void addLineLoads(const double* lines, int groupCount, double x, double y, double* moments) {
  PALPATE_DISPATCH(addLineLoads(lines, groupCount, x, y, moments))
}
void addPointLoads(const double* places, const double* loads, int groupCount, double x, double y,
                   double* moments) {
  PALPATE_DISPATCH(addPointLoads(places, loads, groupCount, x, y, moments))
}

namespace {

/// Two sizes of error, two numbers of loads: degrees 8 and 5, with radii that make errors small.
const PointLoads& midLoads() {
  static const PointLoads loads(8, {0.85, 0.75, 0.55, 0.3, 0});
  return loads;
}
const PointLoads& farLoads() {
  static const PointLoads loads(5, {0.75, 0.55, 0.25});
  return loads;
}

/// Squared distance of x from a counter-clockwise triangle; 0 within it.
double squaredDistance(const Eigen::Matrix<double, 2, 3>& corners, double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  bool isInside = true;
  for (int k = 0; k < 3; ++k) {
    const int next = k < 2 ? k + 1 : 0;
    const double ex = corners(0, next) - corners(0, k), ey = corners(1, next) - corners(1, k);
    const double dx = x - corners(0, k), dy = y - corners(1, k);
    isInside = isInside && ex * dy - ey * dx >= 0;
    const double share = std::max(0., std::min(1., (dx * ex + dy * ey) / (ex * ex + ey * ey)));
    const double offX = dx - share * ex, offY = dy - share * ey;
    nearest = std::min(nearest, offX * offX + offY * offY);
  }
  return isInside ? 0 : nearest;
}

}  // namespace

HatIntegrals::HatIntegrals(const Eigen::Matrix2Xd& points, const Eigen::Matrix3Xi& triangles)
    : points_(points),
      hats_(points.cols()),
      midLoads_(midLoads().size(), points.cols()),
      farLoads_(farLoads().size(), points.cols()) {
  std::vector<std::vector<Eigen::Vector2i>> ends(points.cols());
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      ends[triangles(k, f)].emplace_back(triangles((k + 1) % 3, f), triangles((k + 2) % 3, f));
  for (int v = 0; v < points.cols(); ++v) setHat(v, ends[v]);
}

void HatIntegrals::setHat(int vertex, const std::vector<Eigen::Vector2i>& ends) {
  Hat& hat = hats_[vertex];
  for (const Eigen::Vector2i& pair : ends)
    for (int end : pair)
      hat.radius = std::max(hat.radius, (points_.col(end) - points_.col(vertex)).norm());
  hat.inverseRadius = 1 / hat.radius;
  // As at() does it, so that at a vertex of the hat x is an edge's end to the last bit.
  const auto place = [&](int end) -> Eigen::Vector2d {
    return hat.inverseRadius * (points_.col(end) - points_.col(vertex));
  };
  std::vector<HatSector> sectors;
  for (const Eigen::Vector2i& pair : ends)
    sectors.push_back({place(pair[0]), place(pair[1]), pair[0], pair[1]});
  midLoads_.col(vertex) = midLoads().loadsOf(sectors);
  farLoads_.col(vertex) = farLoads().loadsOf(sectors);

  const auto store = [&](const std::vector<double>& numbers) {
    const std::size_t first = numbers_.size();
    numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
    return first;
  };
  const bool hasNeedles = std::any_of(sectors.begin(), sectors.end(), [](const HatSector& sector) {
    return sector.longestSide() > kNeedle * sector.height();
  });
  if (!hasNeedles) {
    const std::vector<double> edges = hatEdges(sectors);
    hat.edgeGroups = static_cast<int>(edges.size() / (kHatEdgeSize * kHatGroup));
    hat.edges = store(edges);
    return;
  }
  hat.firstNeedle = static_cast<int>(needles_.size());
  hat.needleCount = static_cast<int>(sectors.size());
  for (const HatSector& sector : sectors) {
    Needle needle;
    for (int k = 0; k < 3; ++k) needle.corners.col(k) = sector.corner(k);
    needle.height = sector.height();
    needle.edges = store(needleEdges(sector));
    needle.lines = store(needleLines(sector));
    needles_.push_back(needle);
  }
}

void HatIntegrals::addNeedles(const Hat& hat, double x, double y, double* moments) const noexcept {
  for (int i = hat.firstNeedle; i < hat.firstNeedle + hat.needleCount; ++i) {
    const Needle& needle = needles_[i];
    if (squaredDistance(needle.corners, x, y) < needle.height * needle.height)
      addHatEdges(&numbers_[needle.edges], 1, x, y, moments);
    else
      addLineLoads(&numbers_[needle.lines], 2, x, y, moments);
  }
}

HatMoments HatIntegrals::at(const Eigen::Vector2d& x, int index) const noexcept {
  const Hat& hat = hats_[index];
  const Eigen::Vector2d place = hat.inverseRadius * (x - points_.col(index));
  const double distance = place.squaredNorm();
  double sums[5] = {0, 0, 0, 0, 0};
  const auto addLoads = [&](const PointLoads& loads, const Eigen::MatrixXd& sizes) {
    addPointLoads(loads.places(), sizes.col(index).data(), loads.groupCount(), place.x(), place.y(),
                  sums);
  };
  if (distance >= kFar * kFar)
    addLoads(farLoads(), farLoads_);
  else if (distance >= kNear * kNear)
    addLoads(midLoads(), midLoads_);
  else if (hat.needleCount > 0)
    addNeedles(hat, place.x(), place.y(), sums);
  else
    addHatEdges(&numbers_[hat.edges], hat.edgeGroups, place.x(), place.y(), sums);
  return {hat.radius * sums[0], hat.radius * sums[1], hat.radius * sums[2], hat.radius * sums[3],
          hat.radius * sums[4]};
}

std::size_t HatIntegrals::bytes() const {
  return sizeof(double) * (points_.size() + numbers_.size() + midLoads_.size() + farLoads_.size()) +
         sizeof(Hat) * hats_.size() + sizeof(Needle) * needles_.size();
}

}  // namespace palpate
