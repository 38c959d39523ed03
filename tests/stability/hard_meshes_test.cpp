// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes that trouble other codes: needles, high valence, thin walls, near neighbours.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/LU>

#include "contact/pressure_mask.h"
#include "contact/surface_stiffness.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

/// Compliance under a mask of radius 0.6 around the vertex nearest to the north pole.
Eigen::Matrix3d poleCompliance(const ElasticModel& model) {
  Eigen::Index pole;
  model.mesh().points().row(2).maxCoeff(&pole);
  const PressureMasks masks(model.mesh(), model.conditions(), MaskShape::Linear, 0.6);
  const VertexMask mask = masks.at(static_cast<int>(pole));
  BoundaryElementOptions options;
  options.columns = mask.nodes;
  return maskedVertexStiffness(*computeGreens(model, options), static_cast<int>(pole), mask)
      .stiffness.inverse();
}

double difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).norm() / b.norm();
}

/// A sphere with a vertex on its equator pulled to within `distance` edges of a neighbour.
Shape needles(double distance) {
  Shape shape = icosphere(3);
  int from = -1, to = -1;
  for (int f = 0; f < shape.triangles.cols() && from < 0; ++f) {
    const int a = shape.triangles(0, f), b = shape.triangles(1, f);
    if (std::abs(shape.points(2, a)) < 0.05 && std::abs(shape.points(2, b)) < 0.05)
      from = a, to = b;
  }
  shape.points.col(from) =
      shape.points.col(to) + distance * (shape.points.col(from) - shape.points.col(to));
  return shape;
}

TEST(Needles, DoNotChangeWhatIsFeltElsewhere) {
  const Eigen::Matrix3d sound = poleCompliance(makeModel(icosphere(3), cap, 1, 0.3));
  for (const double distance : {1e-2, 1e-4, 1e-6}) {
    const ElasticModel model = makeModel(needles(distance), cap, 1, 0.3);
    EXPECT_LT(difference(poleCompliance(model), sound), 1e-3) << distance;
  }
}

TEST(Slivers, WithAnglesNearAHalfTurnKeepTheCompliance) {
  // Every other triangle of a fine sphere is cut by a vertex near the middle of its longest edge:
  // its larger part has an angle of nearly 180 degrees.
  const Shape base = icosphere(2);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (int v = 0; v < base.points.cols(); ++v) points.push_back(base.points.col(v));
  for (int f = 0; f < base.triangles.cols(); ++f) {
    const Eigen::Vector3i t = base.triangles.col(f);
    if (f % 2 == 0) {
      triangles.push_back(t);
      continue;
    }
    const Eigen::Vector3d a = base.points.col(t[0]), b = base.points.col(t[1]),
                          c = base.points.col(t[2]);
    const int middle = static_cast<int>(points.size());
    points.push_back(0.5 * (a + b) + 1e-4 * (c - 0.5 * (a + b)));
    triangles.push_back({t[0], t[1], middle});
    triangles.push_back({t[1], t[2], middle});
    triangles.push_back({t[2], t[0], middle});
  }
  const ElasticModel sound = makeModel(base, cap, 1, 0.3);
  const ElasticModel model = makeModel(fromLists(points, triangles), cap, 1, 0.3);
  // The same polyhedron, differently discretised: within the coarse mesh's own error of 5 %.
  EXPECT_LT(difference(poleCompliance(model), poleCompliance(sound)), 0.05);
}

