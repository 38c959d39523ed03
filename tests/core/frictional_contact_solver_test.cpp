// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/frictional_contact_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <optional>
#include <random>

#include "contact/capacitance_matrix.h"
#include "contact/inverse_updates.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

/// A patch of neighbouring nodes of a sphere: compliances that couple strongly.
struct Patch {
  TouchedBody body;
  std::vector<int> nodes;  ///< by distance from the north pole
};

const Patch& patch() {
  static const Patch patch = [] {
    Patch made{touchedSphere(2, true), {}};
    const SurfaceMesh& mesh = *made.body.mesh;
    for (int i = 0; i < mesh.vertexCount(); ++i)
      if (!made.body.greens->isFixed(i)) made.nodes.push_back(i);
    std::sort(made.nodes.begin(), made.nodes.end(),
              [&](int a, int b) { return mesh.points()(2, a) > mesh.points()(2, b); });
    return made;
  }();
  return patch;
}

/// Contacts at the first nodes of the patch, pressed inwards with random gaps and slips.
FrictionalContactSolver pressedPatch(int count, double friction, unsigned seed,
                                     ContactSolverSettings settings = {}) {
  FrictionalContactSolver solver({patch().body.greens}, 100, count + 8, settings);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < count; ++i) {
    const int node = patch().nodes[i];
    EXPECT_TRUE(solver.add(ContactSite::atNode(0, node)));
    const Eigen::Vector3d inwards = -patch().body.mesh->vertexNormals().col(node);
    const Eigen::Vector3d normal = (inwards + 0.3 * randomDirection(random)).normalized();
    solver.conditions(i) = {normal,
                            0.01 * (unit(random) - 0.5) * normal + 0.01 * randomDirection(random),
                            friction, false};
  }
  return solver;
}

Eigen::MatrixXd denseCompliance(const FrictionalContactSolver& solver) {
  const int size = 3 * solver.count();
  Eigen::MatrixXd w(size, size);
  for (int k = 0; k < size; ++k)
    w.col(k) = Eigen::Map<const Eigen::VectorXd>(solver.compliance().column(k), size);
  return w;
}

/// The conditions themselves, not their projection form: largest violation, in units of the largest
/// displacement or force.
double violation(FrictionalContactSolver& solver) {
  const int count = solver.count();
  const Eigen::MatrixXd w = denseCompliance(solver);
  Eigen::VectorXd f(3 * count);
  for (int i = 0; i < count; ++i) f.segment<3>(3 * i) = solver.force(i);
  const Eigen::VectorXd u = w * f;
  const double largestForce = std::max(f.cwiseAbs().maxCoeff(), 1e-3);
  const double largestMove = std::max(u.cwiseAbs().maxCoeff(), 1e-3);
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const ContactConditions& c = solver.conditions(i);
    const Eigen::Vector3d v = u.segment<3>(3 * i) + c.offset;
    const double gap = c.normal.dot(v) / largestMove;
    const double pressure = c.normal.dot(solver.force(i)) / largestForce;
    const Eigen::Vector3d slip = (v - c.normal.dot(v) * c.normal) / largestMove;
    const Eigen::Vector3d shear =
        (solver.force(i) - c.normal.dot(solver.force(i)) * c.normal) / largestForce;
    worst = std::max(
        {worst, -gap, -pressure, std::min(gap, pressure), shear.norm() - c.friction * pressure});
    if (pressure > 1e-12 && slip.norm() > 1e-7)  // slipping: on the cone, against the slip
      worst = std::max(worst, (shear + c.friction * pressure * slip.normalized()).norm());
  }
  return worst;
}

