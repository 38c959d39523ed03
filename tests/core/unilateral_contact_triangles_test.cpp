// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/mesh_shape.h"
#include "contact/unilateral_contact.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"

// Tools smaller than the triangles that they touch.

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// 162 vertices, edges of about .3.
const TouchedBody& coarseSphere() {
  static const TouchedBody body = touchedSphere(2, true);
  return body;
}

/// A cube held below, its top face of 2 by 2 squares.
const TouchedBody& coarseCube() {
  static const TouchedBody body = [] {
    const Shape shape = box({1, 1, 1}, {2, 2, 2});
    return touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() == 0; }), true);
  }();
  return body;
}

RigidPose at(const Eigen::Vector3d& position) {
  RigidPose pose;
  pose.position = position;
  return pose;
}

UnilateralContactSettings still() {
  UnilateralContactSettings settings;
  settings.linearisations = 8;
  return settings;
}

/// Corners of the whole surface as the contact forces deform it.
Eigen::Matrix3Xd deformed(const UnilateralContact& contact, const TouchedBody& body) {
  Eigen::Matrix3Xd traction = Eigen::Matrix3Xd::Zero(3, body.mesh->vertexCount());
  for (int i = 0; i < contact.watchedCount(); ++i) {
    const ContactSite& site = contact.site(i);
    for (int p = 0; p < site.count; ++p)
      traction.col(site.parts[p].node) += site.parts[p].weight * contact.watched(i).force /
                                          body.greens->vertexArea(site.parts[p].node);
  }
  for (int v = 0; v < body.mesh->vertexCount(); ++v)
    if (body.greens->isFixed(v)) traction.col(v).setZero();
  return body.mesh->points() + solveReferenceProblem(*body.greens, traction);
}

/// How deep any point of the deformed surface lies in a tool, over a lattice in each triangle.
double deepest(const UnilateralContact& contact, const TouchedBody& body, const RigidShape& shape,
               const RigidPose& pose) {
  constexpr int n = 30;
  const Eigen::Matrix3Xd places = deformed(contact, body);
  double depth = 0;
  for (int f = 0; f < body.mesh->triangleCount(); ++f) {
    const Eigen::Vector3i t = body.mesh->triangles().col(f);
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = pose.toOwn(places.col(t[k]));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        depth = std::max(depth,
                         -shape.proximity(corners * Eigen::Vector3d(i, j, n - i - j) / n).distance);
  }
  return depth;
}

/// The point along a way from the middle of a body at a distance from its surface.
Eigen::Vector3d outAlong(const Eigen::Vector3d& way, const MeshShape& surface, double distance) {
  double low = 0, high = 2;
  while (high - low > 1e-12) {
    const double middle = (low + high) / 2;
    (surface.proximity(middle * way).distance < distance ? low : high) = middle;
  }
  return low * way;
}

TEST(UnilateralContactTriangles, NoPointOfTheSurfaceEndsInASmallBall) {
  const TouchedBody& body = coarseSphere();
  const MeshShape surface(body.mesh);
  for (double radius : {0.1, 0.03, 0.01}) {
    const auto shape = std::make_shared<SphereShape>(radius);
    UnilateralContact contact(body.greens, body.mesh, {{shape, 0}}, still());
    for (int tick = 0; tick < 150; ++tick) {  // over some eight triangles
      const double angle = 0.008 * tick, depth = radius / 2 * std::min(1.0, 0.05 * tick);
      const Eigen::Vector3d way =
          Eigen::Vector3d(std::sin(angle), 0.1, std::cos(angle)).normalized();
      const RigidPose pose = at(outAlong(way, surface, radius - depth));
      EXPECT_LE(contact.step(&pose).residual, 1e-9) << radius << ' ' << tick;
      if (tick % 5 == 0) {
        // ContactSite::kSpread, .5 %, of the depth; the dent's share of which is more than half.
        EXPECT_LE(deepest(contact, body, *shape, pose), 0.01 * depth) << radius << ' ' << tick;
      }
      if (tick > 0) {
        EXPECT_GT(contact.force(0).norm(), 0) << radius << ' ' << tick;
      }
    }
  }
}

