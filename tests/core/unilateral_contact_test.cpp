// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/unilateral_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/mesh_shape.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/obstacles.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kModulus = 2.5 / (1 - 0.3 * 0.3);  ///< E* of touchedBody against a rigid tool

TEST(UnilateralContact, NoVertexOfTheWholeSurfaceEndsInTheTool) {
  const TouchedBody body = touchedSphere(3, true);
  const int n = body.mesh->vertexCount();
  UnilateralContact contact(body.greens, body.mesh, ball(0.4, 0.4), still(300));
  for (double depth = 0; depth < 0.1; depth += 0.01) {
    const RigidPose pose = at(0.3 * depth, 0, 1.4 - depth);
    EXPECT_LE(contact.step(&pose).residual, 1e-9);
    Eigen::Matrix3Xd traction = Eigen::Matrix3Xd::Zero(3, n);
    for (int i = 0; i < contact.watchedCount(); ++i) {
      const ContactSite& site = contact.site(i);
      for (int p = 0; p < site.count; ++p)
        traction.col(site.parts[p].node) += site.parts[p].weight * contact.watched(i).force /
                                            body.mesh->vertexAreas()[site.parts[p].node];
    }
    const Eigen::Matrix3Xd displacement = solveReferenceProblem(*body.greens, traction);
    for (int v = 0; v < n; ++v) {
      if (body.greens->isFixed(v)) continue;
      const Eigen::Vector3d place = body.mesh->points().col(v) + displacement.col(v);
      EXPECT_GE((place - pose.position).norm(), 0.4 - 1e-6) << v;
    }
  }
}

TEST(UnilateralContact, FrictionTakesEnergyOnEveryClosedPath) {
  const TouchedBody body = touchedSphere(3, true);
  for (double friction : {0.0, 0.3}) {
    UnilateralContact contact(body.greens, body.mesh, ball(0.3, friction), still(300));
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), before;
    double work = 0, largest = 0;
    constexpr int steps = 400;
    for (int tick = 0; tick <= steps; ++tick) {
      const double turn = 2 * kPi * tick / steps;
      const Eigen::Vector3d offset = 0.2 * Eigen::Vector3d(std::sin(turn), 1 - std::cos(turn), 0);
      const double depth = 0.03 * (1 - std::cos(turn)) / 2;
      const Eigen::Vector3d centre =
          (1.3 - depth) * (Eigen::Vector3d::UnitZ() + offset).normalized();
      const RigidPose pose = at(centre.x(), centre.y(), centre.z());
      contact.step(&pose);
      const Eigen::Vector3d now = contact.wrench(0).force;
      if (tick > 0) work -= (now + force).dot(centre - before) / 2;  // by the hand
      force = now;
      before = centre;
      largest = std::max(largest, now.norm());
    }
    EXPECT_LE(force.norm(), 1e-12);  // it ends as it began
    // Without friction the gaps' energy is the whole: what is left is the trapezium rule's.
    if (friction == 0) {
      EXPECT_NEAR(work, 0, 2e-3 * largest * 0.03);
    } else {
      EXPECT_GE(work, 0.1 * friction * largest * 0.03);
    }
  }
}

TEST(UnilateralContact, NoiseDoesNotMakeContactsChatter) {
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContactSettings settings;
  UnilateralContact contact(body.greens, body.mesh, ball(0.3, 0.3), settings);
  RigidPose pose = at(0, 0, 1.28);
  for (int tick = 0; tick < 5; ++tick) contact.step(&pose);  // it falls in at once, and settles
  const long before = contact.transitions();
  unsigned state = 1;
  double largestJump = 0;
  Eigen::Vector3d last = contact.wrench(0).force;
  for (int tick = 0; tick < 200; ++tick) {
    state = state * 1664525u + 1013904223u;
    pose.position.z() = 1.28 + 1e-4 * ((state >> 8) / 16777216.0 - 0.5);  // 1e-4 of the radius
    EXPECT_FALSE(contact.step(&pose).budgetCut);
    largestJump = std::max(largestJump, (contact.wrench(0).force - last).norm());
    last = contact.wrench(0).force;
  }
  EXPECT_EQ(contact.transitions(), before);
  EXPECT_LE(largestJump, 10 * 1e-4);  // stiffness of the contact (about 2) times the noise, at most
}

