// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>
#include <random>

#include "contact/contact_zones.h"
#include "contact/mesh_shape.h"
#include "contact/unilateral_contact.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"

// Tools that hold what they touch.

namespace palpate::test {
namespace {

const TouchedBody& fineSphere() {
  static const TouchedBody body = touchedSphere(3, true);
  return body;
}
/// 162 vertices, edges of about .3.
const TouchedBody& coarseSphere() {
  static const TouchedBody body = touchedSphere(2, true);
  return body;
}

RigidPose at(const Eigen::Vector3d& position, double turned = 0) {
  RigidPose pose;
  pose.position = position;
  pose.orientation =
      Eigen::Quaterniond(Eigen::AngleAxisd(turned, Eigen::Vector3d(0.2, 0.1, 1).normalized()));
  return pose;
}

std::vector<Obstacle> balls(double radius, double friction, int count = 1) {
  return std::vector<Obstacle>(count, {std::make_shared<SphereShape>(radius), friction});
}

/// Of a ball that meets the finer sphere with its vertices alone.
constexpr double kLargeRadius = 0.8;

/// What is held, and where it was when that began.
struct Grip {
  std::vector<int> nodes;
  Eigen::Matrix3Xd places;
  explicit Grip(const UnilateralContact& contact) {
    for (int i = 0; i < contact.watchedCount(); ++i) {
      if (!contact.watched(i).held) continue;
      EXPECT_GE(contact.watched(i).vertex, 0);
      nodes.push_back(contact.watched(i).vertex);
      places.conservativeResize(3, nodes.size());
      places.col(nodes.size() - 1) = contact.restPlace(i) + contact.watched(i).displacement;
    }
  }
  /// Carried along by a tool from one pose to another.
  Eigen::Matrix3Xd carried(const RigidPose& from, const RigidPose& to) const {
    Eigen::Matrix3Xd carried = places;
    for (int k = 0; k < carried.cols(); ++k)
      carried.col(k) = to.toWorld(from.toOwn(Eigen::Vector3d(places.col(k))));
    return carried;
  }
};

/// Force and torque on the tool, by the local buffer model of the nodes that it holds (eq. 26-28).
Wrench bufferWrench(const TouchedBody& body, const Grip& grip, const Eigen::Matrix3Xd& places,
                    const Eigen::Vector3d& centre) {
  const ContactZones zones(body.greens, *body.mesh, {{grip.nodes, centre}});
  const Eigen::Matrix3Xd displacement = places - body.mesh->points()(Eigen::all, grip.nodes);
  const Eigen::VectorXd tractions = zones.tractions(displacement.reshaped());
  Wrench wrench = kNoWrench;
  for (std::size_t k = 0; k < grip.nodes.size(); ++k) {
    const Eigen::Vector3d force =
        -body.greens->vertexArea(grip.nodes[k]) * tractions.segment<3>(3 * k);
    wrench.force += force;
    wrench.torque += (places.col(k) - centre).cross(force);
  }
  return wrench;
}

TEST(UnilateralContactHold, PullsAsTheCapacitanceMatrixOfItsNodesSays) {
  const TouchedBody& body = fineSphere();
  UnilateralContact contact(body.greens, body.mesh, balls(kLargeRadius, 0.3));
  const RigidPose pressed = at({0.05, 0, 1.74});
  for (int tick = 0; tick < 10; ++tick) contact.step(&pressed);
  const Eigen::Vector3d before = contact.force(0);
  EXPECT_GT(before.z(), 0);
  contact.setHeld(0, true);
  EXPECT_LE(contact.step(&pressed).residual, 1e-9);
  EXPECT_LE((contact.force(0) - before).norm(), 1e-6 * before.norm()) << "held where it is";
  const Grip grip(contact);
  ASSERT_GE(grip.nodes.size(), 4u);
  for (const RigidPose& pose :
       {at({0.05, 0, 1.8}), at({0.1, 0.05, 1.9}), at({0, 0, 1.88}, 0.2), at({0, 0, 1.75}, 0.1)}) {
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    const Wrench wrench = contact.wrench(0);
    const Wrench exact = bufferWrench(body, grip, grip.carried(pressed, pose), pose.position);
    EXPECT_LE((wrench.force - exact.force).norm(), 1e-6 * exact.force.norm());
    EXPECT_LE((wrench.torque - exact.torque).norm(),
              1e-6 * (exact.torque.norm() + kLargeRadius * exact.force.norm()));
    EXPECT_EQ(Grip(contact).nodes.size(), grip.nodes.size());
    if (pose.position.z() > 1.8) {
      EXPECT_LT(wrench.force.z(), 0) << "the surface draws the tool back";
    }
  }
  EXPECT_GT(contact.wrench(0).torque.norm(), 1e-3) << "it was turned";
}

/// The smaller ball also meets points inside triangles, which it has drawn round itself.
TEST(UnilateralContactHold, LetsGoWhenItIsReleased) {
  const TouchedBody& body = fineSphere();
  for (const double radius : {kLargeRadius, 0.5}) {
    UnilateralContact contact(body.greens, body.mesh, balls(radius, 0)),
        fresh(body.greens, body.mesh, balls(radius, 0));
    const RigidPose pressed = at({0.05, 0, 0.94 + radius}), lifted = at({0.05, 0, 1.1 + radius});
    for (int tick = 0; tick < 10; ++tick) contact.step(&pressed);
    contact.setHeld(0, true);
    contact.step(&lifted);
    EXPECT_LT(contact.force(0).z(), 0);
    contact.setHeld(0, false);
    EXPECT_EQ(contact.step(&lifted).contactCount, 0);
    EXPECT_EQ(contact.force(0), Eigen::Vector3d::Zero());
    for (int i = 0; i < contact.watchedCount(); ++i) EXPECT_FALSE(contact.watched(i).held);
    // And presses again as one that never held; without friction nothing is left of what was.
    contact.setHeld(0, true);
    contact.step(&pressed);
    contact.step(&pressed);
    contact.setHeld(0, false);
    for (int tick = 0; tick < 20; ++tick) {
      contact.step(&pressed);
      fresh.step(&pressed);
    }
    // Points inside triangles settle to 1e-4 of their triangles.
    EXPECT_LE((contact.force(0) - fresh.force(0)).norm(),
              (radius == kLargeRadius ? 1e-6 : 1e-4) * fresh.force(0).norm());
  }
}

TEST(UnilateralContactHold, HoldsWhatItComesToTouch) {
  const TouchedBody& body = fineSphere();
  UnilateralContact contact(body.greens, body.mesh, balls(kLargeRadius, 0.3));
  contact.setHeld(0, true);
  std::size_t held = 0;
  for (int tick = 0; tick <= 40; ++tick) {
    const RigidPose pose = at({0, 0, 1.82 - 0.003 * tick});
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    const std::size_t now = Grip(contact).nodes.size();
    EXPECT_GE(now, held);
    held = now;
  }
  EXPECT_GE(held, 6u);
  const RigidPose lifted = at({0, 0, 1.86});
  contact.step(&lifted);
  EXPECT_EQ(Grip(contact).nodes.size(), held);
  EXPECT_LT(contact.force(0).z(), 0);
}

/// What is held is elastic: a closed path gives all of its work back.
TEST(UnilateralContactHold, DoesNoWorkRoundAClosedPath) {
  const TouchedBody& body = fineSphere();
  UnilateralContact contact(body.greens, body.mesh, balls(kLargeRadius, 0.3));
  Eigen::Vector3d last(0, 0, 1.74);
  RigidPose pose = at(last);
  for (int tick = 0; tick < 10; ++tick) contact.step(&pose);
  contact.setHeld(0, true);
  contact.step(&pose);
  const Eigen::Vector3d start = last;
  double work = 0, largest = 0;
  for (int t = 1; t <= 100; ++t) {
    const double a = t * std::acos(-1.) / 50;
    const Eigen::Vector3d before = contact.force(0),
                          place =
                              start + Eigen::Vector3d(0.05 * std::sin(a), 0.03 * std::sin(2 * a),
                                                      0.1 * (1 - std::cos(a)));
    pose = at(place);
    contact.step(&pose);
    work += (before + contact.force(0)).dot(place - last) / 2;
    largest = std::max(largest, std::abs(work));
    last = place;
  }
  EXPECT_LE(std::abs(work), 1e-8 * largest);
}

/// Compliance of the point of a contact inside a triangle, ContactSite::spread of the way to the
/// mean of its nodes' own.
Eigen::Matrix3d siteCompliance(const GreensFunctions& greens, const ContactSite& site) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), mean = Eigen::Matrix3d::Zero(), block;
  for (int k = 0; k < site.count; ++k)
    for (int l = 0; l < site.count; ++l) {
      const int row = site.parts[k].node, column = site.parts[l].node;
      greens.gather(Eigen::Map<const Eigen::VectorXi>(&row, 1),
                    Eigen::Map<const Eigen::VectorXi>(&column, 1), block.data());
      sum += site.parts[k].weight * site.parts[l].weight / greens.vertexArea(column) * block;
      if (k == l) mean += site.parts[k].weight / greens.vertexArea(column) * block;
    }
  return (1 - site.spread) * sum + site.spread * mean;
}