/// Of a tool that rests only the surface moves: what it brings near is found as well.
TEST(UnilateralContactTriangles, ABallThatRestsFindsTheEquilibriumOfOneThatCame) {
  const TouchedBody& body = coarseSphere();
  const MeshShape surface(body.mesh);
  for (double radius : {0.2, 0.1, 0.03})
    for (double angle : {0.0, 0.2}) {
      const auto shape = std::make_shared<SphereShape>(radius);
      const Eigen::Vector3d way =
          Eigen::Vector3d(std::sin(angle), 0.1, std::cos(angle)).normalized();
      const double depth = 0.8 * radius;
      const RigidPose pose = at(outAlong(way, surface, radius - depth));
      UnilateralContact contact(body.greens, body.mesh, {{shape, 0}}, {});
      for (int tick = 0; tick <= 400; ++tick) {
        const double above = std::max(0.0, 1 - tick / 300.0) * depth;
        const RigidPose coming = at(pose.position + above * way);
        contact.step(&coming);
      }
      const Eigen::Vector3d came = contact.force(0);
      contact.reset();
      for (int tick = 0; tick < 100; ++tick) contact.step(&pose);
      // Not more than where it came, of triangles that the dent has stretched beyond the limit.
      EXPECT_LE(deepest(contact, body, *shape, pose), 0.02 * depth) << radius << ' ' << angle;
      // Points inside triangles settle to 1e-4 of their triangles.
      EXPECT_LE((contact.force(0) - came).norm(), 2e-3 * came.norm()) << radius << ' ' << angle;
    }
}

/// A cube that comes down with its edge or corner first: contacts whose normals contradict each
/// other, in a few of which the inverse that is kept from tick to tick leads astray.
TEST(UnilateralContactTriangles, SharpToolsUnderFrictionSettleUnderABudgetOfUpdates) {
  const TouchedBody& body = coarseSphere();
  UnilateralContactSettings settings;
  settings.solver.largestUpdates = 12;
  RigidPose pose;
  for (const Eigen::Vector3d& first : {Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(1, 1, 1)})
    for (double friction : {0.3, 1.0})
      for (double tilt : {0.0, 0.6})
        for (double depth : {0.1, 0.25}) {
          Shape cube = box({0.5, 0.5, 0.5}, {1, 1, 1}).moved({-0.25, -0.25, -0.25});
          cube.points = Eigen::Quaterniond::FromTwoVectors(first, -Eigen::Vector3d::UnitZ())
                            .toRotationMatrix() *
                        cube.points;
          cube.points.row(2).array() -= cube.points.row(2).minCoeff();
          const auto shape = std::make_shared<MeshShape>(cube.mesh());
          UnilateralContact contact(body.greens, body.mesh, {{shape, friction}}, settings);
          pose.orientation = Eigen::AngleAxisd(tilt, Eigen::Vector3d(1, 0.3, 0).normalized());
          int inARow = 0;
          for (int tick = 0; tick < 400; ++tick) {
            pose.position.z() = 1.02 - (depth + 0.02) * std::min(1.0, tick / 200.0);
            inARow = contact.step(&pose).budgetCut ? inARow + 1 : 0;
            // 20 in a row are a fault to ForceSafety, by which the force ends.
            EXPECT_LE(inARow, 5) << friction << ' ' << tilt << ' ' << depth << ' ' << tick;
          }
        }
}

/// Within a triangle a smooth point pushes along the triangle's normal as it tilts, so that nothing
/// of the mesh is felt.
TEST(UnilateralContactTriangles, ASmoothBallFeelsTheFaceAndNotItsPoints) {
  const TouchedBody& body = coarseCube();
  UnilateralContact contact(body.greens, body.mesh, {{std::make_shared<SphereShape>(0.02), 0}},
                            still());
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double largest = 0, work = 0;
  constexpr double step = 2e-3;
  for (int tick = 0; tick < 300; ++tick) {
    const RigidPose pose = at({0.2 + step * tick, 0.4, 1.018});
    contact.step(&pose);
    const Eigen::Vector3d force = contact.force(0);
    ASSERT_GT(force.z(), 0);
    if (tick > 0) {
      largest = std::max(largest, (force - before).norm());
      work += (force + before).x() / 2 * step;
    }
    before = force;
  }
  // Stiffness at vertices is about twice that between them, 1.5 and .8 N/m, over half an edge.
  EXPECT_LE(largest, 2 * 1.5 * 0.002 * step / 0.25);
  EXPECT_LE(std::abs(work), 1.5 * 0.002 * 0.002);  // the energies at the ends differ by less
}