TEST(UnilateralContact, ForceIsContinuousWhileVerticesComeAndGo) {
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContact contact(body.greens, body.mesh, ball(0.3, 0.2), {});
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  double largestChange = 0;
  constexpr double step = 1e-3;
  for (int tick = 0; tick < 1500; ++tick) {
    const double angle = step * tick / 1.28;
    const RigidPose pose = at(1.28 * std::sin(angle), 0, 1.28 * std::cos(angle));
    EXPECT_FALSE(contact.step(&pose).failed);
    const Eigen::Vector3d force = contact.wrench(0).force;
    if (tick > 0) largestChange = std::max(largestChange, (force - last).norm());
    last = force;
  }
  EXPECT_GT(contact.transitions(), 40);
  EXPECT_GT(last.norm(), 1e-3);
  // At most what the stiffest motion, straight in with all vertices under the ball, would change.
  EXPECT_LE(largestChange, step * 4 * kModulus * 0.3);
}

TEST(UnilateralContact, ABoxOfTrianglesPressesAsThePlaneOfItsFace) {
  const TouchedBody body = touchedSphere(3, true);
  const auto tool = box({2, 2, 2}, {3, 3, 3}).moved({-1, -1, 0}).mesh();
  UnilateralContact byMesh(body.greens, body.mesh, {{std::make_shared<MeshShape>(tool), 0.3}},
                           still(300));
  UnilateralContact byPlane(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), 0.3}},
                            still(300));
  for (double height : {0.99, 0.95, 0.92}) {
    const RigidPose meshPose = at(0.01, 0, height), planePose = plate(height, 0.01);
    EXPECT_LE(byMesh.step(&meshPose).residual, 1e-9);
    EXPECT_LE(byPlane.step(&planePose).residual, 1e-9);
    const Wrench a = byMesh.wrench(0), b = byPlane.wrench(0);
    EXPECT_LE((a.force - b.force).norm(), 1e-8 * b.force.norm());
    EXPECT_LE((a.torque - b.torque).norm(), 1e-8 * b.force.norm());
  }
}

TEST(UnilateralContact, ACapsuleWithoutLengthIsABall) {
  const TouchedBody body = touchedSphere(2, true);
  UnilateralContact byBall(body.greens, body.mesh, ball(0.3), still(100));
  const Eigen::Vector3d centre(0.1, 0.2, -0.1);
  UnilateralContact byCapsule(body.greens, body.mesh,
                              {{std::make_shared<CapsuleShape>(centre, centre, 0.3), 0}},
                              still(100));
  const RigidPose one = at(0, 0, 1.2), other = at(-0.1, -0.2, 1.3);
  byBall.step(&one);
  byCapsule.step(&other);
  // Distances differ by rounding, which the solver's tolerance of 1e-9 lets through.
  EXPECT_LE((byBall.wrench(0).force - byCapsule.wrench(0).force).norm(), 1e-9);
  const Eigen::Vector3d force = byBall.wrench(0).force;
  EXPECT_LE((byCapsule.wrench(0).torque - byBall.wrench(0).torque - centre.cross(force)).norm(),
            1e-9);
}

/// Of balls that meet vertices alone: parts have fewer points inside triangles.
TEST(UnilateralContact, OverlappingPartsOfOneToolAreOneTool) {
  const TouchedBody body = touchedSphere(3, true);
  std::vector<Obstacle> parts = ball(0.8, 0.4);
  parts.push_back(parts[0]);
  for (Obstacle& part : parts) part.tool = 0;
  UnilateralContact one(body.greens, body.mesh, ball(0.8, 0.4), {});
  UnilateralContact both(body.greens, body.mesh, parts, {});
  for (int tick = 0; tick < 60; ++tick) {
    const RigidPose pose = at(0.005 * tick, 0, 1.78);
    // The second part sinks in deeper from the middle of the way on, and takes the vertices over.
    const double lower = std::max(0.0, 1e-3 * (tick - 30));
    const RigidPose poses[2] = {pose, at(0.005 * tick, 0, 1.79 - lower)};
    one.step(&pose);
    EXPECT_LE(both.step(poses).residual, 1e-9);
    std::vector<int> seen(body.mesh->vertexCount(), 0);
    for (int i = 0; i < both.watchedCount(); ++i)
      if (const int vertex = both.watched(i).vertex; vertex >= 0) {
        EXPECT_EQ(seen[vertex]++, 0);
      }
    const double difference = (both.wrench(0).force - one.wrench(0).force).norm();
    EXPECT_TRUE(tick >= 30 || difference <= 1e-6) << tick << ": " << difference;
  }
  EXPECT_GT(both.wrench(1).force.norm(), 2 * both.wrench(0).force.norm());
}

