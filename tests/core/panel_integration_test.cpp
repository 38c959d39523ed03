// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/influence_panels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "bem/kelvin.h"
#include "bem/triangle_quadrature.h"
#include "mesh/smooth_patches.h"
#include "model/elastic_model.h"
#include "support/shapes.h"

namespace palpate::bem {
namespace {

/// A body whose triangle 0 is the given one; a flat apex far behind closes it to a tetrahedron.
BodySurface tetrahedronOn(const Eigen::Matrix3d& corners, double poissonRatio) {
  Eigen::Matrix3Xd points(3, 4);
  const Eigen::Vector3d normal =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
  points << corners, corners.rowwise().mean() - 40 * normal;
  Eigen::Matrix3Xi triangles(3, 4);
  triangles.transpose() << 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0;
  const auto mesh = std::make_shared<SurfaceMesh>(points, triangles);
  const ElasticModel model(mesh, Material(1, poissonRatio), BoundaryConditions({1, 1, 0, 1}),
                           findSmoothPatches(*mesh, 0));
  return BodySurface(model, 0);
}

struct Blocks {
  Eigen::Matrix3d h[3], g[3];
};

/// Integrals over a triangle by recursive subdivision until the point is eight radii away.
void integrateBruteForce(const Eigen::Vector3d& x, const Eigen::Matrix3d& corners,
                         const Eigen::Matrix3d& hats, const Eigen::Vector3d& normal, double nu,
                         int depth, Blocks& sum) {
  static const TriangleRule rule = triangleRule(16);
  const Eigen::Vector3d centroid = corners.rowwise().mean();
  const double radius = (corners.colwise() - centroid).colwise().norm().maxCoeff();
  if (depth < 60 && (centroid - x).norm() < 8 * radius) {
    int longest = 0;  // bisection of the longest edge keeps needles affordable
    double length = 0;
    for (int k = 0; k < 3; ++k) {
      const double l = (corners.col(k) - corners.col((k + 1) % 3)).norm();
      if (l > length) length = l, longest = k;
    }
    for (int part = 0; part < 2; ++part) {
      Eigen::Matrix3d to = Eigen::Matrix3d::Identity();
      const int moved = part ? longest : (longest + 1) % 3;
      to.col(moved) =
          (Eigen::Vector3d::Unit(longest) + Eigen::Vector3d::Unit((longest + 1) % 3)) / 2;
      integrateBruteForce(x, corners * to, hats * to, normal, nu, depth + 1, sum);
    }
    return;
  }
  const double area =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
  for (int q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector3d y = corners * rule.barycentric.col(q);
    const Eigen::Vector3d hat = hats * rule.barycentric.col(q);
    const Eigen::Matrix3d t = kelvinTraction(y - x, normal, nu);
    const Eigen::Matrix3d u = kelvinDisplacement(y - x, 1, nu);
    for (int k = 0; k < 3; ++k) {
      sum.h[k] += area * rule.weights[q] * hat[k] * t;
      sum.g[k] += area * rule.weights[q] * hat[k] * u;
    }
  }
}

/// integratePanel over triangle 0 alone, for one point in every lane.
Blocks integrateByPanel(const BodySurface& body, const Eigen::Vector3d& x, double tolerance,
                        const OwnTriangle* own = nullptr) {
  const CollocationScheme scheme(body, Collocation::Vertex);
  const InfluencePanels panels(body, scheme, tolerance);
  Blocks blocks;
  std::vector<double> h(9 * kLanes * body.vertexCount(), 0), g(6 * kLanes * body.nodes.count(), 0);
  const PanelTriangle triangle = panels.triangle(0);
  const int ownIndex = own ? 0 : -1;
  PanelTask task;
  for (int c = 0; c < 3; ++c) std::fill_n(task.x[c], kLanes, x[c]);
  task.triangles = &triangle;
  task.triangleCount = 1;
  task.ownIndex = &ownIndex;
  task.own = own;
  choosePanelRules(tolerance, task.nearRule, task.farRule);
  task.poissonRatio = body.poissonRatio;
  task.h = h.data();
  task.g = g.data();
  integratePanel(task);
  static constexpr int index[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        blocks.h[k](i, j) = h[(9 * triangle.vertexIndex[k] + 3 * i + j) * kLanes];
        blocks.g[k](i, j) = g[(6 * triangle.tractionNode[k] + index[i][j]) * kLanes];
      }
  return blocks;
}

double largestError(const Blocks& a, const Blocks& b, bool traction) {
  double error = 0, size = 0;
  for (int k = 0; k < 3; ++k) {
    error = std::max(error, ((traction ? a.h[k] - b.h[k] : a.g[k] - b.g[k])).norm());
    size = std::max(size, (traction ? b.h[k] : b.g[k]).norm());
  }
  return error / size;
}

Eigen::Matrix3d triangleOfAspect(double height) {
  Eigen::Matrix3d corners;
  corners << 0, 1, 0.3, 0, 0, height, 0, 0, 0;
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()) * corners;
}

class TriangleIntegrals : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(TriangleIntegrals, ClosedFormsMatchSubdivisionNearTheTriangle) {
  const auto [height, nu] = GetParam();
  const Eigen::Matrix3d corners = triangleOfAspect(height);
  const BodySurface body = tetrahedronOn(corners, nu);
  Eigen::Matrix3d local;
  for (int k = 0; k < 3; ++k) local.col(k) = body.points.col(body.triangles(k, 0));
  const double scale = 1 / body.length;
  const Eigen::Vector3d normal = body.normals.col(0);
  double worstU = 0, worstT = 0;
  for (const double d : {1e-3, 0.03, 0.3, 1.0, 3.0})
    for (const Eigen::Vector3d& at :
         {Eigen::Vector3d(0.3, 0.3, 0.4), Eigen::Vector3d(1.2, -0.3, 0.1),
          Eigen::Vector3d(0.5, 0.5, 0.0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, -1, 0),
          Eigen::Vector3d(-0.2, 0.1, 1.1)}) {
      const Eigen::Vector3d x = local * at + d * scale * normal;
      Blocks exact;
      for (int k = 0; k < 3; ++k) exact.h[k].setZero(), exact.g[k].setZero();
      integrateBruteForce(x, local, Eigen::Matrix3d::Identity(), normal, nu, 0, exact);
      const Blocks closed = integrateByPanel(body, x, 0);
      worstU = std::max(worstU, largestError(closed, exact, false));
      worstT = std::max(worstT, largestError(closed, exact, true));
    }
  // Rounding grows with the slope of the hats, but a needle's share of any sum shrinks likewise.
  EXPECT_LT(height * worstU, 1e-7);
  EXPECT_LT(height * worstT, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Aspects, TriangleIntegrals,
                         testing::Combine(testing::Values(0.9, 0.1, 1e-3, 1e-6),
                                          testing::Values(-0.5, 0.3, 0.5)));

TEST(TriangleIntegralsInThePlane, AreRightOnTheLinesThroughTheEdgesToo) {
  const Eigen::Matrix3d corners = triangleOfAspect(0.8);
  const BodySurface body = tetrahedronOn(corners, 0.3);
  Eigen::Matrix3d local;
  for (int k = 0; k < 3; ++k) local.col(k) = body.points.col(body.triangles(k, 0));
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(2, -1, 0), Eigen::Vector3d(0, -0.5, 1.5), Eigen::Vector3d(-0.3, 1.3, 0),
        Eigen::Vector3d(1.5, 0.2, -0.7), Eigen::Vector3d(0.6, 0.6, -0.2)}) {
    const Eigen::Vector3d x = local * at;
    Blocks exact;
    for (int k = 0; k < 3; ++k) exact.h[k].setZero(), exact.g[k].setZero();
    integrateBruteForce(x, local, Eigen::Matrix3d::Identity(), body.normals.col(0), 0.3, 0, exact);
    const Blocks closed = integrateByPanel(body, x, 0);
    EXPECT_LT(largestError(closed, exact, false), 1e-10) << at.transpose();
    EXPECT_LT(largestError(closed, exact, true), 1e-10) << at.transpose();
  }
}

