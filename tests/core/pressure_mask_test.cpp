// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/pressure_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>

#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

constexpr MaskShape kShapes[] = {MaskShape::Linear, MaskShape::Uniform, MaskShape::Gaussian,
                                 MaskShape::Hertzian};

/// A surface with a boundary type a vertex.
struct Surface {
  Surface(const Shape& shape, const std::function<bool(const Eigen::Vector3d&)>& fixed)
      : mesh(shape.mesh()), conditions(fixedWhere(shape, fixed)) {}
  PressureMasks masks(MaskShape shape, double radius,
                      MaskDistance distance = MaskDistance::Euclidean) const {
    return {*mesh, conditions, shape, radius, distance};
  }
  double distance(int a, int b) const {
    return (mesh->points().col(a) - mesh->points().col(b)).norm();
  }
  std::shared_ptr<const SurfaceMesh> mesh;
  BoundaryConditions conditions;
};

Surface someSphere() {
  return {jitteredSphere(2, 0.2), [](const auto& x) { return x.z() < -0.6; }};
}
Surface freeSurface(const Shape& shape) {
  return {shape, [](const auto&) { return false; }};
}

std::vector<int> sorted(std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

int vertexNear(const SurfaceMesh& mesh, const Eigen::Vector3d& place) {
  Eigen::Index vertex;
  (mesh.points().colwise() - place).colwise().norm().minCoeff(&vertex);
  return static_cast<int>(vertex);
}

TEST(MaskValue, IsOneAtTheCentreAndZeroFromTheRadiusOn) {
  for (MaskShape shape : kShapes) {
    EXPECT_EQ(maskValue(shape, 0), 1);
    EXPECT_EQ(maskValue(shape, 1), 0);
    EXPECT_EQ(maskValue(shape, 7), 0);
    double before = 1;
    for (double t = 0; t < 1; t += 0.01) {
      EXPECT_GT(maskValue(shape, t), 0);
      EXPECT_LE(maskValue(shape, t), before) << "no mask rises outwards";
      before = maskValue(shape, t);
    }
  }
}

TEST(MaskValue, HasTheShapeOfItsName) {
  EXPECT_DOUBLE_EQ(maskValue(MaskShape::Linear, 0.25), 0.75);
  EXPECT_DOUBLE_EQ(maskValue(MaskShape::Uniform, 0.99), 1);
  EXPECT_DOUBLE_EQ(maskValue(MaskShape::Hertzian, 0.6), 0.8);
  // One standard deviation, a third of the radius, and two of them.
  EXPECT_NEAR(maskValue(MaskShape::Gaussian, 1 / 3.0), std::exp(-0.5), 1e-15);
  EXPECT_NEAR(maskValue(MaskShape::Gaussian, 2 / 3.0), std::exp(-2.0), 1e-15);
}

TEST(MaskShape, IsKnownByItsNameAlone) {
  EXPECT_EQ(maskShapeFromName("linear"), MaskShape::Linear);
  EXPECT_EQ(maskShapeFromName("uniform"), MaskShape::Uniform);
  EXPECT_EQ(maskShapeFromName("gaussian"), MaskShape::Gaussian);
  EXPECT_EQ(maskShapeFromName("hertzian"), MaskShape::Hertzian);
  EXPECT_TRUE(isRefused([] { maskShapeFromName("Linear"); },
                        "there is no mask 'Linear': choose linear, uniform, gaussian or hertzian"));
}

TEST(PressureMask, TransmitsExactlyTheForceAlsoWhereItOverlapsTheSupport) {
  const Surface sphere = someSphere();
  const double edge = sphere.mesh->meanEdgeLength();
  int overlaps = 0;
  for (MaskShape shape : kShapes)
    for (double radius : {0.0, 0.7 * edge, 2 * edge, 5 * edge}) {
      const PressureMasks masks = sphere.masks(shape, radius);
      for (int v : sphere.conditions.freeNodes()) {
        const VertexMask mask = masks.at(v);
        double force = 0;
        for (std::size_t j = 0; j < mask.nodes.size(); ++j)
          force += sphere.mesh->vertexAreas()[mask.nodes[j]] * mask.density[j];
        EXPECT_NEAR(force, 1, 1e-14);  // eq. 31; rounding of up to a hundred terms
        for (int node : mask.nodes) EXPECT_FALSE(sphere.conditions.isFixed(node));
        for (int u : sphere.conditions.fixedNodes()) overlaps += sphere.distance(u, v) < radius;
      }
    }
  EXPECT_GT(overlaps, 100) << "some masks should reach over the support";
}

TEST(PressureMask, IntegratesToOneAsAPiecewiseLinearDensity) {
  const Surface sphere = someSphere();
  const PressureMasks masks = sphere.masks(MaskShape::Linear, 0.6);
  for (int v : sphere.conditions.freeNodes()) {
    const VertexMask mask = masks.at(v);
    Eigen::VectorXd density = Eigen::VectorXd::Zero(sphere.mesh->vertexCount());
    for (std::size_t j = 0; j < mask.nodes.size(); ++j) density[mask.nodes[j]] = mask.density[j];
    double integral = 0;  // eq. 29 of eq. 30: a linear function's mean is that of its corners
    for (int f = 0; f < sphere.mesh->triangleCount(); ++f)
      integral += sphere.mesh->triangleAreas()[f] * density(sphere.mesh->triangles().col(f)).mean();
    EXPECT_NEAR(integral, 1, 1e-14);
  }
}

TEST(PressureMask, IsItsFunctionalCollocatedAtTheFreeVerticesWithinTheRadius) {
  const Surface sphere = someSphere();
  const double radius = 0.6;  // small enough for straight and surface distance to agree on a ball
  for (MaskShape shape : kShapes) {
    const PressureMasks masks = sphere.masks(shape, radius);
    EXPECT_EQ(masks.radius(), radius);
    for (int v : sphere.conditions.freeNodes()) {
      const VertexMask mask = masks.at(v);
      std::vector<int> within;
      for (int u : sphere.conditions.freeNodes())
        if (sphere.distance(u, v) < radius) within.push_back(u);
      EXPECT_EQ(sorted(mask.nodes), within);
      const double atCentre =
          mask.density[std::find(mask.nodes.begin(), mask.nodes.end(), v) - mask.nodes.begin()];
      for (std::size_t j = 0; j < mask.nodes.size(); ++j)
        EXPECT_NEAR(mask.density[j] / atCentre,
                    maskValue(shape, sphere.distance(mask.nodes[j], v) / radius), 1e-14);
    }
  }
}

TEST(PressureMask, BelowTheEdgeLengthIsTheSingleVertex) {
  const Surface sphere = someSphere();
  const PressureMasks none = sphere.masks(MaskShape::Hertzian, 0);
  for (int v : sphere.conditions.freeNodes()) {
    double shortest = std::numeric_limits<double>::infinity();
    for (int u = 0; u < sphere.mesh->vertexCount(); ++u)
      if (u != v) shortest = std::min(shortest, sphere.distance(u, v));
    for (const VertexMask& mask : {none.at(v), sphere.masks(MaskShape::Linear, shortest).at(v),
                                   sphere.masks(MaskShape::Uniform, shortest / 2).at(v)}) {
      EXPECT_EQ(mask.nodes, std::vector<int>{v});
      EXPECT_DOUBLE_EQ(mask.density[0], 1 / sphere.mesh->vertexAreas()[v]);
    }
  }
}

TEST(PressureMask, NeverReachesAnotherComponent) {
  const Shape ball = icosphere(2).mapped([](const auto& x) {
    return Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()) * x;
  });
  const double top = ball.points.row(0).maxCoeff(), bottom = ball.points.row(0).minCoeff();
  const Surface alone = freeSurface(ball);
  const Surface pair = freeSurface(ball.with(ball.moved({top - bottom + 1e-5, 0, 0})));
  const int facing = vertexNear(*alone.mesh, {1, 0, 0});
  for (double radius : {0.5, 1.0, 3.0}) {
    const VertexMask one = alone.masks(MaskShape::Linear, radius).at(facing);
    const VertexMask both = pair.masks(MaskShape::Linear, radius).at(facing);
    EXPECT_EQ(one.nodes, both.nodes);
    EXPECT_EQ(one.density, both.density);
    EXPECT_GT(one.nodes.size(), 5u);
  }
}