TEST(FrictionalContactSolver, FrictionlessForcesAreThoseOfTheOneActiveSetThatFits) {
  constexpr int count = 8;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    FrictionalContactSolver solver = pressedPatch(count, 0, seed);
    const ContactCertificate certificate = solver.solve();
    EXPECT_LE(certificate.residual, 1e-9);
    EXPECT_FALSE(certificate.budgetCut);
    const Eigen::MatrixXd w = denseCompliance(solver);
    int fits = 0;
    for (int set = 0; set < 1 << count; ++set) {
      std::vector<int> active;
      for (int i = 0; i < count; ++i)
        if (set >> i & 1) active.push_back(i);
      const int size = static_cast<int>(active.size());
      Eigen::MatrixXd normal(size, size);
      Eigen::VectorXd gap(size);
      for (int a = 0; a < size; ++a) {
        const ContactConditions& ca = solver.conditions(active[a]);
        gap[a] = ca.normal.dot(ca.offset);
        for (int b = 0; b < size; ++b)
          normal(a, b) = ca.normal.dot(w.block<3, 3>(3 * active[a], 3 * active[b]) *
                                       solver.conditions(active[b]).normal);
      }
      const Eigen::VectorXd pressures = normal.lu().solve(-gap);
      if (size > 0 && pressures.minCoeff() < 0) continue;
      Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * count);
      for (int a = 0; a < size; ++a)
        f.segment<3>(3 * active[a]) = pressures[a] * solver.conditions(active[a]).normal;
      const Eigen::VectorXd u = w * f;
      bool fit = true;
      for (int i = 0; i < count && fit; ++i) {
        const ContactConditions& c = solver.conditions(i);
        fit = (set >> i & 1) || c.normal.dot(u.segment<3>(3 * i) + c.offset) >= 0;
      }
      if (!fit) continue;
      ++fits;
      for (int i = 0; i < count; ++i)  // 1e-9 residual times the condition of W
        EXPECT_LE((solver.force(i) - f.segment<3>(3 * i)).norm(), 1e-7 * f.norm()) << seed;
    }
    EXPECT_EQ(fits, 1);
  }
}

TEST(FrictionalContactSolver, ForcesSatisfySignoriniAndCoulomb) {
  for (double friction : {0.0, 0.2, 0.6, 1.0})
    for (unsigned seed = 1; seed <= 30; ++seed)
      for (int count : {1, 2, 5, 13, 40}) {
        FrictionalContactSolver solver = pressedPatch(count, friction, seed);
        const ContactCertificate certificate = solver.solve();
        SCOPED_TRACE(testing::Message() << "mu " << friction << " seed " << seed << " s " << count
                                        << " iterations " << certificate.iterations);
        EXPECT_LE(certificate.residual, 1e-9);
        EXPECT_LE(violation(solver), 1e-7);  // residual times the condition of W
      }
}

/// Forces of contacts whose statuses are given, slip directions found by damped repetition; empty
/// if they do not settle or break a condition.
std::optional<Eigen::VectorXd> forcesOf(FrictionalContactSolver& solver, const Eigen::MatrixXd& w,
                                        const std::vector<ContactStatus>& statuses) {
  const int count = solver.count();
  std::vector<Eigen::Vector3d> against(count, Eigen::Vector3d::Zero());
  Eigen::VectorXd f;
  for (int round = 0; round < 2000; ++round) {
    Eigen::MatrixXd system = Eigen::MatrixXd::Identity(3 * count, 3 * count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * count);
    for (int i = 0; i < count; ++i) {
      const ContactConditions& c = solver.conditions(i);
      if (statuses[i] == ContactStatus::Open) continue;
      Eigen::Matrix3d rows = Eigen::Matrix3d::Identity(), tied = Eigen::Matrix3d::Zero();
      if (statuses[i] == ContactStatus::Slip) {
        rows = c.normal * c.normal.transpose();
        tied = Eigen::Matrix3d::Identity() - rows - c.friction * against[i] * c.normal.transpose();
      }
      system.middleRows<3>(3 * i) = rows * w.middleRows<3>(3 * i);
      system.block<3, 3>(3 * i, 3 * i) += tied;
      right.segment<3>(3 * i) = -rows * c.offset;
    }
    const Eigen::VectorXd next = system.lu().solve(right);
    const double change = f.size() ? (next - f).norm() / next.norm() : 1;
    f = next;
    const Eigen::VectorXd u = w * f;
    for (int i = 0; i < count; ++i) {
      const ContactConditions& c = solver.conditions(i);
      const Eigen::Vector3d v = u.segment<3>(3 * i) + c.offset;
      const Eigen::Vector3d slip = v - c.normal.dot(v) * c.normal;
      against[i] = (0.8 * against[i] - 0.2 * slip.normalized()).normalized();
    }
    if (change < 1e-13) break;
  }
  const Eigen::VectorXd u = w * f;
  for (int i = 0; i < count; ++i) {
    const ContactConditions& c = solver.conditions(i);
    const Eigen::Vector3d v = u.segment<3>(3 * i) + c.offset, force = f.segment<3>(3 * i);
    const double pressure = c.normal.dot(force);
    const Eigen::Vector3d slip = v - c.normal.dot(v) * c.normal;
    if (statuses[i] == ContactStatus::Open ? c.normal.dot(v) < 0 : pressure < 0) return {};
    const double shear = (force - pressure * c.normal).norm();
    if (statuses[i] == ContactStatus::Stick && shear > c.friction * pressure) return {};
    if (statuses[i] == ContactStatus::Slip &&
        (force - pressure * c.normal + c.friction * pressure * slip.normalized()).norm() >
            1e-9 * f.norm())
      return {};
  }
  return f;
}