TEST(UnilateralContact, TwoToolsFeelEachOtherThroughTheBody) {
  const TouchedBody body = touchedSphere(3, true);
  std::vector<Obstacle> both = ball(0.3);
  both.push_back(both[0]);
  UnilateralContact contact(body.greens, body.mesh, both, still(300));
  const double apart = 0.7;
  RigidPose poses[2] = {at(1.28 * std::sin(apart), 0, 1.28 * std::cos(apart)), at(9, 9, 9)};
  contact.step(poses);
  const double alone = contact.wrench(0).force.norm();
  EXPECT_EQ(contact.wrench(1).force.norm(), 0);
  poses[1] = at(-1.28 * std::sin(apart), 0, 1.28 * std::cos(apart));
  contact.step(poses);
  EXPECT_GT(contact.wrench(1).force.norm(), 0);
  // Pressed from the other side the body yields towards the first.
  EXPECT_GT(contact.wrench(0).force.norm(), 1.01 * alone);
}

TEST(UnilateralContact, AVeryStiffElasticObstacleIsARigidOne) {
  // Triangles without a needle's angle, that neither is touched inside them.
  const Shape even = icosphere(3);
  const TouchedBody body =
      touchedBody(even, fixedWhere(even, [](const auto& x) { return x.z() < -0.6; }), true);
  const auto shape = std::make_shared<MeshShape>(body.mesh);
  UnilateralContact rigid(body.greens, body.mesh, {{shape, 0.3}}, still(300));
  UnilateralContact stiff(body.greens, body.mesh,
                          {{shape, 0.3, body.greens->withYoungsModulus(2.5e7), body.mesh}},
                          still(300));
  for (double depth : {0.01, 0.03}) {
    RigidPose pose = at(depth, 0, 2 - depth);
    pose.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(3, Eigen::Vector3d(1, 0.2, 0).normalized()));
    EXPECT_LE(rigid.step(&pose).residual, 1e-9);
    EXPECT_LE(stiff.step(&pose).residual, 1e-9);
    EXPECT_LE((rigid.wrench(0).force - stiff.wrench(0).force).norm(),
              1e-4 * rigid.wrench(0).force.norm());
  }
}

TEST(UnilateralContact, LetsGoWithoutAForceLeft) {
  const TouchedBody body = touchedSphere(2, true);
  UnilateralContact contact(body.greens, body.mesh, ball(0.3, 0.5), {});
  RigidPose pose = at(0, 0, 1.2);
  contact.step(&pose);
  EXPECT_GT(contact.wrench(0).force.z(), 0);
  pose = at(0, 0, 1.31);
  EXPECT_EQ(contact.step(&pose).contactCount, 0);
  EXPECT_EQ(contact.wrench(0).force.norm(), 0);
  pose = at(0, 0, 5);
  for (int tick = 0; tick < 2; ++tick) contact.step(&pose);
  EXPECT_EQ(contact.watchedCount(), 0);
}

TEST(UnilateralContact, ChangesAtRunTimeNeedNoComputation) {
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContact contact(body.greens, body.mesh, ball(0.3, 0.2), still(200));
  RigidPose pose = at(0, 0, 1.28);
  contact.step(&pose);
  const Eigen::Vector3d before = contact.wrench(0).force;
  contact.setStiffnessScale(3);
  EXPECT_LE((contact.wrench(0).force - 3 * before).norm(), 1e-14);
  contact.setStiffnessScale(1);
  contact.setFriction(0, 0);
  UnilateralContact smooth(body.greens, body.mesh, ball(0.3), still(200));
  for (int tick = 0; tick < 5; ++tick) {
    contact.step(&pose);
    smooth.step(&pose);
  }
  // Points inside triangles have settled to 1e-4 of their triangles.
  EXPECT_LE((contact.wrench(0).force - smooth.wrench(0).force).norm(), 3e-5 * before.norm());
  EXPECT_GT((smooth.wrench(0).force - before).norm(), 1e-4 * before.norm());
  EXPECT_THROW(contact.setFriction(0, -1), std::invalid_argument);
  EXPECT_THROW(contact.setStiffnessScale(0), std::invalid_argument);
}

