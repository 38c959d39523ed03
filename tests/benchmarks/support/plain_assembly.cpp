// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/plain_assembly.h"

#include <Eigen/Dense>

#include "bem/kelvin.h"

namespace palpate::bench {

PlainAssembly::PlainAssembly(const bem::BodySurface& body, const bem::CollocationScheme& scheme,
                             double tolerance)
    : body_(body),
      scheme_(scheme),
      seven_(bem::triangleRule(7)),
      three_(bem::triangleRule(3)),
      radius_(body.triangleCount()),
      centroid_(3, body.triangleCount()) {
  bem::PanelRule nearRule, farRule;
  bem::choosePanelRules(tolerance, nearRule, farRule);
  nearDistance_ = nearRule.smallestDistance;
  farDistance_ = farRule.smallestDistance;
  for (int f = 0; f < body.triangleCount(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = body.points.col(body.triangles(k, f));
    centroid_.col(f) = body.centroid(f);
    radius_[f] = (corners.colwise() - centroid_.col(f)).colwise().norm().maxCoeff();
    sevenPoints_.push_back(corners * seven_.barycentric);
    threePoints_.push_back(corners * three_.barycentric);
  }
}

void PlainAssembly::integrate(const Eigen::Vector3d& x, Rows& h, Rows& g) const {
  for (int f = 0; f < body_.triangleCount(); ++f) {
    const double distance = (centroid_.col(f) - x).norm() / radius_[f];
    if (distance < nearDistance_) continue;
    const bool isFar = distance >= farDistance_;
    const bem::TriangleRule& rule = isFar ? three_ : seven_;
    const Eigen::Matrix3Xd& points = isFar ? threePoints_[f] : sevenPoints_[f];
    const Eigen::Vector3d normal = body_.normals.col(f);
    Eigen::Matrix3d t[3], u[3];
    for (int k = 0; k < 3; ++k) t[k] = u[k] = Eigen::Matrix3d::Zero();
    for (int q = 0; q < points.cols(); ++q) {
      const Eigen::Vector3d r = points.col(q) - x;
      const Eigen::Matrix3d traction = bem::kelvinTraction(r, normal, body_.poissonRatio);
      const Eigen::Matrix3d displacement = bem::kelvinDisplacement(r, 1, body_.poissonRatio);
      for (int k = 0; k < 3; ++k) {
        const double weight = rule.weights[q] * rule.barycentric(k, q);
        t[k] += weight * traction;
        u[k] += weight * displacement;
      }
    }
    for (int k = 0; k < 3; ++k) {
      h.middleCols<3>(3 * body_.triangles(k, f)) += body_.areas[f] * t[k];
      g.middleCols<3>(3 * body_.nodes.ofCorner(k, f)) += body_.areas[f] * u[k];
    }
  }
}

double PlainAssembly::assemble(const bem::SystemColumns& wanted) const {
  const int n = body_.vertexCount(), equations = scheme_.equationCount();
  RowMajor matrix = RowMajor::Zero(3 * equations, 3 * equations);
  RowMajor right = RowMajor::Zero(3 * equations, 3 * wanted.count());
  std::vector<std::vector<bem::CollocationEquation::Term>> users(scheme_.points.size());
  for (int e = 0; e < equations; ++e)
    for (const auto& term : scheme_.equations[e].terms)
      users[term.point].push_back({e, term.weight});
  Rows h(3, 3 * n), g(3, 3 * body_.nodes.count());
  for (std::size_t p = 0; p < scheme_.points.size(); ++p) {
    h.setZero();
    g.setZero();
    integrate(scheme_.points[p].position, h, g);
    for (const auto& user : users[p]) {
      auto row = matrix.middleRows<3>(3 * user.point);
      for (int v = 0; v < n; ++v)
        if (!body_.fixed[v]) row.middleCols<3>(3 * v) += user.weight * h.middleCols<3>(3 * v);
      for (const bem::TractionUnknown& unknown : scheme_.tractions)
        for (int node : unknown.nodes)
          row.middleCols<3>(3 * unknown.column) -=
              user.weight * unknown.scale * g.middleCols<3>(3 * node);
      auto given = right.middleRows<3>(3 * user.point);
      for (std::size_t c = 0; c < wanted.vertices.size(); ++c)
        for (int node = body_.nodes.first(wanted.vertices[c]);
             node < body_.nodes.end(wanted.vertices[c]); ++node)
          given.middleCols<3>(3 * c) += user.weight * g.middleCols<3>(3 * node);
    }
  }
  return matrix.sum() + right.sum();
}

void PlainAssembly::equation(int e, Rows& h, Rows& g) const {
  h = Rows::Zero(3, 3 * body_.vertexCount());
  g = Rows::Zero(3, 3 * body_.nodes.count());
  Rows pointH = h, pointG = g;
  for (const auto& term : scheme_.equations[e].terms) {
    pointH.setZero();
    pointG.setZero();
    integrate(scheme_.points[term.point].position, pointH, pointG);
    h += term.weight * pointH;
    g += term.weight * pointG;
  }
}

}  // namespace palpate::bench
