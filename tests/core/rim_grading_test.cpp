// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/rim_grading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>

#include "mesh/shells.h"
#include "mesh/smooth_patches.h"
#include "model/support.h"
#include "support/data_models.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A surface with the support that it is graded towards.
struct Supported {
  Shape shape;
  std::vector<unsigned char> types;

  GradedSurface graded(int layers) const {
    return gradeTowardsSupport(*shape.mesh(), types, layers);
  }
};

Supported sphere(int levels) {
  const Shape shape = icosphere(levels);
  return {shape, fixedWhere(shape, cap)};
}

std::vector<Supported> supported() {
  const Shape block = box({1, 2, 3}, {2, 3, 4});
  std::vector<Supported> all{
      sphere(2), {block, fixedWhere(block, [](const auto& x) { return x.z() < 1e-9; })}};
  for (const char* name : {"nodule", "kidney", "spatula", "banana_seat"}) {
    const DataModel model = readDataModel(name);
    all.push_back({model.shape, model.boundaryTypes});
  }
  return all;
}

struct Angles {
  double smallest = 180, largest = 0;  // degrees
};

Angles anglesOf(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  Angles angles;
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d at = points.col(triangles(k, f)),
                            a = points.col(triangles((k + 1) % 3, f)) - at,
                            b = points.col(triangles((k + 2) % 3, f)) - at;
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / kPi;
      angles.smallest = std::min(angles.smallest, angle);
      angles.largest = std::max(angles.largest, angle);
    }
  return angles;
}

/// A SurfaceMesh is closed, manifold and oriented, or its constructor throws.
TEST(RimGrading, KeepsTheSurfaceWhereItIsAndConforming) {
  for (const Supported& s : supported()) {
    const auto mesh = s.shape.mesh();
    const GradedSurface graded = s.graded(2);
    const SurfaceMesh fine(graded.points, graded.triangles);
    EXPECT_GT(fine.vertexCount(), mesh->vertexCount());
    EXPECT_EQ(graded.points.leftCols(mesh->vertexCount()), s.shape.points);
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh->triangleCount());
    for (int f = 0; f < fine.triangleCount(); ++f) {
      const int parent = graded.parentTriangle[f];
      areas[parent] += fine.triangleAreas()[f];
      EXPECT_LT((fine.triangleNormals().col(f) - mesh->triangleNormals().col(parent)).norm(), 1e-9);
    }
    EXPECT_LT((areas - mesh->triangleAreas()).norm(), 1e-12 * areas.norm());
    EXPECT_NEAR(enclosedVolume(graded.points, graded.triangles) /
                    enclosedVolume(s.shape.points, s.shape.triangles),
                1, 1e-12);
  }
}

TEST(RimGrading, PutsNewVerticesBetweenEarlierOnes) {
  for (const Supported& s : supported()) {
    const GradedSurface graded = s.graded(3);
    for (int v = 0; v < graded.points.cols(); ++v) {
      const int a = graded.parents(0, v), b = graded.parents(1, v);
      if (v < s.shape.points.cols()) {
        EXPECT_TRUE(a == v && b == v);
        continue;
      }
      EXPECT_TRUE(a < v && b < v);
      const double share = graded.share[v];
      EXPECT_TRUE(share == kLayerShare || share == 0.5);
      const Eigen::Vector3d point =
          (1 - share) * graded.points.col(a) + share * graded.points.col(b);
      EXPECT_LT((graded.points.col(v) - point).norm(), 1e-12);
      Eigen::Vector3d ofAncestors = Eigen::Vector3d::Zero();
      for (const auto& [ancestor, part] : graded.ancestors(v)) {
        EXPECT_LT(ancestor, s.shape.points.cols());
        ofAncestors += part * s.shape.points.col(ancestor);
      }
      EXPECT_LT((ofAncestors - point).norm(), 1e-12);
    }
  }
}