TEST(PressureMask, NeverReachesTheFarSideOfAWall) {
  // A plate of thickness 0.05 with a hole-free rim; masks far wider than it is thick.
  const Surface plate = freeSurface(box({1, 1, 0.05}, {8, 8, 1}));
  for (double radius : {0.2, 0.6, 3.0})
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(0.5, 0.5, 0.05), Eigen::Vector3d(0.125, 0.5, 0.05)}) {
      const VertexMask mask =
          plate.masks(MaskShape::Linear, radius).at(vertexNear(*plate.mesh, place));
      EXPECT_GT(mask.nodes.size(), 4u);
      for (int node : mask.nodes) EXPECT_EQ(plate.mesh->points()(2, node), 0.05);
    }
  // Nor round a fold: both limbs of a torus, closer to each other than the radius.
  const Surface ring = freeSurface(torus(1, 0.8, 24, 24));
  const int inside = vertexNear(*ring.mesh, {0.2, 0, 0});
  const Eigen::Vector3d normal = ring.mesh->vertexNormals().col(inside);
  for (int node : ring.masks(MaskShape::Linear, 1).at(inside).nodes)
    EXPECT_GT(ring.mesh->vertexNormals().col(node).dot(normal), 0);
}

TEST(PressureMask, DoesNotDependOnHowTheBodyIsTurned) {
  // Vertices just at the radius and normals at right angles are where rounding could decide.
  const Shape cube = box({1, 1, 1}, {8, 8, 8});
  const Surface straight = freeSurface(cube);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7 + trial, Eigen::Vector3d(3, -1, 2).normalized()).toRotationMatrix();
    const Surface turned =
        freeSurface(cube.mapped([&](const auto& x) -> Eigen::Vector3d { return turn * x; }));
    for (int v = 0; v < straight.mesh->vertexCount(); ++v) {
      const VertexMask before = straight.masks(MaskShape::Uniform, 0.25).at(v);
      const VertexMask after = turned.masks(MaskShape::Uniform, 0.25).at(v);
      ASSERT_EQ(before.nodes, after.nodes) << "vertex " << v;
      EXPECT_LE((before.density - after.density).norm(), 1e-12 * before.density.norm());
    }
  }
}

