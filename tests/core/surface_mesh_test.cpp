// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <limits>

#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
// A few hundred additions of doubles of one size.
constexpr double kRounding = 1e-13;

TEST(SurfaceMesh, IcosahedronHasItsClosedFormSizes) {
  const auto mesh = icosphere(0).mesh();
  const double edge = 1 / std::sin(2 * kPi / 5), area = 5 * std::sqrt(3.0) * edge * edge;
  EXPECT_NEAR(mesh->meanEdgeLength(), edge, kRounding);
  EXPECT_NEAR(mesh->triangleAreas().sum(), area, kRounding * area);
  for (int v = 0; v < 12; ++v) {
    EXPECT_NEAR(mesh->vertexAreas()[v], area / 12, kRounding);
    EXPECT_EQ(mesh->trianglesOfVertex(v).size(), 5);
    // Five equal triangles lean against their vertex alike: its normal is the radius.
    EXPECT_LT((mesh->vertexNormals().col(v) - mesh->points().col(v)).norm(), kRounding);
  }
}

TEST(SurfaceMesh, VertexAreasIntegrateHatFunctions) {
  // Eq. 5: a_j = integral of phi_j. So sum a_j u_j is the integral of what u interpolates, here of
  // a linear field whose integral over a triangle is its area times the value at its centroid.
  const auto mesh = jitteredSphere(2, 0.3).mesh();
  const Eigen::Vector3d slope(0.3, -1.1, 0.7);
  double exact = 0;
  for (int f = 0; f < mesh->triangleCount(); ++f)
    for (int k = 0; k < 3; ++k)
      exact += mesh->triangleAreas()[f] *
               (1 + slope.dot(mesh->points().col(mesh->triangles()(k, f)))) / 3;
  double sum = 0;
  for (int v = 0; v < mesh->vertexCount(); ++v)
    sum += mesh->vertexAreas()[v] * (1 + slope.dot(mesh->points().col(v)));
  EXPECT_NEAR(sum, exact, kRounding * mesh->triangleAreas().sum());
}

TEST(SurfaceMesh, VertexAreaIsAThirdOfTheTrianglesAroundIt) {
  const auto mesh = bipyramid(7).mesh();
  // A pyramid's side: base 2 sin(pi / n), height sqrt(1 + cos^2(pi / n)).
  const double side = std::sin(kPi / 7) * std::sqrt(1 + std::pow(std::cos(kPi / 7), 2));
  EXPECT_NEAR(mesh->vertexAreas()[0], 7 * side / 3, kRounding);
  EXPECT_NEAR(mesh->vertexAreas()[1], 7 * side / 3, kRounding);
  EXPECT_NEAR(mesh->vertexAreas()[2], 4 * side / 3, kRounding);
}

TEST(SurfaceMesh, AreasGrowWithTheSquareOfTheScaleOverManyDecades) {
  const Shape shape = jitteredSphere(1, 0.3);
  const auto unit = shape.mesh();
  for (double scale : {1e-50, 1e-9, 1e-3, 1e3, 1e9, 1e50}) {
    const auto mesh = shape.scaled(scale).mesh();
    EXPECT_LT((mesh->vertexAreas() / (scale * scale) - unit->vertexAreas()).norm(), kRounding);
    EXPECT_LT((mesh->vertexNormals() - unit->vertexNormals()).norm(), 10 * kRounding);
    EXPECT_NEAR(mesh->meanEdgeLength() / scale, unit->meanEdgeLength(), kRounding);
    EXPECT_NEAR(mesh->diagonal() / scale, unit->diagonal(), kRounding);
  }
}

TEST(SurfaceMesh, NormalsOfAClosedSurfaceSumToNothing) {
  for (const Shape& shape :
       {box({1, 2, 3}, {2, 3, 4}), torus(2, 0.5, 12, 7), hollowSphere(1, 0.5)}) {
    const auto mesh = shape.mesh();
    EXPECT_LT((mesh->triangleNormals() * mesh->triangleAreas()).norm(),
              kRounding * mesh->triangleAreas().sum());
  }
}

TEST(SurfaceMesh, NormalsPointOutOfTheMaterial) {
  const auto mesh = hollowSphere(2, 0.5).mesh();
  for (int v = 0; v < mesh->vertexCount(); ++v) {
    const double outwards = mesh->vertexNormals().col(v).dot(mesh->points().col(v).normalized());
    EXPECT_GT(mesh->isCavity(mesh->shellOfVertex(v)) ? -outwards : outwards, 0.9);
  }
}

