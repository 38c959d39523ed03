// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedralization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <iterator>
#include <limits>
#include <vector>

#include "fem/solid_body.h"
#include "mesh/edge_subdivision.h"
#include "support/data_models.h"
#include "support/refusals.h"
#include "support/solids.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

struct Case {
  const char* name;
  Shape shape;
  int shells;
  /// Of the volume: four vertices in one plane, as of a box's squares, have two Delaunay
  /// triangulations; where they are not in one plane the other diagonal has another volume.
  double tolerance;
  double dihedral = 2;  ///< least, degrees
};

Shape twoBodies() {
  return icosphere(2).with(box({1, 1, 1}, {3, 3, 3}).moved({1.5, 0, 0}));
}

/// A bar bent to an arc, whose sections are plane grids: many vertices are on one circle.
Shape bentBar() {
  return box({0.16, 0.03, 0.03}, {20, 4, 4}).mapped([](const Eigen::Vector3d& x) {
    const double angle = x.x() / 0.1, radius = 0.1 + x.y();
    return Eigen::Vector3d(radius * std::sin(angle), radius * std::cos(angle), x.z());
  });
}

const Case kCases[] = {
    {"Sphere", icosphere(2), 1, 1e-12},
    {"JitteredSphere", jitteredSphere(2, 0.2), 1, 0.005},
    {"Box", box({1, 2, 3}, {2, 4, 6}), 1, 1e-12},
    {"Torus", torus(1, 0.4, 24, 10), 1, 1e-3},
    {"BentBar", bentBar(), 1, 0.005, 1},  // four vertices of two squares are nearly in one plane
    {"HollowSphere", hollowSphere(2, 0.5), 2, 1e-12},
    {"TwoBodies", twoBodies(), 2, 1e-12},
    {"Kidney", readDataModel("kidney").shape, 1, 0.03},  // 40 triangles
};

/// Sorted corners of each triangle, sorted.
std::vector<std::array<int, 3>> sorted(const Eigen::Matrix3Xi& triangles) {
  std::vector<std::array<int, 3>> keys;
  for (const auto& triangle : triangles.colwise()) {
    keys.push_back({triangle[0], triangle[1], triangle[2]});
    std::sort(keys.back().begin(), keys.back().end());
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Radius of the sphere through the corners of each tetrahedron.
Eigen::VectorXd circumradii(const TetrahedralMesh& mesh) {
  Eigen::VectorXd radii(mesh.cellCount());
  for (int t = 0; t < mesh.cellCount(); ++t) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k)
      edges.row(k) = mesh.points().col(mesh.tetrahedra()(k + 1, t)) -
                     mesh.points().col(mesh.tetrahedra()(0, t));
    radii[t] = (edges.inverse() * edges.rowwise().squaredNorm() / 2).norm();
  }
  return radii;
}

class TetrahedralizationOf : public testing::TestWithParam<Case> {
 protected:
  const Shape& shape = GetParam().shape;
};

TEST_P(TetrahedralizationOf, AShapeKeepsItsVerticesAndFillsItsInside) {
  const Tetrahedralization found = tetrahedralize(*shape.mesh());
  const TetrahedralMesh& mesh = found.mesh;
  ASSERT_GE(mesh.pointCount(), shape.points.cols());
  EXPECT_EQ(mesh.points().leftCols(shape.points.cols()), shape.points);
  // The boundary is closed, manifold and outward, and has the surface's shells: all that
  // SurfaceMesh asks for.
  const auto surface = boundaryOf(mesh).mesh();
  EXPECT_EQ(surface->shellCount(), GetParam().shells);
  EXPECT_EQ(surface->vertexCount(), shape.points.cols() + found.newBoundaryPoints);
  EXPECT_EQ(eulerCharacteristic(surface->triangles()), eulerCharacteristic(shape.triangles));
  const auto wanted = sorted(shape.triangles), there = sorted(mesh.boundary());
  std::vector<std::array<int, 3>> lost;
  std::set_difference(wanted.begin(), wanted.end(), there.begin(), there.end(),
                      std::back_inserter(lost));
  EXPECT_EQ(found.lostTriangles, static_cast<int>(lost.size()));
  EXPECT_NEAR(mesh.volumes().sum() / signedVolume(shape.points, shape.triangles), 1,
              GetParam().tolerance);
  if (lost.empty()) {
    EXPECT_EQ(found.newBoundaryPoints, 0);
    EXPECT_NO_THROW(SolidBody(*shape.mesh(), mesh, {Elasticity(Material(1, 0.3))}));
  }
  // Perturbation and exudation aim at 12 degrees, but cannot move the vertices of the surface.
  EXPECT_GT(mesh.smallestDihedralAngle(), GetParam().dihedral);
}