TEST(UnilateralContactTriangles, ABallThatSticksIsHeldWhereItLanded) {
  const TouchedBody& body = coarseCube();
  UnilateralContact contact(body.greens, body.mesh, {{std::make_shared<SphereShape>(0.02), 0.5}},
                            still());
  RigidPose pose = at({0.3, 0.4, 1.018});
  contact.step(&pose);
  const double pressure = contact.force(0).z();
  double last = 0;
  for (int tick = 1; tick <= 100; ++tick) {
    pose.position.x() += 5e-5;
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    const Eigen::Vector3d force = contact.force(0);
    EXPECT_LE(std::hypot(force.x(), force.y()), 0.5 * force.z() * 1.05);  // the triangle tilts
    EXPECT_GE(-force.x(), last - 0.01 * pressure) << tick;  // grows while it sticks, then stays
    last = -force.x();
  }
  EXPECT_NEAR(last, 0.5 * contact.force(0).z(), 0.05 * pressure);
  EXPECT_LT(contact.force(0).x(), -0.3 * pressure);
}

/// Friction does not fade, however long a ball rests: on the free top and beside the support.
TEST(UnilateralContactTriangles, ABallThatSticksKeepsItsForceAtRest) {
  const TouchedBody& body = coarseCube();
  const auto ball = std::make_shared<SphereShape>(0.2);
  for (double friction : {0.3, 0.7, 1.0})
    for (bool onTop : {true, false}) {
      const Eigen::Vector3d landed =
          onTop ? Eigen::Vector3d(0.3, 0.37, 1.17) : Eigen::Vector3d(1.17, 0.53, 0.12);
      const Eigen::Vector3d away = 0.04 * Eigen::Vector3d::Unit(onTop ? 2 : 0);
      const Eigen::Vector3d drag = 0.05 * Eigen::Vector3d::Unit(onTop ? 1 : 2);
      UnilateralContact contact(body.greens, body.mesh, {{ball, friction}}, {});
      Eigen::Vector3d rested;
      for (int tick = 0; tick < 800; ++tick) {
        const RigidPose pose = at(landed + std::max(0.0, 1 - tick / 100.0) * away -
                                  std::clamp(tick / 100.0 - 1, 0.0, 1.0) * drag);
        contact.step(&pose);
        if (tick < 500) rested = contact.force(0);
        // Points inside triangles settle to 1e-4 of their triangles.
        EXPECT_LE((contact.force(0) - rested).norm(), 1e-4 * rested.norm())
            << friction << " " << onTop << " " << tick;
      }
      EXPECT_GT(std::abs(rested[onTop ? 1 : 2]), 0.2 * rested.norm());
    }
}

/// There it meets the rigid stiffness, but once, and not with each triangle that it comes to touch.
TEST(UnilateralContactTriangles, ABallPassesTheRimOfTheSupportWithoutAJump) {
  const TouchedBody& body = coarseCube();
  const double rigid = 10 * 2.5 * body.mesh->meanEdgeLength();
  for (double friction : {0.0, 0.3})
    for (double step : {1e-3, 2e-4}) {
      UnilateralContact contact(body.greens, body.mesh,
                                {{std::make_shared<SphereShape>(0.2), friction}}, {});
      const RigidPose begin = at({1.17, 0.53, 0.3});
      for (int tick = 0; tick < 100; ++tick) contact.step(&begin);
      Eigen::Vector3d before = contact.force(0);
      double largest = 0;
      for (double z = 0.3; z > -0.25; z -= step) {
        const RigidPose pose = at({1.17, 0.53, z});
        contact.step(&pose);
        largest = std::max(largest, (contact.force(0) - before).norm());
        before = contact.force(0);
      }
      EXPECT_LE(largest, 1.2 * rigid * step) << friction << " " << step;
      EXPECT_GT(largest, 0);
      EXPECT_EQ(before, Eigen::Vector3d::Zero());  // it has left
    }
}

TEST(UnilateralContactTriangles, ABarAcrossTrianglesIsHeldAlongItsLength) {
  const TouchedBody& body = coarseCube();
  const auto bar =
      std::make_shared<CapsuleShape>(Eigen::Vector3d(-0.3, 0, 0), Eigen::Vector3d(0.3, 0, 0), 0.01);
  UnilateralContact contact(body.greens, body.mesh, {{bar, 0.3}}, {});
  RigidPose pose = at({0.5, 0.35, 1.03});
  for (int tick = 0; tick < 100; ++tick) {
    pose.position.z() = std::max(1.0, 1.03 - 5e-4 * tick);
    contact.step(&pose);
  }
  EXPECT_LE(deepest(contact, body, *bar, pose), 1e-4);  // kSpread of the depth, .01, each
  const Wrench rest = contact.wrench(0);
  EXPECT_GT(rest.force.z(), 1e-3);
  for (int tick = 0; tick < 20; ++tick) {  // it has come to rest
    contact.step(&pose);
    EXPECT_LE((contact.force(0) - rest.force).norm(), 1e-3 * rest.force.norm());
  }
}