TEST(PressureMask, DensityScalesWithTheInverseOfArea) {
  const Shape shape = jitteredSphere(2, 0.2);
  const VertexMask metres = freeSurface(shape).masks(MaskShape::Gaussian, 0.5).at(9);
  const VertexMask millimetres =
      freeSurface(shape.scaled(1e3)).masks(MaskShape::Gaussian, 500).at(9);
  EXPECT_EQ(metres.nodes, millimetres.nodes);
  EXPECT_LE((metres.density - 1e6 * millimetres.density).norm(), 1e-13 * metres.density.norm());
}

TEST(PressureMask, ReportsWhatItWouldHaveCoveredOfTheSupport) {
  const Surface sphere = someSphere(), whole = freeSurface(jitteredSphere(2, 0.2));
  for (MaskShape shape : kShapes) {
    const PressureMasks held = sphere.masks(shape, 0.6), free = whole.masks(shape, 0.6);
    int straddling = 0;
    for (int v : sphere.conditions.freeNodes()) {
      const VertexMask mask = held.at(v), uncut = free.at(v);
      // The free sphere's mask puts that share of the force on the vertices that are held here.
      double share = 0;
      for (std::size_t j = 0; j < uncut.nodes.size(); ++j)
        if (sphere.conditions.isFixed(uncut.nodes[j]))
          share += whole.mesh->vertexAreas()[uncut.nodes[j]] * uncut.density[j];
      EXPECT_NEAR(mask.supportShare, share, 1e-14);
      EXPECT_EQ(mask.beyondShare, 0) << "all of a ball within 0.6 is on this side";
      EXPECT_EQ(uncut.supportShare, 0);
      straddling += share > 0;
    }
    EXPECT_GT(straddling, 20);
  }
}

TEST(PressureMask, ReportsWhatOfAnotherComponentOrTheFarSideItLeavesOut) {
  const Shape ball = icosphere(2);
  const Surface pair = freeSurface(ball.with(ball.moved({0, 0, 2.00001})));
  const VertexMask top = pair.masks(MaskShape::Uniform, 0.5).at(0);
  EXPECT_NEAR(top.beyondShare, 0.5, 1e-6) << "the other ball's cap is its mirror image";
  const Surface plate = freeSurface(box({1, 1, 1e-6}, {8, 8, 1}));
  const int centre = vertexNear(*plate.mesh, {0.5, 0.5, 1e-6});
  EXPECT_NEAR(plate.masks(MaskShape::Uniform, 0.4).at(centre).beyondShare, 0.5, 0.01);
}

#ifdef PALPATE_WITH_CGAL
/// A block with a groove of 0.24 width and 1 depth along y, its sides sloping.
Shape groovedBlock() {
  return box({2, 1, 2}, {48, 8, 16}).mapped([](const Eigen::Vector3d& x) {
    const double inGroove = std::max(0., 1 - std::abs(x.x() - 1) / 0.12);
    return Eigen::Vector3d(x.x(), x.y(), x.z() * (1 - 0.5 * inGroove));
  });
}

TEST(GeodesicMask, DoesNotReachAcrossAGroove) {
  const Surface block = freeSurface(groovedBlock());
  const int bank = vertexNear(*block.mesh, {0.8333, 0.5, 2});
  const auto across = [&](const VertexMask& mask) {
    double share = 0;
    for (std::size_t j = 0; j < mask.nodes.size(); ++j)
      if (block.mesh->points()(0, mask.nodes[j]) > 1.1)
        share += block.mesh->vertexAreas()[mask.nodes[j]] * mask.density[j];
    return share;
  };
  // The other bank is 0.3 away as the crow flies, more than 2 along the surface.
  for (double radius : {0.5, 1.0, 1.5})
    EXPECT_EQ(across(block.masks(MaskShape::Linear, radius, MaskDistance::Geodesic).at(bank)), 0);
  EXPECT_GT(across(block.masks(MaskShape::Linear, 1.5).at(bank)), 0.1) << "a straight one does";
}

