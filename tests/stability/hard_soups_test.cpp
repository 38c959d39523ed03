// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Triangles that bound no body: each is refused with a sentence, and mended where that needs no
// guess into a surface that feels as the sound one does.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mesh/mesh_defects.h"
#include "mesh/repair.h"
#include "stability/hard_case.h"
#include "support/pole_compliance.h"
#include "support/problems.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"mesh", name, danger};
}

Shape sound() {
  return icosphere(2);
}

Eigen::Matrix3d complianceOf(const Shape& shape) {
  return poleCompliance(makeModel(shape, cap, 1, 0.3));
}

/// Expects a soup to be refused in these words, and mended into what feels as the sound sphere
/// does.
void expectMended(const HardCase& row, const Shape& soup, const std::string& words,
                  double largestChange) {
  row.expectRefused([&] { soup.mesh(); }, words);
  static const Eigen::Matrix3d reference = complianceOf(sound());
  const RepairedSurface mended = repairSurface(soup.points, soup.triangles);
  EXPECT_FALSE(mended.changes.empty());
  row.expectAtMost("change of the compliance at the pole once mended",
                   complianceChange(complianceOf({mended.points, mended.triangles}), reference),
                   largestChange);
}

// The same vertices and triangles in some order: rounding.
constexpr double kSameSurface = 1e-12;

TEST(Soup, OfSoundTrianglesIsMendedIntoTheSameBody) {
  expectMended(hard("a triangle is missing", "an infinite body"), withoutTriangle(sound(), 7),
               "open boundary: edge (", kSameSurface);
  expectMended(hard("a triangle is flipped", "−5.7 % unseen by condition numbers"),
               withTriangleFlipped(sound(), 7), "inconsistent orientation: ", kSameSurface);
  expectMended(hard("a triangle is there twice", "+4.6 % unseen by condition numbers"),
               withTriangle(sound(), sound().triangles.col(7)), "duplicate triangle: triangle 320",
               kSameSurface);
  expectMended(
      hard("all triangles are inside out", "the negated compliance: a device is pulled in"),
      sound().flipped(), "inward orientation: ", kSameSurface);
  expectMended(hard("a vertex in no triangle", "an empty row"), withVertex(sound(), {0, 0, 3}),
               "unused vertex: vertex 162", kSameSurface);
  expectMended(hard("each triangle with vertices of its own, as in STL files", "320 open bodies"),
               tornApart(sound()), "duplicate vertex: vertex ", kSameSurface);
}

TEST(Soup, OfVerticesAlmostAtOnePlaceIsWelded) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1e-10, 1e-10);
  const Shape soup = tornApart(sound()).mapped([&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() + uniform(random), x.y() + uniform(random),
                           x.z() + uniform(random));
  });
  // Coordinates change by 1e-10, and the compliance by no more than a few times that.
  expectMended(hard("the same, 1e−10 apart", "gaps that rounding makes"), soup,
               "duplicate vertex: vertex ", 1e-8);
}

TEST(Soup, WithTrianglesWithoutHeightIsMendedOrRefused) {
  // A vertex in the middle of an edge of one of its two triangles: one is cut in two, between them
  // and the other is a triangle without height.
  const Shape shape = sound();
  const Eigen::Vector3i t = shape.triangles.col(7);
  const Eigen::Vector3d middle = (shape.points.col(t[0]) + shape.points.col(t[1])) / 2;
  const int added = static_cast<int>(shape.points.cols());
  Shape soup =
      withTriangle(withTriangle(withoutTriangle(withVertex(shape, middle), 7), {t[0], added, t[2]}),
                   {added, t[1], t[2]});
  soup = withTriangle(soup, {t[1], added, t[0]});
  // The same polyhedron with a vertex more on the far side of the body.
  expectMended(hard("a triangle without height", "division by its height"), soup,
               "degenerate triangle: triangle ", 1e-2);
}

TEST(Soup, OfCoordinatesThatAreNoNumbersIsRefused) {
  std::vector<std::function<void()>> calls;
  for (const double x :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300})
    calls.push_back([x] {
      Shape shape = sound();
      shape.points(1, 5) = x;
      shape.mesh();
    });
  hard("a coordinate NaN, ∞, 1e300", "NaN everywhere")
      .expectAllRefused(calls, "non-finite coordinate: vertex 5 has a coordinate that is not");
  Shape shape = sound();
  shape.triangles(1, 5) = 162;
  hard("a triangle of a vertex that is not there", "memory that is not ours")
      .expectRefused([&] { shape.mesh(); }, "triangle 5 refers to vertex 162");
}

TEST(Soup, ThatCutsThroughItselfIsNamed) {
  const auto crossings = findSelfIntersections(*cubeWithSpikeThroughItsBase().mesh());
  ASSERT_FALSE(crossings.empty());
  hard("a cube with a spike through its base", "a body that fills space twice")
      .expectSaid(crossings.front().sentence, "self-intersection: triangles ");
  const Shape crossing = sound().with(sound().moved({1.5, 0.1, 0.2}));
  hard("two spheres that cross", "a guess at what they bound")
      .expectRefused([&] { repairSurface(crossing.points, crossing.triangles); },
                     "the surface cannot be mended: ");
}

TEST(Soup, ThatIsNoSurfaceIsRefused) {
  hard("two cubes that share an edge", "a hinge that is none")
      .expectRefused([] { twoCubesAtAnEdge().mesh(); }, "non-manifold edge: edge (");
  hard("two cones that share their tip", "a hinge that is none")
      .expectRefused([] { twoConesAtAPoint().mesh(); }, "non-manifold vertex: at vertex 0");
  hard("a Klein bottle", "a surface without inside")
      .expectRefused(
          [] {
            const Shape bottle = kleinBottle(12, 8);
            repairSurface(bottle.points, bottle.triangles);
          },
          "the surface cannot be mended: ");
  hard("a surface that encloses nothing", "a body of no volume")
      .expectRefused([] { flatBipyramid(8).mesh(); }, "no volume: ");
}

}  // namespace
}  // namespace palpate::test