TEST(SurfaceMesh, MeanEdgeLengthCountsEachEdgeOnce) {
  // A unit cube's 12 edges and 6 diagonals.
  EXPECT_NEAR(box({1, 1, 1}, {1, 1, 1}).mesh()->meanEdgeLength(), (12 + 6 * std::sqrt(2.0)) / 18,
              kRounding);
}

TEST(SurfaceMesh, TrianglesOfAVertexAreThoseThatContainIt) {
  const auto mesh = renumbered(box({1, 1, 1}, {2, 3, 1})).mesh();
  int total = 0;
  for (int v = 0; v < mesh->vertexCount(); ++v) {
    int previous = -1;
    for (int f : mesh->trianglesOfVertex(v)) {
      EXPECT_TRUE((mesh->triangles().col(f).array() == v).any());
      EXPECT_GT(f, previous);
      previous = f;
      ++total;
    }
  }
  EXPECT_EQ(total, 3 * mesh->triangleCount());
}

TEST(SurfaceMesh, ACavityBelongsToTheBodyAroundItAndABodyInItStandsAlone) {
  const Shape inCavity = icosphere(1).scaled(0.2);
  const auto mesh = inCavity.with(hollowSphere(1, 0.5)).with(icosphere(0).moved({5, 0, 0})).mesh();
  ASSERT_EQ(mesh->shellCount(), 4);
  EXPECT_EQ(mesh->bodyCount(), 3);
  EXPECT_FALSE(mesh->isCavity(0));
  EXPECT_FALSE(mesh->isCavity(1));
  EXPECT_TRUE(mesh->isCavity(2));
  EXPECT_FALSE(mesh->isCavity(3));
  EXPECT_EQ(mesh->bodyOfShell(2), mesh->bodyOfShell(1));
  EXPECT_NE(mesh->bodyOfShell(0), mesh->bodyOfShell(1));
  EXPECT_NE(mesh->bodyOfShell(3), mesh->bodyOfShell(1));
  EXPECT_EQ(mesh->bodyOfVertex(0), mesh->bodyOfShell(0));
}

TEST(SurfaceMesh, AnyGenusIsAccepted) {
  const Shape ring = torus(2, 0.5, 12, 7);
  EXPECT_EQ(eulerCharacteristic(ring.triangles), 0);
  EXPECT_EQ(ring.mesh()->bodyCount(), 1);
}

TEST(SurfaceMesh, AnUnsoundSoupIsRefusedWithItsFirstDefect) {
  EXPECT_TRUE(contains(refusal([] { withoutTriangle(icosphere(0), 3).mesh(); }),
                       "the surface is open there, but it must be closed"));
  EXPECT_TRUE(contains(refusal([] { icosphere(1).flipped().mesh(); }),
                       "the surface is inside out at triangle 0"));
}

std::uint64_t hash(const Shape& shape) {
  return Fingerprint().add(*shape.mesh()).value();
}

TEST(Fingerprint, IsTheFnv1aHash) {
  // The published test vectors of FNV-1a, 64 bits.
  EXPECT_EQ(Fingerprint().value(), 0xcbf29ce484222325ull);
  EXPECT_EQ(Fingerprint().add("a", 1).value(), 0xaf63dc4c8601ec8cull);
  EXPECT_EQ(Fingerprint().add("foobar", 6).value(), 0x85944171f73967e8ull);
}

TEST(Fingerprint, EqualMeshesHaveEqualOnes) {
  EXPECT_EQ(hash(icosphere(1)), hash(icosphere(1)));
}

TEST(Fingerprint, TheLastBitOfAnyCoordinateChangesIt) {
  const Shape shape = jitteredSphere(0, 0.2);
  const std::uint64_t original = hash(shape);
  for (int i = 0; i < shape.points.size(); ++i) {
    Shape changed = shape;
    double& x = changed.points.data()[i];
    x = std::nextafter(x, std::numeric_limits<double>::infinity());
    EXPECT_NE(hash(changed), original) << "coordinate " << i;
  }
}

TEST(Fingerprint, AnyTriangleOrNumberingChangesIt) {
  const Shape shape = icosphere(0);
  const std::uint64_t original = hash(shape);
  for (int f = 0; f < shape.triangles.cols(); ++f) {
    Shape turned = shape;  // the same triangle, written from another corner
    turned.triangles.col(f) << shape.triangles(1, f), shape.triangles(2, f), shape.triangles(0, f);
    EXPECT_NE(hash(turned), original) << "triangle " << f;
  }
  EXPECT_NE(hash(renumbered(shape)), original);
}

}  // namespace
}  // namespace palpate::test