TEST(FrictionalContactSolver, ForcesAreThoseOfTheOneCombinationOfStatusesThatFits) {
  constexpr int count = 3, combinations = 27;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    FrictionalContactSolver solver = pressedPatch(count, 0.4, seed);
    EXPECT_LE(solver.solve().residual, 1e-9);
    const Eigen::MatrixXd w = denseCompliance(solver);
    int fits = 0;
    for (int code = 0; code < combinations; ++code) {
      std::vector<ContactStatus> statuses;
      for (int i = 0, rest = code; i < count; ++i, rest /= 3)
        statuses.push_back(static_cast<ContactStatus>(rest % 3));
      const auto forces = forcesOf(solver, w, statuses);
      if (!forces) continue;
      ++fits;
      for (int i = 0; i < count; ++i) {
        EXPECT_EQ(solver.status(i), statuses[i]) << "seed " << seed << " contact " << i;
        EXPECT_LE((solver.force(i) - forces->segment<3>(3 * i)).norm(), 1e-7 * forces->norm());
      }
    }
    EXPECT_EQ(fits, 1) << seed;
  }
}

/// Of all contacts held, which are one linear problem: a solve from rest makes the inverse by an
/// update a contact, whose s^3 / 3 blocks are most of its work, and ends with the compliance and
/// the inverse applied once or twice.
TEST(FrictionalContactSolver, CountsTheWorkOfASolve) {
  double before = 0;
  for (const int count : {6, 12, 24}) {
    ContactSolverSettings settings;
    settings.largestUpdates = 1000;
    FrictionalContactSolver solver = pressedPatch(count, 0, 1, settings);
    for (int i = 0; i < count; ++i) solver.conditions(i).bilateral = true;
    const double entered = solver.work().multiplications;
    ASSERT_FALSE(solver.solve().budgetCut);
    ASSERT_EQ(solver.inverse().updates(), count);
    const double spent = solver.work().multiplications - entered;
    // multiplyBothSides and addOuterProduct: nine products an entry of the inverse so far, padded.
    double updates = 0;
    for (int slot = 0; slot < count; ++slot) updates += 9. * 3 * slot * padded(3 * slot);
    EXPECT_GT(spent, updates);
    EXPECT_LT(spent, updates + 8. * 3 * count * padded(3 * count) + 400. * count * count) << count;
    EXPECT_GT(spent, 3 * before);
    before = spent;
  }
}

