// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/triangle_quadrature.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate::bem {
namespace {

/// Collects the orbits of points under the triangle's symmetries.
class RuleBuilder {
 public:
  RuleBuilder(int degree, int pointCount) : rule_{degree, {3, pointCount}, {}} {
    rule_.weights.resize(pointCount);
  }
  RuleBuilder& centroid(double weight) { return point(1.0 / 3, 1.0 / 3, weight); }
  /// (1 - 2b, b, b) and its permutations.
  RuleBuilder& triple(double b, double weight) {
    return point(1 - 2 * b, b, weight).point(b, 1 - 2 * b, weight).point(b, b, weight);
  }
  /// (a, b, 1 - a - b) and its permutations.
  RuleBuilder& sextuple(double a, double b, double weight) {
    const double c = 1 - a - b;
    return point(a, b, weight)
        .point(b, a, weight)
        .point(a, c, weight)
        .point(c, a, weight)
        .point(b, c, weight)
        .point(c, b, weight);
  }
  TriangleRule build() { return rule_; }

 private:
  RuleBuilder& point(double a, double b, double weight) {
    rule_.barycentric.col(count_) << a, b, 1 - a - b;
    rule_.weights[count_++] = weight;
    return *this;
  }
  TriangleRule rule_;
  int count_ = 0;
};

/// The classical rule of degree 5: the centroid and two triples (1 - 2b, b, b).
struct SevenPoints {
  double centroidWeight = 0.225;
  double b[2] = {(6 - std::sqrt(15.0)) / 21, (6 + std::sqrt(15.0)) / 21};
  double weight[2] = {(155 - std::sqrt(15.0)) / 1200, (155 + std::sqrt(15.0)) / 1200};
};

}  // namespace

TriangleRule triangleRule(int pointCount) {
  const SevenPoints seven;
  switch (pointCount) {
    case 3:
      return RuleBuilder(2, 3).triple(1.0 / 6, 1.0 / 3).build();
    case 7:
      return RuleBuilder(5, 7)
          .centroid(seven.centroidWeight)
          .triple(seven.b[0], seven.weight[0])
          .triple(seven.b[1], seven.weight[1])
          .build();
    case 16:
      return RuleBuilder(8, 16)
          .centroid(0.144315607677787)
          .triple(0.459292588292723, 0.095091634267285)
          .triple(0.170569307751760, 0.103217370534718)
          .triple(0.050547228317031, 0.032458497623198)
          .sextuple(0.008394777409958, 0.263112829634638, 0.027230314174435)
          .build();
    default:
      throw std::invalid_argument("there is no triangle rule with " + std::to_string(pointCount) +
                                  " points");
  }
}

void choosePanelRules(double tolerance, PanelRule& nearRule, PanelRule& farRule) {
  // A rule of degree m misses an integral of kernel times hat by c d^-m of its magnitude, and the
  // triangles around distance d weigh about 1/d in an equation: error = factor * d^-(m + 1), with d
  // from the centroid in triangle radii. The factor makes the patch tests meet the tolerance.
  constexpr double factor = 0.01;
  const double reachable =
      std::max(tolerance, 1e-13);  // beyond, closed forms lose more to rounding
  const auto distance = [&](int degree) {
    return std::max(std::pow(factor / reachable, 1.0 / (degree + 1)), 1.5);
  };
  const SevenPoints seven;
  nearRule = {seven.centroidWeight,
              {seven.weight[0], seven.weight[1]},
              {1 - 2 * seven.b[0], 1 - 2 * seven.b[1]},
              distance(5)};
  farRule = {0, {1.0 / 3, 0}, {2.0 / 3, 0}, distance(2)};
}

}  // namespace palpate::bem