TEST(UnilateralContactHold, PointsInsideTrianglesStayWhereTheyAre) {
  const TouchedBody& body = coarseSphere();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  int top;
  body.mesh->triangleNormals().row(2).maxCoeff(&top);
  for (int k = 0; k < 3; ++k) middle += body.mesh->points().col(body.mesh->triangles()(k, top)) / 3;
  const Eigen::Vector3d normal = body.mesh->triangleNormals().col(top);
  UnilateralContact contact(body.greens, body.mesh, balls(0.04, 0.5));
  const RigidPose pressed = at(middle + 0.02 * normal);
  for (int tick = 0; tick < 20; ++tick) contact.step(&pressed);
  contact.setHeld(0, true);
  contact.step(&pressed);
  int held = -1;
  for (int i = 0; i < contact.watchedCount(); ++i)
    if (contact.watched(i).held) {
      EXPECT_EQ(held, -1);
      EXPECT_EQ(contact.watched(i).triangle, top);
      held = i;
    }
  ASSERT_GE(held, 0);
  const ContactSite site = contact.site(held);
  const Eigen::Vector3d rest = contact.restPlace(held),
                        place = rest + contact.watched(held).displacement;
  for (const Eigen::Vector3d& way :
       {Eigen::Vector3d(0.05 * normal), Eigen::Vector3d(0.03, -0.02, 0.06)}) {
    const RigidPose pose = at(pressed.position + way);
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(contact.site(held).parts[k].weight, site.parts[k].weight);
    const Eigen::Vector3d exact =
        -siteCompliance(*body.greens, site).inverse() * (place + way - rest);
    EXPECT_LE((contact.force(0) - exact).norm(), 1e-6 * exact.norm());
    EXPECT_LT(contact.force(0).dot(normal), 0);
  }
  contact.setHeld(0, false);
  const RigidPose away = at(pressed.position + 0.06 * normal);
  contact.step(&away);
  EXPECT_EQ(contact.force(0), Eigen::Vector3d::Zero());
}