TEST(UnilateralContactTriangles, TheCornerOfABoxIsStoppedByAFace) {
  const TouchedBody& body = coarseSphere();
  const auto shape = std::make_shared<MeshShape>(box({0.2, 0.2, 0.2}, {1, 1, 1}).mesh());
  UnilateralContact contact(body.greens, body.mesh, {{shape, 0.3}}, still());
  RigidPose pose;
  pose.orientation =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0.1, 0.1, 1));
  const Eigen::Vector3d way = Eigen::Vector3d(0.1, 0.1, 1).normalized();
  for (int tick = 0; tick < 60; ++tick) {
    pose.position = (1.0 - 5e-4 * tick) * way;
    contact.step(&pose);
  }
  EXPECT_GT(contact.force(0).dot(way), 1e-3);
  EXPECT_LE(deepest(contact, body, *shape, pose), 2e-3);
}

TEST(UnilateralContactTriangles, OverlappingPartsPressOnceWhereTheyCoincide) {
  const TouchedBody& body = coarseSphere();
  std::vector<Obstacle> parts{{std::make_shared<SphereShape>(0.03), 0.3}};
  UnilateralContact one(body.greens, body.mesh, parts, still());
  parts.push_back(parts[0]);
  for (Obstacle& part : parts) part.tool = 0;
  UnilateralContact both(body.greens, body.mesh, parts, still());
  for (int tick = 0; tick < 40; ++tick) {
    const double angle = 0.01 * tick;
    const RigidPose pose = at(0.99 * Eigen::Vector3d(std::sin(angle), 0, std::cos(angle)));
    const RigidPose poses[2] = {pose, pose};
    one.step(&pose);
    both.step(poses);
    // Each of two yields by kSpread alone.
    EXPECT_LE((both.force(0) + both.force(1) - one.force(0)).norm(), 0.03 * one.force(0).norm())
        << tick;
  }
}

/// The facets of a smooth tool have normals that differ by up to .2.
TEST(UnilateralContactTriangles, ABallOfTrianglesRestsAndPressesAsABall) {
  const TouchedBody& body = coarseCube();
  for (int level : {2, 3})
    for (double radius : {0.05, 0.1, 0.2, 0.3})
      for (double friction : {0.0, 0.3})
        for (double x : {0.3, 0.45}) {
          UnilateralContact smooth(body.greens, body.mesh,
                                   {{std::make_shared<SphereShape>(radius), friction}}, {});
          const auto shape = std::make_shared<MeshShape>(icosphere(level).scaled(radius).mesh());
          UnilateralContact faceted(body.greens, body.mesh, {{shape, friction}}, {});
          Eigen::Vector3d before = Eigen::Vector3d::Zero();
          double jitter = 0;
          for (int tick = 0; tick < 400; ++tick) {
            const RigidPose pose = at({x, 0.37, 1 + radius - 0.02 * std::min(1.0, tick / 200.0)});
            smooth.step(&pose);
            faceted.step(&pose);
            if (tick > 300) jitter = std::max(jitter, (faceted.force(0) - before).norm());
            before = faceted.force(0);
          }
          const std::string what = std::to_string(level) + " " + std::to_string(radius) + " " +
                                   std::to_string(friction) + " " + std::to_string(x);
          EXPECT_LE(jitter, 1e-3 * before.norm()) << what;
          // Facets lie up to 2 and .5 % of the radius within the ball, of which .02 is pressed in.
          const double missing = (level == 2 ? 0.02 : 0.005) * radius / 0.02;
          EXPECT_LE((before - smooth.force(0)).norm(), (missing + 0.05) * before.norm()) << what;
        }
}

TEST(UnilateralContactTriangles, StepsDoNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  const TouchedBody& body = coarseSphere();
  UnilateralContact contact(
      body.greens, body.mesh,
      {{std::make_shared<SphereShape>(0.03), 0.3},
       {std::make_shared<MeshShape>(box({0.1, 0.1, 0.1}, {1, 1, 1}).mesh()), 0.3}},
      {});
  const long before = allocationCount();
  double largest = 0;
  for (int tick = 0; tick < 50; ++tick) {
    const double angle = 0.01 * tick;
    const RigidPose poses[2] = {
        at(Eigen::Vector3d(std::sin(angle), 0, std::cos(angle))),
        at(0.97 * Eigen::Vector3d(std::sin(angle + 1), 0, std::cos(angle + 1)))};
    contact.step(poses);
    largest = std::max(largest, contact.force(0).norm());
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(largest, 0);
}

}  // namespace
}  // namespace palpate::test