TEST(GeodesicMask, NeverReachesTheFarSideOfAWallNorAnotherComponent) {
  const Surface plate = freeSurface(box({1, 1, 0.05}, {8, 8, 1}));
  for (double radius : {0.2, 0.6, 3.0})
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(0.5, 0.5, 0.05), Eigen::Vector3d(0.125, 0.5, 0.05)}) {
      const VertexMask mask = plate.masks(MaskShape::Linear, radius, MaskDistance::Geodesic)
                                  .at(vertexNear(*plate.mesh, place));
      EXPECT_GT(mask.nodes.size(), 4u);
      for (int node : mask.nodes) EXPECT_EQ(plate.mesh->points()(2, node), 0.05);
    }
  const Shape ball = icosphere(2);
  const Surface alone = freeSurface(ball);
  const Surface pair = freeSurface(ball.with(ball.moved({0, 0, 2.00001})));
  const VertexMask one = alone.masks(MaskShape::Linear, 0.5, MaskDistance::Geodesic).at(0);
  const VertexMask both = pair.masks(MaskShape::Linear, 0.5, MaskDistance::Geodesic).at(0);
  EXPECT_EQ(one.nodes, both.nodes);
  EXPECT_EQ(one.density, both.density);
  EXPECT_EQ(both.beyondShare, 0) << "along the surface the other ball is infinitely far";
}

TEST(GeodesicMask, TransmitsExactlyTheForceAndIsNoWiderThanTheStraightOne) {
  const Surface sphere = someSphere();
  for (MaskShape shape : kShapes) {
    const PressureMasks straight = sphere.masks(shape, 0.6);
    const PressureMasks along = sphere.masks(shape, 0.6, MaskDistance::Geodesic);
    for (int v : sphere.conditions.freeNodes()) {
      const VertexMask mask = along.at(v);
      const std::vector<int> within = sorted(straight.at(v).nodes), nodes = sorted(mask.nodes);
      EXPECT_TRUE(std::includes(within.begin(), within.end(), nodes.begin(), nodes.end()));
      EXPECT_NEAR(sphere.mesh->vertexAreas()(mask.nodes).dot(mask.density), 1, 1e-14);
    }
  }
}

TEST(GeodesicMask, OnAFaceIsTheStraightOne) {
  // Within a plane both distances are the same, and the bounds leave the heat method no say along
  // edges; elsewhere it may be wrong by what it is known to be.
  const Surface block = freeSurface(box({1, 1, 1}, {16, 16, 16}));
  const int centre = vertexNear(*block.mesh, {0.5, 0.5, 1});
  const VertexMask straight = block.masks(MaskShape::Linear, 0.3).at(centre);
  const VertexMask along = block.masks(MaskShape::Linear, 0.3, MaskDistance::Geodesic).at(centre);
  double difference = 0;
  for (std::size_t j = 0; j < straight.nodes.size(); ++j) {
    const auto found = std::find(along.nodes.begin(), along.nodes.end(), straight.nodes[j]);
    const double there =
        found == along.nodes.end() ? 0 : along.density[found - along.nodes.begin()];
    difference +=
        block.mesh->vertexAreas()[straight.nodes[j]] * std::abs(there - straight.density[j]);
  }
  EXPECT_LT(difference, 0.05) << "the share of the force that is elsewhere";
}
#endif

TEST(PressureMask, WithoutFreeCentreOrWithoutRadiusIsRefused) {
  const Surface sphere = someSphere();
  const int fixed = sphere.conditions.fixedNodes().front();
  const PressureMasks masks = sphere.masks(MaskShape::Linear, 0.3);
  EXPECT_TRUE(isRefused(
      [&] { masks.at(fixed); },
      "vertex " + std::to_string(fixed) + " is fixed: a pressure mask needs a free node"));
  for (int v : {-1, sphere.mesh->vertexCount()})
    EXPECT_TRUE(isRefused([&] { masks.at(v); }, "there is no vertex " + std::to_string(v) +
                                                    " to put a pressure mask on"));
  for (double radius : {-1e-9, double(INFINITY), double(NAN)})
    EXPECT_TRUE(isRefused([&] { sphere.masks(MaskShape::Linear, radius); },
                          "the radius of a pressure mask must be at least 0, not "));
  const BoundaryConditions few({0, 0, 0});
  EXPECT_TRUE(isRefused([&] { PressureMasks(*sphere.mesh, few, MaskShape::Linear, 1); },
                        "there are boundary types of 3 vertices for a surface of 162"));
}

}  // namespace
}  // namespace palpate::test