/// Held vertices cannot yield to another tool: it would feel no end of force.
TEST(UnilateralContactHold, OthersDoNotTouchWhatIsHeld) {
  const TouchedBody& body = coarseSphere();
  UnilateralContact contact(body.greens, body.mesh, balls(0.3, 0.3, 2));
  RigidPose poses[] = {at({0, 0, 1.25}), at({0.4, 0, 1.8})};
  for (int tick = 0; tick < 10; ++tick) contact.step(poses);
  contact.setHeld(0, true);
  double largest = contact.force(0).norm();
  for (int tick = 0; tick <= 100; ++tick) {
    poses[1] = at({0.4, 0, 1.8 - 0.0065 * tick});
    const ContactCertificate certificate = contact.step(poses);
    EXPECT_LE(certificate.residual, 1e-9) << tick;
    for (int i = 0; i < 2; ++i) largest = std::max(largest, contact.force(i).norm());
  }
  EXPECT_GT(contact.force(1).norm(), 0);
  EXPECT_LE(largest, 10) << "a body of E = 2.5, pressed in by a tenth";
  contact.setHeld(0, false);
  EXPECT_LE(contact.step(poses).residual, 1e-9);
}

/// What two balls that wander over large triangles come to: vertices and points inside are touched,
/// held and let go.
struct Course {
  double largestForce = 0, worstResidual = 0;
  int cut = 0;
  Course(double radius, bool holds) {
    const TouchedBody& body = coarseSphere();
    UnilateralContactSettings settings;
    settings.linearisations = 2;
    UnilateralContact contact(body.greens, body.mesh, balls(radius, 0.4, 2), settings);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::Vector3d way[2] = {{0.5, 0, 0.8}, {-0.5, 0, 0.8}};
    for (int tick = 0; tick < 600; ++tick) {
      RigidPose poses[2];
      for (int i = 0; i < 2; ++i) {
        const double x = uniform(random), y = uniform(random);
        way[i] += 0.02 * Eigen::Vector3d(x, y, 0);
        way[i].head<2>() = way[i].head<2>().cwiseMax(-0.7).cwiseMin(0.7);
        const double depth = 0.05 * std::sin(0.05 * tick + i);
        poses[i] = at((1 + radius - depth) * way[i].normalized(), 0.1 * std::sin(0.03 * tick));
        if (holds && tick % 37 == 5 * i) contact.setHeld(i, !contact.isHeld(i));
      }
      const ContactCertificate certificate = contact.step(poses);
      EXPECT_FALSE(certificate.failed);
      cut += certificate.budgetCut;
      worstResidual = std::max(worstResidual, certificate.residual);
      for (int i = 0; i < 2; ++i) largestForce = std::max(largestForce, contact.force(i).norm());
    }
  }
};