/// The support keeps its area and its rim: what is fixed before is what is fixed after.
TEST(RimGrading, KeepsTheSupportAndItsPatches) {
  for (const Supported& s : supported()) {
    const auto mesh = s.shape.mesh();
    const Eigen::VectorXi patches =
        splitAtSupport(*mesh, BoundaryConditions(s.types), findSmoothPatches(*mesh, 30));
    const GradedSurface graded = s.graded(2);
    const SurfaceMesh fine(graded.points, graded.triangles);
    const std::vector<unsigned char> types = gradedBoundaryTypes(graded, s.types);
    const Eigen::VectorXi finePatches = gradedSmoothPatches(graded, patches);
    const auto isSupport = [](const SurfaceMesh& m, const std::vector<unsigned char>& fixed,
                              int f) {
      const Eigen::Vector3i corner = m.triangles().col(f);
      return fixed[corner[0]] && fixed[corner[1]] && fixed[corner[2]];
    };
    for (int f = 0; f < fine.triangleCount(); ++f) {
      EXPECT_EQ(isSupport(fine, types, f), isSupport(*mesh, s.types, graded.parentTriangle[f]));
      EXPECT_EQ(finePatches[f], patches[graded.parentTriangle[f]]);
    }
    const Eigen::VectorXi found =
        splitAtSupport(fine, BoundaryConditions(types), findSmoothPatches(fine, 30));
    EXPECT_EQ(found.maxCoeff(), patches.maxCoeff());
  }
}

/// Largest angles bound the error of linear functions on long triangles (I. Babuska and A. Aziz,
/// "On the angle condition in the finite element method", 1976); smallest ones need not.
/// A layer's corners are those of the triangles at the rim, or what they lack to 180 degrees; edges
/// that are halved may halve a corner.
TEST(RimGrading, BoundsAnglesAndThinsLayersFourfold) {
  for (const Supported& s : supported()) {
    const Angles coarse = anglesOf(s.shape.points, s.shape.triangles);
    const double largest = std::max(coarse.largest, 180 - coarse.smallest / 2);
    double before = 0;
    for (int layers = 1; layers <= 4; ++layers) {
      const GradedSurface graded = s.graded(layers);
      EXPECT_LT(anglesOf(graded.points, graded.triangles).largest, largest) << layers;
      const SurfaceMesh fine(graded.points, graded.triangles);
      double thinnest = std::numeric_limits<double>::max();
      for (int f = 0; f < fine.triangleCount(); ++f)
        thinnest = std::min(thinnest, 2 * fine.triangleAreas()[f] / fine.longestEdge(f));
      if (layers > 1) {
        EXPECT_NEAR(thinnest / before, kLayerShare, 0.05) << layers;
      }
      before = thinnest;
    }
  }
}

/// Layers cost the same number of vertices each: those of the edges that leave the rim.
TEST(RimGrading, AddsTheSameNumberOfVerticesALayer) {
  const Supported s = sphere(3);
  const auto count = [&](int layers) { return s.graded(layers).points.cols(); };
  EXPECT_EQ(count(0), s.shape.points.cols());
  EXPECT_EQ(count(3) - count(2), count(2) - count(1));
  EXPECT_LT(count(1) - count(0), s.shape.points.cols() / 4);
}

TEST(RimGrading, HalvesEdgesAcrossANarrowSupport) {
  // A strip of one square's width on a box: its diagonals join vertices of its rim.
  const Shape block = box({1, 1, 1}, {4, 4, 4});
  const Supported s{block, fixedWhere(block, [](const auto& x) {
                      return x.z() < 1e-9 && x.x() > 0.2 && x.x() < 0.6;
                    })};
  const GradedSurface graded = s.graded(1);
  const SurfaceMesh fine(graded.points, graded.triangles);
  const int halved = (graded.share.array() == 0.5).count();
  EXPECT_EQ(halved, 7);  // four diagonals, three edges between the squares
  EXPECT_NEAR(enclosedVolume(graded.points, graded.triangles), 1, 1e-12);
}

TEST(RimGrading, WithoutARimAddsNothing) {
  const Shape shape = icosphere(1);
  for (const unsigned char type : {0, 1}) {
    const std::vector<unsigned char> types(shape.points.cols(), type);
    const GradedSurface graded = gradeTowardsSupport(*shape.mesh(), types, 3);
    EXPECT_EQ(graded.points, shape.points);
    EXPECT_EQ(graded.triangles, shape.triangles);
  }
}

TEST(RimGrading, RefusesOtherTypesAndFewerLayers) {
  const auto mesh = icosphere(0).mesh();
  EXPECT_EQ(refusal([&] {
              gradeTowardsSupport(*mesh, {0, 1}, 1);
            }),
            "there are 2 boundary types for 12 vertices");
  EXPECT_EQ(refusal([&] { gradeTowardsSupport(*mesh, std::vector<unsigned char>(12, 0), -1); }),
            "the layers at a rim are at least 0, not -1");
}

}  // namespace
}  // namespace palpate::test
