// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// That the solver's displacements are those of its forces whatever has changed since it computed
// them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <limits>

#include "contact/frictional_contact_solver.h"
#include "support/contact_bodies.h"

namespace palpate::test {
namespace {

constexpr int kContacts = 6;

/// Contacts round the equator of a sphere, pressed inwards and to a side.
FrictionalContactSolver pressedSphere(const TouchedBody& body) {
  FrictionalContactSolver solver({body.greens}, 100, 2 * kContacts);
  for (int node = 0; solver.count() < kContacts; ++node) {
    if (body.greens->isFixed(node)) continue;
    EXPECT_TRUE(solver.add(ContactSite::atNode(0, node)));
    const Eigen::Vector3d inwards = -body.mesh->vertexNormals().col(node);
    solver.conditions(solver.count() - 1) = {
        inwards, -0.01 * inwards + 0.004 * inwards.unitOrthogonal(), 0.3, false};
  }
  return solver;
}

/// The largest difference between the displacements and the compliance times the forces, over the
/// largest displacement.
double error(const FrictionalContactSolver& solver) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(3 * solver.count()), kept = product;
  for (int i = 0; i < solver.count(); ++i) {
    kept.segment<3>(3 * i) = solver.displacement(i);
    for (int j = 0; j < solver.count(); ++j)
      product.segment<3>(3 * i) += solver.compliance().block(i, j) * solver.force(j);
  }
  return (kept - product).lpNorm<Eigen::Infinity>() / product.lpNorm<Eigen::Infinity>();
}

TEST(ContactDisplacements, AreThoseOfTheForcesAfterEveryChange) {
  const TouchedBody body = touchedSphere(2, true);
  const ContactSite fixedSite = [&] {
    int node = 0;
    while (!body.greens->isFixed(node)) ++node;
    return ContactSite::atNode(0, node);
  }();
  const int last = body.mesh->vertexCount() - 1;
  using Solver = FrictionalContactSolver;
  const std::pair<const char*, std::function<void(Solver&)>> changes[] = {
      {"none", [](Solver&) {}},
      {"a force",
       [](Solver& solver) {
         solver.setForce(1, {0.1, 0.2, -0.1});
       }},
      {"a contact enters", [&](Solver& solver) { solver.add(ContactSite::atNode(0, last)); }},
      {"a loaded contact leaves", [](Solver& solver) { solver.remove(0); }},
      {"an open contact enters and leaves",
       [&](Solver& solver) {
         solver.add(ContactSite::atNode(0, last));
         solver.updateDisplacements();
         solver.remove(solver.count() - 1);
       }},
      {"a contact moves", [&](Solver& solver) { solver.move(2, ContactSite::atNode(0, last)); }},
      {"the body turns",
       [](Solver& solver) {
         solver.turn(0, Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()).toRotationMatrix());
       }},
      {"the support yields",
       [&](Solver& solver) {
         solver.add(fixedSite);
         solver.setForce(solver.count() - 1, {0, 0, 0.5});
         solver.updateDisplacements();
         solver.setRigidStiffness(10);
       }},
      {"another solve", [](Solver& solver) { solver.solve(); }}};
  // Sums of up to 21 products.
  constexpr double rounding = 50 * std::numeric_limits<double>::epsilon();
  for (const auto& [name, change] : changes) {
    FrictionalContactSolver solver = pressedSphere(body);
    EXPECT_LE(solver.solve().residual, 1e-9);
    EXPECT_GT(solver.force(0).norm(), 0);
    EXPECT_LE(error(solver), rounding) << name;
    change(solver);
    solver.updateDisplacements();
    EXPECT_LE(error(solver), rounding) << name;
  }
}

}  // namespace
}  // namespace palpate::test