TEST(UnilateralContactHold, StaysBoundedWhateverIsHeld) {
  for (const double radius : {0.05, 0.15, 0.4}) {
    const Course pressing(radius, false), holding(radius, true);
    EXPECT_LE(holding.cut, pressing.cut + 3) << radius << ": steps that friction keeps unsolved";
    // Of a step that is cut: .014 where the balls press only.
    EXPECT_LE(holding.worstResidual, holding.cut == 0 ? 1e-9 : 0.03) << radius;
    EXPECT_LE(holding.largestForce, 10) << radius;
    EXPECT_GT(holding.largestForce, pressing.largestForce / 2) << radius;
    RecordProperty("radius " + std::to_string(radius),
                   std::to_string(pressing.cut) + " " + std::to_string(pressing.worstResidual) +
                       " " + std::to_string(pressing.largestForce) + "; held " +
                       std::to_string(holding.cut) + " " + std::to_string(holding.worstResidual) +
                       " " + std::to_string(holding.largestForce));
  }
}

TEST(UnilateralContactHold, DoesNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  const TouchedBody& body = coarseSphere();
  UnilateralContactSettings settings;
  settings.solver.largestUpdates = 8;
  UnilateralContact contact(body.greens, body.mesh, balls(0.1, 0.3, 2), settings);
  const long before = allocationCount();
  for (int tick = 0; tick < 200; ++tick) {
    const RigidPose poses[2] = {at({0.3, 0, 1.05 + 0.1 * std::sin(0.1 * tick)}),
                                at({-0.3, 0, 1.05 + 0.1 * std::cos(0.1 * tick)})};
    contact.setHeld(tick % 2, tick % 30 > 10);
    contact.step(poses);
  }
  contact.reset();
  EXPECT_EQ(allocationCount(), before);
}

}  // namespace
}  // namespace palpate::test