TEST_P(TetrahedralizationOf, AShapeIsTheSameOnEachRun) {
  const auto surface = shape.mesh();
  const Tetrahedralization once = tetrahedralize(*surface), again = tetrahedralize(*surface);
  EXPECT_EQ(once.mesh.points(), again.mesh.points());
  EXPECT_EQ(once.mesh.tetrahedra(), again.mesh.tetrahedra());
  EXPECT_EQ(once.lostTriangles, again.lostTriangles);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TetrahedralizationOf, testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

TEST(Tetrahedralization, CellsAreAsSmallAsAskedFor) {
  const auto cube = box({1, 1, 1}, {4, 4, 4}).mesh();
  int last = tetrahedralize(*cube).mesh.cellCount();
  for (double size : {0.2, 0.14, 0.1}) {
    const Tetrahedralization found = tetrahedralize(*cube, size);
    // Bettering angles afterwards moves points, by less than a tenth of an edge.
    EXPECT_LT(circumradii(found.mesh).maxCoeff(), 1.1 * size);
    EXPECT_GT(found.mesh.cellCount(), last) << size;
    last = found.mesh.cellCount();
  }
}

TEST(Tetrahedralization, DependsNeitherOnTheUnitOfLengthNorOnThePlace) {
  const Shape shape = jitteredSphere(1, 0.2);
  const TetrahedralMesh metres = tetrahedralize(*shape.mesh()).mesh;
  // Powers of two: no coordinate is rounded.
  const TetrahedralMesh scaled = tetrahedralize(*shape.scaled(1024).mesh()).mesh;
  EXPECT_EQ(scaled.tetrahedra(), metres.tetrahedra());
  EXPECT_LT((scaled.points() / 1024 - metres.points()).norm(), 1e-9 * metres.points().norm());
  const TetrahedralMesh moved = tetrahedralize(*shape.scaled(0.01).moved({3, -2, 5}).mesh()).mesh;
  EXPECT_NEAR(moved.volumes().sum() / metres.volumes().sum() / 1e-6, 1, 1e-3);
  EXPECT_GT(moved.smallestDihedralAngle(), 3);
}

TEST(Tetrahedralization, RefusesSizesThatMakeNoSense) {
  const auto sphere = icosphere(1).mesh();
  const auto refused = [&](double size, const char* value) {
    return isRefused([&] { tetrahedralize(*sphere, size); },
                     std::string("the size of tetrahedra must be 0, or so that they are fewer than "
                                 "ten million, not ") +
                         value);
  };
  EXPECT_TRUE(refused(-0.1, "-0.1"));
  EXPECT_TRUE(refused(std::numeric_limits<double>::quiet_NaN(), "nan"));
  EXPECT_TRUE(refused(0.001, "0.001"));
}

TEST(Tetrahedralization, CanBeAbortedBeforeItBegins) {
  int calls = 0;
  const auto stop = [&](double, const char* stage) {
    EXPECT_STREQ(stage, "tetrahedralize");
    ++calls;
    return false;
  };
  EXPECT_TRUE(isRefused<Aborted>([&] { tetrahedralize(*icosphere(1).mesh(), 0, stop); },
                                 "aborted on request"));
  EXPECT_EQ(calls, 1);
}

// Of a regular mesh like this one slivers go round in CGAL's exudation for ever.
TEST(Tetrahedralization, EndsOnRegularMeshes) {
  const Shape shape = boundaryOf(kuhnBox({0.1, 0.1, 0.06}, {3, 3, 2}).mesh());
  SurfaceMesh surface(shape.points, shape.triangles);
  for (int level = 0; level < 2; ++level) {
    const SubdivisionLevel finer = subdivideFlat(surface);
    surface = SurfaceMesh(finer.points, finer.triangles);
  }
  const Tetrahedralization filled = tetrahedralize(surface);
  EXPECT_NEAR(filled.mesh.volumes().sum(), 6e-4, 1e-9);
  EXPECT_EQ(filled.newBoundaryPoints, 0);
}

}  // namespace
}  // namespace palpate::test
