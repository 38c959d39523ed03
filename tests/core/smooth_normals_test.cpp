// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Bodies of facets that stand for smooth ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/mesh_shape.h"
#include "contact/unilateral_contact.h"
#include "support/contact_bodies.h"
#include "support/obstacles.h"

namespace palpate::test {
namespace {

TEST(SmoothNormals, AreNearlyRadialOnASphereAndHaveNoJumps) {
  const MeshShape sphere(icosphere(2).mesh());  // facets are tilted by up to .16
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double jump = 0, facetJump = 0, tilt = 0;
  Eigen::Vector3d facetBefore = before;
  for (int k = 0; k <= 2000; ++k) {
    const double angle = 1e-3 * k;
    const Eigen::Vector3d way = Eigen::Vector3d(std::sin(angle), 0.3, std::cos(angle)).normalized();
    const Proximity near = sphere.proximity(0.9 * way);
    const Eigen::Vector3d normal = sphere.smoothNormal(near);
    EXPECT_NEAR(normal.norm(), 1, 1e-12);
    tilt = std::max(tilt, (normal - way).norm());
    if (k > 0) {
      jump = std::max(jump, (normal - before).norm());
      facetJump = std::max(facetJump, (near.normal - facetBefore).norm());
    }
    before = normal;
    facetBefore = near.normal;
  }
  EXPECT_LE(tilt, 0.05);
  // From inside the nearest place jumps over an edge, by the depth times the facets' angle.
  EXPECT_LE(jump, 0.05);
  EXPECT_GE(facetJump, 3 * jump);
}

TEST(SmoothNormals, OfABoxAreThoseOfItsFacesAndEdges) {
  const MeshShape box(test::box({1, 1, 1}, {2, 2, 2}).mesh());
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(0.3, 0.4, 0.9), Eigen::Vector3d(0.3, 0.4, 1.1),
        Eigen::Vector3d(1.2, 0.6, 0.3), Eigen::Vector3d(1.1, 0.4, 1.2),
        Eigen::Vector3d(1.1, 1.3, 1.2)}) {
    const Proximity near = box.proximity(place);
    EXPECT_LE((box.smoothNormal(near) - near.normal).norm(), 1e-12) << place.transpose();
  }
}

/// Two equal bodies, the second upside down on the first, without friction. Vertex on vertex the
/// nearest facet would drive one to a side by a third of the force.
TEST(SmoothNormals, ElasticBodiesApexOnApexPressStraight) {
  for (int level : {1, 2}) {
    const Shape sphere = icosphere(level);
    const TouchedBody body =
        touchedBody(sphere, fixedWhere(sphere, [](const auto& x) { return x.z() < -0.6; }), true);
    const auto shape = std::make_shared<MeshShape>(body.mesh);
    for (double aside : {0.0, 0.001, 0.02}) {
      UnilateralContact contact(body.greens, body.mesh, {{shape, 0, body.greens, body.mesh}}, {});
      RigidPose pose = at(aside, 0, 2);
      pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
      for (int tick = 0; tick < 200; ++tick) {
        pose.position.z() = 2 - 0.05 * std::min(1.0, tick / 100.0);
        contact.step(&pose);
      }
      const Eigen::Vector3d force = contact.force(0);
      EXPECT_GT(force.z(), 0.01);
      // Where they meet aside of each other the normal is tilted by aside / 2; the dents double it.
      EXPECT_LE(force.head<2>().norm(), (1.5 * aside + 1e-6) * force.norm())
          << level << ' ' << aside;
    }
  }
}

/// Facets' own normals leave up to .28 of the work.
TEST(SmoothNormals, ABallOfTrianglesGivesItsWorkBackOnAClosedPath) {
  const TouchedBody body = touchedSphere(3, true);
  for (double radius : {0.2, 0.3, 0.6})
    for (int sense : {-1, 1}) {
      const auto shape = std::make_shared<MeshShape>(icosphere(3).scaled(radius).mesh());
      UnilateralContact contact(body.greens, body.mesh, {{shape, 0}}, still(300));
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), before = force;
      double work = 0, most = 0;
      constexpr int steps = 400;
      for (int tick = 0; tick <= steps; ++tick) {
        const double turn = sense * 2 * M_PI * tick / steps;
        const Eigen::Vector3d way =
            Eigen::Vector3d(0.2 * std::sin(turn), 0.2 - 0.2 * std::cos(turn), 1);
        const Eigen::Vector3d centre =
            (1 + radius - 0.03 * (1 - std::cos(turn)) / 2) * way.normalized();
        const RigidPose pose = at(centre.x(), centre.y(), centre.z());
        contact.step(&pose);
        if (tick > 0) work -= (contact.force(0) + force).dot(centre - before) / 2;
        force = contact.force(0);
        before = centre;
        most = std::max(most, work);
      }
      EXPECT_LE(std::abs(work), 0.06 * most) << radius << ' ' << sense;
    }
}

}  // namespace
}  // namespace palpate::test