TEST(UnilateralContact, FixedVerticesYieldByTheRigidStiffness) {
  const TouchedBody body = touchedSphere(2, true);  // fixed below -0.6
  UnilateralContactSettings settings = still(100);
  settings.rigidStiffness = 50;
  UnilateralContact contact(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), 0}},
                            settings);
  const RigidPose pose = at(0, 0, -0.95);
  contact.step(&pose);
  double force = 0;
  for (int v = 0; v < body.mesh->vertexCount(); ++v)
    force += 50 * std::max(0.0, -0.95 - body.mesh->points()(2, v));
  EXPECT_NEAR(contact.wrench(0).force.z(), -force, 1e-6 * force);
}

TEST(UnilateralContact, StepsDoNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContactSettings settings;
  settings.solver.largestUpdates = 12;
  std::vector<Obstacle> obstacles = ball(0.3, 0.3);
  obstacles.push_back({std::make_shared<MeshShape>(icosphere(1).scaled(0.3).mesh()), 0.3});
  obstacles.push_back({std::make_shared<MeshShape>(body.mesh), 0.3, body.greens, body.mesh});
  UnilateralContact contact(body.greens, body.mesh, obstacles, settings);
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  const long before = allocationCount();
  for (int tick = 0; tick < 60; ++tick) {
    const double angle = 0.01 * tick;
    RigidPose poses[3] = {at(1.28 * std::sin(angle), 0, 1.28 * std::cos(angle)),
                          at(0, -1.28 * std::cos(angle), 1.28 * std::sin(angle)),
                          at(-1.98 + 0.01 * angle, 0, 0)};
    poses[2].orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
    contact.step(poses);
    for (int k = 0; k < 3; ++k) largest[k] = std::max(largest[k], contact.wrench(k).force.norm());
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(largest.minCoeff(), 0);  // all three have touched
}

/// A ball comes down slowly and then goes aside. Points watched ahead of it count as room.
TEST(UnilateralContact, WhereThereIsNoRoomForAllTheForceIsSmallerAndHasNoJumps) {
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContactSettings few;
  few.capacity = 8;
  UnilateralContact truncated(body.greens, body.mesh, ball(1), few);
  UnilateralContact whole(body.greens, body.mesh, ball(1), {});
  double before = 0, beforeWhole = 0, change = 0, changeWhole = 0;
  int leftOut = 0;
  for (int tick = 0; tick < 500; ++tick) {
    const double aside = 1e-3 * std::max(0, tick - 250), depth = 8e-4 * std::min(tick, 250);
    const RigidPose pose = at((2 - depth) * std::sin(aside), 0, (2 - depth) * std::cos(aside));
    const ContactCertificate few = truncated.step(&pose), all = whole.step(&pose);
    EXPECT_FALSE(few.budgetCut || few.failed || all.truncated) << tick;
    EXPECT_LE(few.residual, 1e-9) << tick;
    EXPECT_EQ(few.truncated && all.contactCount < 6, false) << tick << ": there was room";
    EXPECT_TRUE(few.truncated || all.contactCount <= 9) << tick << ": they were left out";
    leftOut += few.truncated;
    const double force = truncated.force(0).norm(), forceWhole = whole.force(0).norm();
    if (!few.truncated && tick > 0) {
      EXPECT_NEAR(force, forceWhole, 1e-6) << tick;
    }
    change = std::max(change, std::abs(force - before));
    changeWhole = std::max(changeWhole, std::abs(forceWhole - beforeWhole));
    before = force;
    beforeWhole = forceWhole;
  }
  EXPECT_GT(leftOut, 200);
  EXPECT_GT(before, 0.5 * beforeWhole);
  EXPECT_LE(before, beforeWhole);
  EXPECT_LE(change, 3 * changeWhole);
}

/// Also where all come at once, in the order of their numbers.
TEST(UnilateralContact, WhereThereIsNoRoomForAllTheDeepestAreTaken) {
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContactSettings few;
  few.capacity = 12;
  UnilateralContact contact(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), 0}}, few);
  const RigidPose pose = plate(0.8);
  EXPECT_TRUE(contact.step(&pose).truncated);
  std::vector<double> heights(body.mesh->points().row(2).begin(), body.mesh->points().row(2).end());
  std::sort(heights.rbegin(), heights.rend());
  const double chatter = body.mesh->meanEdgeLength() / 16;
  for (int i = 0; i < contact.watchedCount(); ++i)
    EXPECT_GE(body.mesh->points()(2, contact.watched(i).vertex), heights[12] - chatter);
}

