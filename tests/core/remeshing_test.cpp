// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/remeshing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/surface_mesh.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::vector<unsigned char> allFree(const Shape& shape) {
  return std::vector<unsigned char>(shape.points.cols(), 0);
}
Eigen::VectorXi onePatch(const Shape& shape) {
  return Eigen::VectorXi::Zero(shape.triangles.cols());
}

TEST(Remeshing, GivesEdgesOfTheLengthAskedForOnTheOldSurface) {
  const Shape sphere = icosphere(4);
  for (double edge : {0.2, 0.35}) {
    const RemeshedSurface found =
        remeshIsotropic(sphere.points, sphere.triangles, allFree(sphere), onePatch(sphere), edge);
    const SurfaceMesh mesh(found.points, found.triangles);
    EXPECT_NEAR(mesh.meanEdgeLength() / edge, 1, 0.15) << edge;
    for (int v = 0; v < mesh.vertexCount(); ++v)
      EXPECT_NEAR(mesh.points().col(v).norm(), 1, 0.01);  // the sagitta of the old edges is 0.002
    EXPECT_NEAR(mesh.triangleAreas().sum() / (4 * kPi), 1, 0.1);
  }
}

TEST(Remeshing, KeepsTheSupportsRimAndTheSmoothPatchesOfABox) {
  const Shape cube = box({1, 1, 1}, {4, 4, 4});
  const auto types = fixedWhere(cube, [](const auto& x) { return x.z() == 0; });
  Eigen::VectorXi patches(cube.triangles.cols());
  const SurfaceMesh before(cube.points, cube.triangles);
  const auto sideOf = [](const Eigen::Vector3d& normal) {
    Eigen::Index axis;
    normal.cwiseAbs().maxCoeff(&axis);
    return static_cast<int>(2 * axis + (normal[axis] > 0));
  };
  for (int f = 0; f < before.triangleCount(); ++f)
    patches[f] = sideOf(before.triangleNormals().col(f));
  const RemeshedSurface found = remeshIsotropic(cube.points, cube.triangles, types, patches, 0.13);
  const SurfaceMesh mesh(found.points, found.triangles);
  EXPECT_NEAR(mesh.triangleAreas().sum(), 6, 1e-9);  // no corner is cut off
  double held = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    EXPECT_EQ(found.smoothPatches[f], sideOf(mesh.triangleNormals().col(f)));
    bool isFixed = true;
    for (int k = 0; k < 3; ++k) isFixed = isFixed && found.boundaryTypes[found.triangles(k, f)];
    if (isFixed) held += mesh.triangleAreas()[f];
  }
  EXPECT_NEAR(held, 1, 1e-9);
  for (int v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_EQ(found.boundaryTypes[v] != 0, std::abs(mesh.points()(2, v)) < 1e-12);
}

TEST(Remeshing, RefusesWhatItCannotDo) {
  const Shape sphere = icosphere(2);
  const auto remesh = [&](const std::vector<unsigned char>& types, double edge, int iterations) {
    return remeshIsotropic(sphere.points, sphere.triangles, types, onePatch(sphere), edge,
                           iterations);
  };
  for (double edge : {0., -1., 10., 1e-5, std::nan("")})
    EXPECT_THROW(remesh(allFree(sphere), edge, 3), std::invalid_argument) << edge;
  EXPECT_THROW(remesh(allFree(sphere), 0.3, 0), std::invalid_argument);
  EXPECT_THROW(remesh({}, 0.3, 3), std::invalid_argument);
  std::vector<unsigned char> pinned = allFree(sphere);
  pinned[5] = 1;  // no triangle around it is fixed
  EXPECT_THROW(remesh(pinned, 0.3, 3), std::invalid_argument);
  EXPECT_THROW(remeshIsotropic(sphere.points, sphere.triangles, allFree(sphere), onePatch(sphere),
                               0.3, 3, [](double, const char*) { return false; }),
               Aborted);
}

}  // namespace
}  // namespace palpate::test