TEST(FrictionalContactSolver, HeldContactsBearTheTractionsOfTheCapacitanceMatrix) {
  FrictionalContactSolver solver = pressedPatch(12, 0, 1);
  std::vector<int> nodes(patch().nodes.begin(), patch().nodes.begin() + 12);
  Eigen::VectorXd wanted(36);
  for (int i = 0; i < 12; ++i) {
    solver.conditions(i).bilateral = true;
    wanted.segment<3>(3 * i) = -solver.conditions(i).offset;
  }
  EXPECT_LE(solver.solve().residual, 1e-9);
  const CapacitanceMatrix matrix(patch().body.greens, switchesOfNodes(nodes));
  Eigen::VectorXd tractions(36);
  matrix.solve(wanted.data(), tractions.data());
  for (int i = 0; i < 12; ++i)
    EXPECT_LE(
        (solver.force(i) / patch().body.greens->vertexArea(nodes[i]) - tractions.segment<3>(3 * i))
            .norm(),
        1e-7 * tractions.norm());
}

TEST(FrictionalContactSolver, EveryContactTwiceGivesTheSameForces) {
  for (double friction : {0.0, 0.5})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      FrictionalContactSolver once = pressedPatch(10, friction, seed, {1e-11, 200, 0});
      FrictionalContactSolver twice({patch().body.greens}, 100, 20, {1e-11, 200, 0});
      for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(twice.add(once.compliance().site(i % 10)));
        twice.conditions(i) = once.conditions(i % 10);
      }
      EXPECT_LE(once.solve().residual, 1e-11);
      const ContactCertificate certificate = twice.solve();
      EXPECT_LE(certificate.residual, 1e-11) << certificate.iterations;
      double largest = 0;
      for (int i = 0; i < 10; ++i) largest = std::max(largest, once.force(i).norm());
      for (int i = 0; i < 10; ++i)
        EXPECT_LE((twice.force(i) + twice.force(i + 10) - once.force(i)).norm(), 1e-8 * largest);
    }
}

TEST(FrictionalContactSolver, ContactsThatCameAndWentLeaveNoTrace) {
  std::mt19937 random(5);
  FrictionalContactSolver walked = pressedPatch(20, 0.3, 1);
  for (int step = 0; step < 300; ++step) {
    if (walked.count() > 10 && random() % 2) {
      walked.remove(random() % walked.count());
    } else if (walked.count() < 24) {
      const int node = patch().nodes[random() % patch().nodes.size()];
      bool present = false;
      for (int i = 0; i < walked.count(); ++i)
        present = present || walked.compliance().site(i).parts[0].node == node;
      if (present || !walked.add(ContactSite::atNode(0, node))) continue;
      const Eigen::Vector3d normal = -patch().body.mesh->vertexNormals().col(node);
      walked.conditions(walked.count() - 1) = {normal, 0.01 * randomDirection(random), 0.3, false};
    }
    ASSERT_LE(walked.solve().residual, 1e-9) << step;
  }
  FrictionalContactSolver fresh({patch().body.greens}, 100, 28);
  for (int i = 0; i < walked.count(); ++i) {
    ASSERT_TRUE(fresh.add(walked.compliance().site(i)));
    fresh.conditions(i) = walked.conditions(i);
  }
  EXPECT_LE(relativeDifference(denseCompliance(walked), denseCompliance(fresh)), 1e-14);
  EXPECT_LE(fresh.solve().residual, 1e-9);
  for (int i = 0; i < walked.count(); ++i)
    EXPECT_LE((walked.force(i) - fresh.force(i)).norm(), 1e-7 * fresh.force(0).norm() + 1e-9);
}

TEST(FrictionalContactSolver, ABudgetIsKeptReportedAndCaughtUpWith) {
  FrictionalContactSolver solver = pressedPatch(40, 0.5, 3, {1e-9, 5, 6});
  const ContactCertificate first = solver.solve();
  EXPECT_TRUE(first.budgetCut);
  EXPECT_EQ(first.iterations, 5);
  EXPECT_LE(solver.inverse().updates(), 6);
  EXPECT_GT(first.residual, 1e-9);
  int ticks = 1;
  while (solver.solve().budgetCut) ASSERT_LT(++ticks, 100);
  EXPECT_LE(violation(solver), 1e-7);
}