TEST(UnilateralContact, RoomIsChosenForAPlaneOverMostOfTheSurface) {
  const TouchedBody body = touchedSphere(3, true);
  UnilateralContactSettings enough;
  enough.solver = ContactSolverSettings::unhurried();
  UnilateralContact chosen(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), 0.3}}, enough);
  enough.capacity = body.mesh->vertexCount();
  UnilateralContact whole(body.greens, body.mesh, {{std::make_shared<PlaneShape>(), 0.3}}, enough);
  ContactCertificate last;
  for (int tick = 0; tick < 40; ++tick) {
    const RigidPose pose = plate(1 - 0.02 * tick);
    last = chosen.step(&pose);
    whole.step(&pose);
    EXPECT_FALSE(last.truncated || last.budgetCut || last.failed) << tick;
    EXPECT_LE((chosen.force(0) - whole.force(0)).norm(), 1e-9 * whole.force(0).norm()) << tick;
  }
  EXPECT_GT(chosen.watchedCount(), 128);
  EXPECT_LE(chosen.capacity(), UnilateralContactSettings::kMostChosen);
  EXPECT_EQ(UnilateralContactSettings().capacityFor(42), UnilateralContactSettings::kLeastChosen);
}

TEST(UnilateralContact, FailsWhereTheSurfaceIsPressedWithoutGreensFunctions) {
  const Shape shape = jitteredSphere(2, 0.2);
  const auto mesh = shape.mesh();
  const ElasticModel model(
      mesh, Material(2.5, 0.3),
      BoundaryConditions(fixedWhere(shape, [](const auto& x) { return x.z() < -0.6; })),
      Eigen::VectorXi::Zero(mesh->triangleCount()));
  BoundaryElementOptions options;
  for (int v = 0; v < mesh->vertexCount(); ++v)
    if (mesh->points()(2, v) > 0.7) options.columns.push_back(v);
  UnilateralContact contact(computeGreens(model, options), mesh, ball(0.5), {});
  RigidPose pose = at(0, 0, 1.45);
  EXPECT_FALSE(contact.step(&pose).failed);
  EXPECT_GT(contact.force(0).norm(), 0);
  pose = at(1.4, 0, 0);
  const ContactCertificate beside = contact.step(&pose);
  EXPECT_TRUE(beside.failed);
  EXPECT_FALSE(beside.truncated || beside.budgetCut);
}

TEST(UnilateralContact, RefusesWhatHasNoSense) {
  const TouchedBody body = touchedSphere(2, true);
  const auto make = [&](std::vector<Obstacle> obstacles, UnilateralContactSettings settings = {}) {
    return UnilateralContact(body.greens, body.mesh, std::move(obstacles), settings);
  };
  EXPECT_THROW(make({}), std::invalid_argument);
  EXPECT_THROW(make({{nullptr, 0}}), std::invalid_argument);
  EXPECT_THROW(make(ball(0.3, -0.1)), std::invalid_argument);
  EXPECT_THROW(make(ball(0.3, NAN)), std::invalid_argument);
  EXPECT_THROW(make({{std::make_shared<SphereShape>(1), 0, body.greens, nullptr}}),
               std::invalid_argument);
  EXPECT_THROW(UnilateralContact(body.greens, icosphere(1).mesh(), ball(1)), std::invalid_argument);
  UnilateralContactSettings settings;
  settings.margin = -1;
  EXPECT_THROW(make(ball(1), settings), std::invalid_argument);
  settings = {};
  settings.capacity = -1;
  EXPECT_THROW(make(ball(1), settings), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
