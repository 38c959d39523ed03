// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Contact against what Hertz, Amontons and Coulomb found.

#include <gtest/gtest.h>

#include <cmath>

#include "contact/mesh_shape.h"
#include "contact/unilateral_contact.h"
#include "support/contact_bodies.h"
#include "support/obstacles.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kModulus = 2.5 / (1 - 0.3 * 0.3);  ///< E* of touchedBody against a rigid tool

/// A unit sphere, fixed below, with a mesh that gets fine towards its north pole.
const TouchedBody& polishedSphere() {
  static const TouchedBody body = [] {
    const Shape shape =
        ringedSphere([](double angle) { return std::max(0.005, 0.3 * (angle - 0.02)); }, {2.3});
    return touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() < -0.7; }), true);
  }();
  return body;
}

/// How the pressures at watched vertices differ from Hertz's under the same force: root mean square
/// over area, relative to his.
double profileError(const UnilateralContact& contact, const TouchedBody& body, double radius) {
  const double force = contact.wrench(0).force.z();
  double difference = 0, norm = 0;
  for (int i = 0; i < contact.watchedCount(); ++i) {
    const UnilateralContact::Watched watched = contact.watched(i);
    const double r = body.mesh->points().col(watched.vertex).head<2>().norm() / radius;
    const double peak = 3 * force / (2 * kPi * radius * radius);
    const double hertz = r < 1 ? peak * std::sqrt(1 - r * r) : 0;
    const double area = body.greens->vertexArea(watched.vertex);
    const double pressure = -watched.force.z() / area;
    difference += area * (pressure - hertz) * (pressure - hertz);
    norm += area * hertz * hertz;
  }
  return std::sqrt(difference / norm);
}

TEST(UnilateralContactLaws, ABallPressesAsHertzFound) {
  constexpr double radius = 0.1, effective = radius / (radius + 1);
  const TouchedBody& body = polishedSphere();
  UnilateralContact contact(body.greens, body.mesh, ball(radius), still(300, 0.004));
  std::vector<double> forces;
  for (double depth : {0.004, 0.006, 0.008}) {
    const RigidPose pose = at(0, 0, 1 + radius - depth);
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    const double force = contact.wrench(0).force.z();
    forces.push_back(force);
    // Beyond the mesh, the body's own size matters by contact radius over radius, .03.
    EXPECT_NEAR(force / (4.0 / 3 * kModulus * std::sqrt(effective) * std::pow(depth, 1.5)), 1,
                0.02);
    EXPECT_LE(profileError(contact, body, std::cbrt(3 * force * effective / (4 * kModulus))), 0.05);
    EXPECT_LE(contact.penetration(), 1e-10);
  }
  EXPECT_NEAR(std::log(forces[2] / forces[0]) / std::log(2), 1.5, 0.03);
}

TEST(UnilateralContactLaws, SlidingAPlateTakesAmontonsForce) {
  for (double friction : {0.1, 0.5}) {
    const TouchedBody& body = polishedSphere();
    UnilateralContact contact(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), friction}},
                              still(300, 0.004));
    double before = 0;
    for (int tick = 0; tick <= 40; ++tick) {
      const RigidPose pose = plate(0.999, 1e-4 * tick);
      EXPECT_LE(contact.step(&pose).residual, 1e-9);
      const Eigen::Vector3d force = contact.wrench(0).force;
      const double ratio = force.head<2>().norm() / force.z();
      EXPECT_LE(ratio, friction * (1 + 1e-8));
      EXPECT_GE(ratio, before * (1 - 1e-6));  // partial slip spreads until all slips
      before = ratio;
    }
    const Eigen::Vector3d force = contact.wrench(0).force;
    EXPECT_NEAR(-force.x() / force.z(), friction, 1e-6 * friction);  // against the motion
    for (int i = 0; i < contact.watchedCount(); ++i)
      EXPECT_NE(contact.watched(i).status, ContactStatus::Stick);
  }
}

/// A block that rests on one vertex, pulled at an angle from the normal of what it rests on, as by
/// its weight on an incline.
TEST(UnilateralContactLaws, ABlockOnAnInclineSlipsBeyondTheAngleOfFriction) {
  const TouchedBody& body = polishedSphere();
  int pole;
  body.mesh->points().row(2).maxCoeff(&pole);
  ContactCompliance own({body.greens}, 1, 1);
  ASSERT_TRUE(own.add(ContactSite::atNode(0, pole)));
  constexpr double friction = 0.4;
  const double threshold = std::atan(friction);
  for (double angle : {0.2, 0.9, 0.999999, 1.000001, 1.1, 2.0}) {
    UnilateralContact contact(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), friction}},
                              still(300, 0.004));
    const double tilt = angle * threshold;
    // Displacement under the weight; the pole alone may touch.
    const Eigen::Vector3d weight = 1e-7 * Eigen::Vector3d(std::sin(tilt), 0, -std::cos(tilt));
    const Eigen::Vector3d moved = own.block(0, 0) * weight;
    RigidPose pose = plate(1);
    contact.step(&pose);
    pose = plate(1 + moved.z(), moved.x());
    pose.position.y() = moved.y();
    const ContactCertificate certificate = contact.step(&pose);
    ASSERT_EQ(certificate.contactCount, 1);
    const Eigen::Vector3d force = -contact.wrench(0).force;
    ContactStatus status = ContactStatus::Open;
    for (int i = 0; i < contact.watchedCount(); ++i)
      if (contact.watched(i).vertex == pole) status = contact.watched(i).status;
    EXPECT_EQ(status, angle < 1 ? ContactStatus::Stick : ContactStatus::Slip) << angle;
    if (angle < 1) {
      EXPECT_LE((force - weight).norm(), 1e-8 * weight.norm());
    } else {
      EXPECT_NEAR(force.head<2>().norm(), -friction * force.z(), 1e-8 * force.norm());
    }
  }
}

/// Two equal polished spheres, the second upside down on the first.
Obstacle polishedObstacle() {
  const TouchedBody& body = polishedSphere();
  return {std::make_shared<MeshShape>(body.mesh), 0, body.greens, body.mesh};
}

TEST(UnilateralContactLaws, TwoElasticSpheresPressAsHertzFound) {
  const TouchedBody& body = polishedSphere();
  UnilateralContact contact(body.greens, body.mesh, {polishedObstacle()}, still(300, 0.004));
  RigidPose pose;
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
  std::vector<double> forces;
  for (double depth : {0.0005, 0.001}) {
    pose.position = {0, 0, 2 - depth};
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    forces.push_back(contact.wrench(0).force.z());
    // Both bodies yield, E* is half of one's, and both are curved. Their size matters by a / R.
    const double hertz = 4.0 / 3 * (kModulus / 2) * std::sqrt(0.5) * std::pow(depth, 1.5);
    EXPECT_NEAR(forces.back() / hertz, 1, 0.05);
  }
  EXPECT_NEAR(std::log(forces[1] / forces[0]) / std::log(2), 1.5, 0.075);
}

}  // namespace
}  // namespace palpate::test
