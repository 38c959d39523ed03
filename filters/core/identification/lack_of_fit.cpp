// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "sentence.h"

namespace palpate {
namespace {

constexpr std::size_t kMostMarkers = 3000;  // under a probe: neighbours cost their square
constexpr std::size_t kNearest = 6;
constexpr int kChanges = 1999;
constexpr double kByChance = 0.001;
constexpr double kRounding = 1e-6, kBeyondInterpolation = 10;

/// Adds each point with those nearest to it, the smaller number first.
void addNearest(const std::vector<int>& points, const Eigen::Matrix3Xd& places,
                std::set<std::array<int, 2>>& pairs) {
  std::vector<std::pair<double, int>> others;
  for (int point : points) {
    others.clear();
    for (int other : points)
      if (other != point)
        others.emplace_back((places.col(other) - places.col(point)).squaredNorm(), other);
    const std::size_t count = std::min(kNearest, others.size());
    std::partial_sort(others.begin(), others.begin() + count, others.end());
    for (std::size_t i = 0; i < count; ++i)
      pairs.insert({std::min(point, others[i].second), std::max(point, others[i].second)});
  }
}

}  // namespace

MarkerNeighbours::MarkerNeighbours(const Measurements& measurements,
                                   const Eigen::Matrix3Xd& places) {
  std::map<std::array<double, 3>, int> known;
  std::vector<std::vector<std::array<int, 2>>> seen(measurements.probes.size());  // place and row
  std::vector<int> rowOf;  // the first of a place
  for (int row = 0; row < int(places.cols()); ++row) {
    const auto [place, isNew] = known.emplace(
        std::array{places(0, row), places(1, row), places(2, row)}, int(rowOf.size()));
    if (isNew) rowOf.push_back(row);
    seen[measurements.displacements[row].probe].push_back({place->second, row});
  }
  const Eigen::Matrix3Xd once = places(Eigen::all, rowOf);
  sights_.resize(rowOf.size());
  std::set<std::array<int, 2>> pairs;
  for (int probe = 0; probe < int(seen.size()); ++probe) {
    const std::size_t stride = seen[probe].size() / kMostMarkers + 1;
    std::vector<int> points;
    for (std::size_t i = 0; i < seen[probe].size(); i += stride) {
      const auto [place, row] = seen[probe][i];
      if (!sights_[place].empty() && sights_[place].back().probe == probe) continue;
      points.push_back(place);
      sights_[place].push_back({probe, row});
    }
    addNearest(points, once, pairs);
  }
  pairs_.assign(pairs.begin(), pairs.end());
}

Eigen::VectorXd MarkerNeighbours::products(const Eigen::VectorXd& residuals, double& size) const {
  Eigen::VectorXd products = Eigen::VectorXd::Zero(pairs_.size());
  size = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const std::vector<Sight>&a = sights_[pairs_[i][0]], &b = sights_[pairs_[i][1]];
    for (std::size_t m = 0, n = 0; m < a.size() && n < b.size();) {
      if (a[m].probe != b[n].probe) {
        a[m].probe < b[n].probe ? ++m : ++n;
        continue;
      }
      const Eigen::Vector3d here = residuals.segment<3>(3 * a[m++].row),
                            there = residuals.segment<3>(3 * b[n++].row);
      products[i] += here.dot(there);
      size += here.norm() * there.norm();
    }
  }
  return products;
}

NeighbourCorrelation neighbourCorrelation(const MarkerNeighbours& neighbours,
                                          const Eigen::VectorXd& residuals) {
  double size;
  const Eigen::VectorXd products = neighbours.products(residuals, size);
  NeighbourCorrelation result;
  if (!(size > 0)) return result;
  result.correlation = products.sum() / size;
  const double least = products.sum() - 1e-12 * products.cwiseAbs().sum();
  std::mt19937 random(1);
  std::vector<double> signs(neighbours.placeCount());
  int asMuch = 0;
  for (int change = 0; change < kChanges; ++change) {
    for (double& sign : signs) sign = random() % 2 == 0 ? 1 : -1;
    double sum = 0;
    for (Eigen::Index i = 0; i < products.size(); ++i) {
      const auto [a, b] = neighbours.pairs()[i];
      sum += signs[a] * signs[b] * products[i];
    }
    asMuch += sum >= least;
  }
  result.byChance = (asMuch + 1.0) / (kChanges + 1.0);
  return result;
}

void warnOfLackOfFit(MaterialIdentification& result) {
  const NeighbourCorrelation& found = result.neighbours;
  if (found.byChance > kByChance ||
      result.fitError <= std::max(kRounding, kBeyondInterpolation * result.interpolationError))
    return;
  double factor = 0;
  for (const IdentifiedParameter& p : result.parameters)
    if (p.deviation > 0) factor = std::max(factor, p.probewiseDeviation / p.deviation);
  const std::string times =
      factor > 1 ? sentence(": by what leaving out each probe changes, up to ", shortly(factor),
                            " times, and what is wrong under all probes alike is in neither")
                 : std::string();
  result.warnings.push_back(sentence(
      "residuals of neighbouring markers go together (correlation ", shortly(found.correlation),
      "), as in less than one of 1000 tables of noise: the model differs from the body, as where a "
      "mesh is coarse, stiffness is not uniform or the support not firm, or contacts or the "
      "registration are inexact. Deviations and intervals, which are of noise alone, are too small",
      times, "; compare a finer mesh first, then let vary what may differ"));
}

}  // namespace palpate
