// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/contact_compliance.h"

#include <gtest/gtest.h>

#include <random>

#include "contact/inverse_updates.h"
#include "support/allocation_count.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

std::shared_ptr<const GreensFunctions> body(bool reciprocal, unsigned seed) {
  SyntheticBody made;
  made.fixed = {3, 7};
  made.reciprocal = reciprocal;
  made.seed = seed;
  return syntheticGreens(made);
}

/// A site at a node of the first body, and one that meets a triangle of the second.
std::vector<ContactSite> someSites() {
  std::vector<ContactSite> sites;
  for (int node : {0, 4, 3, 9}) sites.push_back(ContactSite::atNode(0, node));
  sites.push_back({4, {{{0, 5, 1}, {1, 2, -0.2}, {1, 3, -0.3}, {1, 8, -0.5}}}});
  sites.push_back({4, {{{0, 11, 1}, {1, 2, -0.6}, {1, 1, -0.4}, {1, 8, 0}}}});
  sites.push_back(ContactSite::atNode(1, 2));
  return sites;
}

/// Displacement of one site per force on another, straight from the Green's functions.
Eigen::Matrix3d between(const std::vector<std::shared_ptr<const GreensFunctions>>& bodies,
                        const ContactSite& row, const ContactSite& column) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int p = 0; p < row.count; ++p)
    for (int q = 0; q < column.count; ++q) {
      const ContactSite::Part &a = row.parts[p], &b = column.parts[q];
      if (a.body != b.body) continue;
      const GreensFunctions& greens = *bodies[a.body];
      if (greens.isFixed(a.node) || greens.isFixed(b.node)) continue;
      sum += a.weight * b.weight / greens.vertexArea(b.node) *
             denseMatrix(greens).block<3, 3>(3 * a.node, 3 * b.node);
    }
  return sum;
}

TEST(ContactCompliance, IsTheGreensFunctionsPerForceBetweenSites) {
  for (bool reciprocal : {false, true}) {
    const std::vector bodies{body(reciprocal, 1), body(reciprocal, 2)};
    ContactCompliance compliance(bodies, 1e9, 10);
    std::vector<ContactSite> sites = someSites();
    for (const ContactSite& site : sites) ASSERT_TRUE(compliance.add(site));
    compliance.remove(1);
    sites[1] = sites.back();
    sites.pop_back();
    ASSERT_EQ(compliance.count(), static_cast<int>(sites.size()));
    for (int i = 0; i < compliance.count(); ++i)
      for (int j = 0; j < compliance.count(); ++j)  // 1e-8: what a fixed node yields by
        EXPECT_LE((compliance.block(i, j) - between(bodies, sites[i], sites[j])).norm(), 1e-8)
            << i << " " << j;
  }
}

TEST(ContactCompliance, MultipliesAsItsBlocksDo) {
  ContactCompliance compliance({body(false, 1), body(false, 2)}, 10, 10);
  for (const ContactSite& site : someSites()) compliance.add(site);
  std::mt19937 random(1);
  const Eigen::Matrix3Xd forces = randomVectors(compliance.count(), random);
  Eigen::VectorXd product(compliance.stride()), summed(compliance.stride());
  compliance.multiply(forces.data(), product.data());
  summed.setZero();
  for (int j = 0; j < compliance.count(); ++j)
    compliance.addColumn(j, forces.col(j), summed.data());
  for (int i = 0; i < compliance.count(); ++i) {
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (int j = 0; j < compliance.count(); ++j) expected += compliance.block(i, j) * forces.col(j);
    EXPECT_LE((product.segment<3>(3 * i) - expected).norm(), 1e-14 * product.norm());
    EXPECT_LE((summed.segment<3>(3 * i) - expected).norm(), 1e-14 * product.norm());
  }
}

