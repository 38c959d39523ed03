// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/contact_zones.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "contact/capacitance_solver.h"
#include "support/contact_bodies.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

// Two ways through one well-conditioned capacitance matrix (condition below 1e3).
constexpr double kRounding = 1e-12;

class ContactZonesOfASphere : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    raw_ = new TouchedBody(touchedSphere(1, false));
    reciprocal_ = new TouchedBody(touchedSphere(1, true));
  }
  static void TearDownTestSuite() {
    delete raw_;
    delete reciprocal_;
  }

  /// The free nodes on one side, as far as `height` along x, with a centre off the body.
  static ContactZone zone(const TouchedBody& body, double side, double height = 0.6) {
    ContactZone out{{}, Eigen::Vector3d(1.1 * side, 0.2, -0.1)};
    for (int node : body.greens->info().conditions.freeNodes())
      if (side * body.mesh->points()(0, node) > height) out.nodes.push_back(node);
    return out;
  }
  static std::vector<int> nodesOf(const std::vector<ContactZone>& zones) {
    std::vector<int> nodes;
    for (const ContactZone& zone : zones)
      nodes.insert(nodes.end(), zone.nodes.begin(), zone.nodes.end());
    return nodes;
  }

  static TouchedBody *raw_, *reciprocal_;
  std::mt19937 random_{21};
};
TouchedBody* ContactZonesOfASphere::raw_ = nullptr;
TouchedBody* ContactZonesOfASphere::reciprocal_ = nullptr;

TEST_F(ContactZonesOfASphere, TractionsForceAndTorqueAreThoseOfTheFullSolution) {
  const std::vector<ContactZone> zones = {zone(*raw_, 1), zone(*raw_, -1)};
  const ContactZones contact(raw_->greens, *raw_->mesh, zones);
  const std::vector<int> nodes = nodesOf(zones);
  ASSERT_GE(zones[0].nodes.size(), 3u);
  CapacitanceSolver solver(raw_->greens, raw_->mesh);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Matrix3Xd moved = randomVectors(static_cast<int>(nodes.size()), random_);
    const BoundarySolution full = solver.solve(switchWholeNodes(nodes, moved));
    // p_S of eq. 26
    const Eigen::VectorXd tractions = contact.tractions(moved.reshaped());
    const Eigen::Matrix3Xd expected = full.traction(Eigen::all, nodes);
    EXPECT_LE((tractions - expected.reshaped()).norm(), kRounding * expected.norm());
    // f = K_S u_S of eq. 27, and the torque like it, zone by zone
    for (int z = 0; z < 2; ++z) {
      const Eigen::VectorXd wrench = contact.bufferStiffness(z) * moved.reshaped();
      const Wrench whole = wrenchOf(*raw_->greens, raw_->mesh->points(), zones[z].nodes,
                                    full.traction, zones[z].centre);
      EXPECT_LE((wrench.head<3>() - whole.force).norm(), kRounding * full.traction.norm());
      EXPECT_LE((wrench.tail<3>() - whole.torque).norm(), kRounding * full.traction.norm());
      EXPECT_GT(whole.force.norm(), 1e-3);
    }
  }
}

TEST_F(ContactZonesOfASphere, EachZoneFeelsRigidMotionsOfTheOther) {
  const std::vector<ContactZone> zones = {zone(*raw_, 1), zone(*raw_, -1)};
  const ContactZones contact(raw_->greens, *raw_->mesh, zones);
  ASSERT_EQ(contact.zoneCount(), 2);
  const Eigen::MatrixXd stiffness = contact.rigidStiffness();
  ASSERT_EQ(stiffness.rows(), 12);
  CapacitanceSolver solver(raw_->greens, raw_->mesh);
  for (int motion = 0; motion < 12; ++motion) {
    const int moving = motion / 6, kind = motion % 6;
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(kind % 3);
    const std::vector<int> nodes = nodesOf(zones);
    Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, nodes.size());
    const std::size_t first = moving == 0 ? 0 : zones[0].nodes.size();
    for (std::size_t i = 0; i < zones[moving].nodes.size(); ++i) {
      const Eigen::Vector3d arm =
          raw_->mesh->points().col(zones[moving].nodes[i]) - zones[moving].centre;
      moved.col(first + i) = kind < 3 ? axis : Eigen::Vector3d(axis.cross(arm));
    }
    const BoundarySolution full = solver.solve(switchWholeNodes(nodes, moved));
    for (int felt = 0; felt < 2; ++felt) {
      const Wrench wrench = wrenchOf(*raw_->greens, raw_->mesh->points(), zones[felt].nodes,
                                     full.traction, zones[felt].centre);
      const Eigen::VectorXd column = stiffness.block<6, 1>(6 * felt, motion);
      EXPECT_LE((column.head<3>() - wrench.force).norm(), kRounding * full.traction.norm());
      EXPECT_LE((column.tail<3>() - wrench.torque).norm(), kRounding * full.traction.norm());
    }
  }
  EXPECT_GT(stiffness.topRightCorner(6, 6).norm(), 0.01 * stiffness.norm()) << "they are coupled";
}