TEST(TriangleIntegralsFarAway, MeetTheToleranceThatChoseTheRule) {
  const Eigen::Matrix3d corners = triangleOfAspect(0.8);
  const BodySurface body = tetrahedronOn(corners, 0.3);
  Eigen::Matrix3d local;
  for (int k = 0; k < 3; ++k) local.col(k) = body.points.col(body.triangles(k, 0));
  const double scale = 1 / body.length;
  for (const double tolerance : {1e-4, 1e-6, 1e-8})
    for (const double distance : {3.0, 6.0, 12.0, 40.0}) {
      const Eigen::Vector3d x =
          local.rowwise().mean() + distance * scale * Eigen::Vector3d(0.6, -0.5, 0.62);
      Blocks exact;
      for (int k = 0; k < 3; ++k) exact.h[k].setZero(), exact.g[k].setZero();
      integrateBruteForce(x, local, Eigen::Matrix3d::Identity(), body.normals.col(0), 0.3, 0,
                          exact);
      // The tolerance is one of a whole equation, in which this triangle weighs about 1/distance.
      const Blocks integrated = integrateByPanel(body, x, tolerance);
      EXPECT_LT(largestError(integrated, exact, true), 20 * distance * tolerance + 1e-11);
    }
}

}  // namespace
}  // namespace palpate::bem