/// Of a product, each entry of the padded columns of contacts that bear a force, once.
TEST(ContactCompliance, CountsTheEntriesOfItsProducts) {
  ContactCompliance compliance({body(false, 1), body(false, 2)}, 10, 10);
  for (const ContactSite& site : someSites()) ASSERT_TRUE(compliance.add(site));
  const int n = compliance.count(), rows = padded(3 * n);
  Eigen::VectorXd forces = Eigen::VectorXd::Ones(3 * n), out(compliance.stride());
  forces.head<3>().setZero();  // open
  compliance.multiply(forces.data(), out.data());
  EXPECT_EQ(compliance.work().multiplications, 3. * (n - 1) * rows);
  EXPECT_EQ(compliance.work().bytes, 8 * 3. * (n - 1) * rows);
  compliance.addColumn(0, Eigen::Vector3d::Ones(), out.data());
  EXPECT_EQ(compliance.work().multiplications, 3. * n * rows);
}

TEST(ContactCompliance, AFixedNodeYieldsAloneByTheRigidStiffness) {
  ContactCompliance compliance({body(true, 1)}, 50, 4);
  ASSERT_TRUE(compliance.add(ContactSite::atNode(0, 3)));
  ASSERT_TRUE(compliance.add(ContactSite::atNode(0, 4)));
  EXPECT_EQ(compliance.block(0, 0), Eigen::Matrix3d::Identity() / 50);
  EXPECT_TRUE(compliance.block(0, 1).isZero(0));
  EXPECT_TRUE(compliance.block(1, 0).isZero(0));
}

/// Or a place beside the support would be the stiffer, the more contacts it bears.
TEST(ContactCompliance, ContactsShareTheYieldOfTheFixedNodesThatBearThem) {
  for (bool reciprocal : {false, true}) {
    ContactCompliance compliance({body(reciprocal, 1)}, 50, 4);
    ASSERT_TRUE(compliance.add(ContactSite::atNode(0, 3)));
    ASSERT_TRUE(compliance.add({2, {{{0, 3, 0.25}, {0, 7, 0.75}}}}));
    ASSERT_TRUE(compliance.add(ContactSite::atNode(0, 7)));
    const double shared[3][3] = {{1, 0.25, 0}, {0.25, 0.625, 0.75}, {0, 0.75, 1}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_LE((50 * compliance.block(i, j) - shared[i][j] * Eigen::Matrix3d::Identity()).norm(),
                  1e-14)
            << i << " " << j;
  }
}

TEST(ContactCompliance, RefusesWhatItHasNoRoomOrColumnFor) {
  SyntheticBody made;
  made.columns = {0, 1, 2};
  ContactCompliance compliance({syntheticGreens(made)}, 1, 2);
  EXPECT_FALSE(compliance.add(ContactSite::atNode(0, 5)));
  EXPECT_TRUE(compliance.add(ContactSite::atNode(0, 0)));
  EXPECT_TRUE(compliance.add(ContactSite::atNode(0, 1)));
  EXPECT_FALSE(compliance.add(ContactSite::atNode(0, 2)));
  EXPECT_EQ(compliance.count(), 2);
  EXPECT_THROW(ContactCompliance({}, 1, 2), std::invalid_argument);
  EXPECT_THROW(ContactCompliance({syntheticGreens(made)}, 0, 2), std::invalid_argument);
  EXPECT_THROW(ContactCompliance({syntheticGreens(made)}, 1, 0), std::invalid_argument);
}

TEST(ContactCompliance, EntersAndLeavesWithoutAllocating) {
  ASSERT_TRUE(allocationsAreCounted());
  ContactCompliance compliance({body(false, 1), body(false, 2)}, 10, 10);
  const std::vector<ContactSite> sites = someSites();
  const long before = allocationCount();
  for (const ContactSite& site : sites) compliance.add(site);
  while (compliance.count() > 0) compliance.remove(0);
  EXPECT_EQ(allocationCount(), before);
}

}  // namespace
}  // namespace palpate::test