TEST_F(ContactZonesOfASphere, RigidStiffnessIsSymmetricPositiveDefiniteWhereReciprocal) {
  const ContactZones contact(reciprocal_->greens, *reciprocal_->mesh,
                             {zone(*reciprocal_, 1), zone(*reciprocal_, -1)});
  const Eigen::MatrixXd stiffness = contact.rigidStiffness();
  EXPECT_LE((stiffness - stiffness.transpose()).norm(), 1e-12 * stiffness.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues().minCoeff() /
                stiffness.norm(),
            1e-6)
      << "every motion of the two against each other takes work";
}

TEST_F(ContactZonesOfASphere, HoldingASecondZoneStiffensTheFirst) {
  const ContactZone one = zone(*reciprocal_, 1), other = zone(*reciprocal_, -1);
  const Eigen::MatrixXd alone =
      ContactZones(reciprocal_->greens, *reciprocal_->mesh, {one}).rigidStiffness();
  const Eigen::MatrixXd held = ContactZones(reciprocal_->greens, *reciprocal_->mesh, {one, other})
                                   .rigidStiffness()
                                   .topLeftCorner(6, 6);
  const Eigen::MatrixXd more = held - alone;
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((more + more.transpose()) / 2).eigenvalues();
  EXPECT_GE(eigenvalues.minCoeff(), -kRounding * held.norm());
  EXPECT_GT(eigenvalues.maxCoeff(), 1e-3 * held.norm());
  // If instead the other is left free, its zone carries nothing: the Schur complement of K.
  const Eigen::MatrixXd c =
      ContactZones(reciprocal_->greens, *reciprocal_->mesh, {one, other}).capacitance().matrix();
  const Eigen::Index size = 3 * one.nodes.size();
  EXPECT_LE((ContactZones(reciprocal_->greens, *reciprocal_->mesh, {one}).capacitance().matrix() -
             c.topLeftCorner(size, size))
                .norm(),
            1e-15 * c.norm());
}

TEST_F(ContactZonesOfASphere, WhatIsNoZoneIsRefused) {
  const int fixed = raw_->greens->info().conditions.fixedNodes().front();
  const std::vector<int> free = raw_->greens->info().conditions.freeNodes();
  const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const auto refuses = [&](const std::vector<ContactZone>& zones, const std::string& sentence) {
    return isRefused([&] { ContactZones(raw_->greens, *raw_->mesh, zones); }, sentence);
  };
  EXPECT_TRUE(refuses({{{free[0], fixed}, centre}},
                      "node " + std::to_string(fixed) + " of a contact zone is fixed"));
  EXPECT_TRUE(refuses({{{free[0], free[2]}, centre}, {{free[1], free[2]}, centre}},
                      "node " + std::to_string(free[2]) + " is in two contact zones"));
  EXPECT_TRUE(refuses({{{free[2], free[2]}, centre}},
                      "node " + std::to_string(free[2]) + " is named twice by a contact zone"));
  EXPECT_TRUE(refuses({{{42}, centre}}, "there is no node 42"));
  EXPECT_TRUE(isRefused(
      [&] {
        ContactZones(raw_->greens, *icosphere(0).mesh(), {{{free[0]}, centre}});
      },
      "the Green's functions have 42 nodes, the surface 12 vertices"));
  const ContactZones contact(raw_->greens, *raw_->mesh, {{{free[0]}, centre}});
  EXPECT_TRUE(isRefused([&] { contact.tractions(Eigen::VectorXd::Zero(5)); },
                        "there are 5 displacement components for 3"));
  for (int zone : {-1, 1})
    EXPECT_TRUE(isRefused([&] { contact.bufferStiffness(zone); },
                          "there is no contact zone " + std::to_string(zone)));
}

}  // namespace
}  // namespace palpate::test