TEST(Valence, OfFortyAtThePoleKeepsTheCompliance) {
  // Two fans of forty triangles at the poles against a regular mesh of the same sphere.
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::UnitZ()};
  std::vector<Eigen::Vector3i> triangles;
  constexpr int around = 40, rings = 19;
  for (int k = 1; k <= rings; ++k)
    for (int i = 0; i < around; ++i) {
      const double polar = M_PI * k / (rings + 1), turn = 2 * M_PI * (i + 0.5 * (k % 2)) / around;
      points.emplace_back(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                          std::cos(polar));
    }
  points.push_back(-Eigen::Vector3d::UnitZ());
  const int south = static_cast<int>(points.size()) - 1;
  const auto at = [](int k, int i) { return 1 + (k - 1) * around + (i + around) % around; };
  for (int i = 0; i < around; ++i) {
    triangles.emplace_back(0, at(1, i), at(1, i + 1));
    triangles.emplace_back(south, at(rings, i + 1), at(rings, i));
    for (int k = 1; k < rings; ++k) {
      const int shift = k % 2;  // odd rings are turned by half a step
      triangles.emplace_back(at(k, i), at(k + 1, i + shift), at(k, i + 1));
      triangles.emplace_back(at(k + 1, i + shift), at(k + 1, i + shift + 1), at(k, i + 1));
    }
  }
  const Eigen::Matrix3d fan = poleCompliance(makeModel(fromLists(points, triangles), cap, 1, 0.3));
  const Eigen::Matrix3d regular = poleCompliance(makeModel(icosphere(3), cap, 1, 0.3));
  // The two supports end on different rings of vertices, which costs the tangential part most.
  EXPECT_NEAR(fan(2, 2) / regular(2, 2), 1, 0.03);
  EXPECT_NEAR(fan(0, 0) / regular(0, 0), 1, 0.1);
  EXPECT_NEAR(fan(0, 0), fan(1, 1), 1e-6 * fan(0, 0));  // forty-fold symmetry
}

TEST(SmoothPatches, OfSingleTrianglesAllOverASupportKeepTheSystemRegular) {
  for (const Collocation collocation : {Collocation::Averaged, Collocation::Vertex})
    for (const double smoothAngle : {0.0, 30.0}) {
      const ElasticModel model = makeModel(
          jitteredSphere(2, 0.3).mapped([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            return x * (1 + 0.05 * std::sin(31 * x.x() + 57 * x.y() + 43 * x.z()));
          }),
          [](const Eigen::Vector3d& x) { return x.z() < -0.6; }, 1, 0.3, smoothAngle);
      BoundaryElementOptions options;
      options.collocation = collocation;
      options.columns = {model.conditions().freeNodes().front()};
      EXPECT_LT(
          computeBoundaryElementGreensFunctions(model, options).info.diagnostics.conditionEstimate,
          1e4);
    }
}

#ifdef PALPATE_WITH_CGAL

/// The warnings about walls of a plate clamped over a part of its length, and its wall ratio.
std::pair<std::string, double> wallWarning(double thickness, int layers) {
  const ElasticModel model = makeModel(
      box({1, 1, thickness}, {8, 8, layers}), [](const Eigen::Vector3d& x) { return x.x() < 0.45; },
      1, 0.3);
  BoundaryElementOptions options;
  options.columns = {model.conditions().freeNodes().front()};
  const Diagnostics d = computeBoundaryElementGreensFunctions(model, options).info.diagnostics;
  std::string text;
  for (const std::string& warning : d.warnings)
    if (warning.find("wall") != std::string::npos) text += warning;
  return {text, d.wallRatio};
}

TEST(ThinPlate, WarnsWithTheRatioOfEdgeToThicknessAndMoreUrgentlyWhenItLocks) {
  const auto [solid, solidRatio] = wallWarning(1, 8);
  const auto [thin, thinRatio] = wallWarning(0.2, 2);
  const auto [locking, lockingRatio] = wallWarning(0.01, 1);
  EXPECT_EQ(solid, "");
  EXPECT_NE(thin.find("thin for the mesh"), std::string::npos) << thin;
  EXPECT_NE(locking.find("too stiff"), std::string::npos) << locking;
  EXPECT_GT(lockingRatio, 10 * thinRatio);
  EXPECT_GT(thinRatio, 2 * solidRatio);
}

#endif

TEST(SecondBody, HoweverNearIsNeitherPressedNorFelt) {
  const Shape one = icosphere(2);
  const Eigen::Matrix3d alone = poleCompliance(makeModel(one, cap, 1, 0.3));
  for (const double gap : {1e-1, 1e-3, 1e-5}) {
    const Shape both = one.moved({0, 0, -2 - gap}).with(one);
    const ElasticModel model = makeModel(
        both,
        [&](const Eigen::Vector3d& x) {
          return cap(x.z() < -1 - gap / 2 ? Eigen::Vector3d(x + Eigen::Vector3d(0, 0, 2 + gap))
                                          : x);
        },
        1, 0.3);
    EXPECT_LT(difference(poleCompliance(model), alone), 1e-8) << gap;
  }
}

}  // namespace
}  // namespace palpate::test