/// Flops of one solve.
double workOf(FrictionalContactSolver& solver, ContactCertificate& certificate) {
  const double before = solver.work().multiplications;
  certificate = solver.solve();
  return 2 * (solver.work().multiplications - before);
}

/// Counted, not timed: the same solve ends at the same place on any machine. Beyond the limit there
/// is one iteration with one update, and the last evaluation.
TEST(FrictionalContactSolver, WorkIsBoundedReportedAndCaughtUpWith) {
  constexpr int count = 60;
  constexpr double pass = 18. * count * count, update = 162. * count * count;
  FrictionalContactSolver whole = pressedPatch(count, 0.5, 3);
  ContactCertificate certificate;
  const double needed = workOf(whole, certificate);
  EXPECT_FALSE(certificate.budgetCut);
  for (const double limit : {1., 1e6, 3e6}) {
    ASSERT_GT(needed, limit + update);
    ContactSolverSettings settings;
    settings.largestWork = limit;
    FrictionalContactSolver solver = pressedPatch(count, 0.5, 3, settings),
                            same = pressedPatch(count, 0.5, 3, settings);
    EXPECT_LE(workOf(solver, certificate), limit + update + 8 * pass);
    EXPECT_TRUE(certificate.budgetCut);
    EXPECT_GT(certificate.residual, 1e-9);
    EXPECT_EQ(same.solve().residual, certificate.residual);
    int ticks = 1;
    for (bool isCut = true; isCut; ++ticks) {
      ASSERT_LT(ticks, 1000) << limit;
      EXPECT_LE(workOf(solver, certificate), limit + update + 8 * pass);
      isCut = certificate.budgetCut;
    }
    EXPECT_LE(violation(solver), 1e-7);
  }
}

TEST(FrictionalContactSolver, ForcesServedUnderABudgetLieInTheirCones) {
  FrictionalContactSolver solver = pressedPatch(40, 0.3, 4, {1e-9, 1, 2});
  for (int tick = 0; tick < 5; ++tick) {
    solver.solve();
    for (int i = 0; i < solver.count(); ++i) {
      const Eigen::Vector3d n = solver.conditions(i).normal;
      const double pressure = n.dot(solver.force(i));
      EXPECT_GE(pressure, 0);
      EXPECT_LE((solver.force(i) - pressure * n).norm(), 0.3 * pressure * (1 + 1e-12));
    }
  }
}

TEST(FrictionalContactSolver, NothingAllocatesAfterTheConstructor) {
  ASSERT_TRUE(allocationsAreCounted());
  FrictionalContactSolver solver = pressedPatch(30, 0.3, 2, {1e-9, 100, 20});
  const Eigen::Vector3d normal = -patch().body.mesh->vertexNormals().col(patch().nodes[35]);
  solver.solve();
  const long before = allocationCount();
  for (int tick = 0; tick < 20; ++tick) {
    solver.add(ContactSite::atNode(0, patch().nodes[30 + tick % 5]));
    solver.conditions(30) = {normal, -0.01 * normal, 0.3, false};
    solver.solve();
    solver.remove(tick % 30);
    solver.solve();
    solver.add(ContactSite::atNode(0, patch().nodes[tick % 30]));
    solver.remove(30 - 1);
  }
  EXPECT_EQ(allocationCount(), before);
}

TEST(FrictionalContactSolver, RefusesSettingsWithoutSense) {
  const auto greens = patch().body.greens;
  EXPECT_THROW(FrictionalContactSolver({greens}, 100, 4, {0, 10, 0}), std::invalid_argument);
  EXPECT_THROW(FrictionalContactSolver({greens}, 100, 4, {1e-9, 0, 0}), std::invalid_argument);
  EXPECT_THROW(FrictionalContactSolver({greens}, 100, 4, {1e-9, 10, -1}), std::invalid_argument);
  EXPECT_THROW(FrictionalContactSolver({greens}, 100, 4, {1e-9, 10, 0, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
