// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Displacements that do not tell by what contacts they are caused, or tell it wrongly.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "stability/hard_case.h"
#include "support/recoveries.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"identification", name, danger};
}

/// A sphere of 162 vertices held below.
const TouchedBody& sphere() {
  static const TouchedBody body(makeModel(icosphere(2), cap, 2e4, 0.4));
  return body;
}

KnownContact push() {
  const Eigen::Vector3d place = Eigen::Vector3d(0.5, 0.3, 0.7).normalized();
  return {place, -1.5 * place, 0.4};
}

ObservedDisplacements observed(int markers, double noise) {
  return observedOn(sphere(), displacementUnder(sphere(), {push()}), sphere().mesh(), markers,
                    noise, 1);
}

double errorOf(const ContactRecovery& result) {
  return (result.force - push().force).norm() / push().force.norm();
}

TEST(HardRecovery, TooFew) {
  const ObservedDisplacements few = observed(2, 0.01);
  hard("contacts from two displacements", "five unknowns and more from six numbers")
      .expectRefused([&] { recoverOn(sphere(), few); }, "not recovered from 6 components");
  const ContactRecovery result = recoverOn(sphere(), observed(5, 0.01));
  const HardCase here =
      hard("contacts from five displacements, 1 % noise", "guesses told as known");
  here.expectSaid(result.warnings.empty() ? "" : result.warnings.front(),
                  "too few to tell their noise");
  double deviation = 0;
  for (const RecoveredContact& contact : result.contacts)
    deviation = std::max(deviation, contact.forceDeviation.norm());
  here.expectAtLeast("standard deviation of the force, of it", deviation / result.force.norm(),
                     0.02);
}

TEST(HardRecovery, AllAtOnePlace) {
  ObservedDisplacements here = observed(50, 0.01);
  for (std::size_t i = 0; i < here.points.size(); ++i) {
    here.points[i].triangle = here.points[0].triangle;
    here.points[i].barycentric = {0.3 + 1e-4 * double(i), 0.3, 0.4 - 1e-4 * double(i)};
  }
  hard("contacts from 50 displacements at one place", "repetition taken for information")
      .expectRefused([&] { recoverOn(sphere(), here); }, "of one place, less than an edge");
}

TEST(HardRecovery, NothingMoves) {
  ObservedDisplacements still = observed(50, 0);
  still.displacements.setZero();
  hard("contacts from displacements that are all zero", "forces of rounding")
      .expectRefused([&] { recoverOn(sphere(), still); }, "nothing moved");
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, 1e-4);
  for (double& value : still.displacements.reshaped()) value = normal(random);
  still.deviations.setConstant(3, still.displacements.cols(), 1e-4);
  hard("contacts from noise alone", "contacts that explain noise")
      .expectRefused([&] { recoverOn(sphere(), still); },
                     "no contact explains the displacements better than their noise");
}

TEST(HardRecovery, NotFinite) {
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ObservedDisplacements broken = observed(50, 0.01);
    broken.displacements.col(7).setConstant(bad);
    hard("contacts from displacements one of which is " + std::string(bad != bad ? "NaN" : "∞"),
         "NaN everywhere")
        .expectRefused([&] { recoverOn(sphere(), broken); }, "of point 7 is not finite");
  }
  ObservedDisplacements gaps = observed(100, 0.01);
  for (Eigen::Index i = 0; i < gaps.displacements.cols(); ++i)
    gaps.displacements(i % 3, i) = std::numeric_limits<double>::quiet_NaN();
  hard("contacts where a component of each displacement was not seen", "gaps taken for zeros")
      .expectAtMost("error of the force", errorOf(recoverOn(sphere(), gaps)), 0.05);
}

TEST(HardRecovery, WrongUnits) {
  for (double unit : {1e3, 1e-8}) {
    ObservedDisplacements scaled = observed(50, 0.01);
    const double size = scaled.displacements.cwiseAbs().maxCoeff() / sphere().mesh().diagonal();
    scaled.displacements *= 1e-2 / size * unit;
    hard("contacts from displacements " +
             std::string(unit > 1 ? "a thousand times too large" : "of 1e-10 of the body"),
         "forces of another world")
        .expectRefused([&] { recoverOn(sphere(), scaled); }, "check the unit of length");
  }
}

TEST(HardRecovery, SupportThatYields) {
  ObservedDisplacements seen = observed(100, 0.01);
  const double most = seen.displacements.cwiseAbs().maxCoeff();
  double largest = 0;
  Eigen::Matrix3Xd rocking(3, seen.displacements.cols());
  for (Eigen::Index i = 0; i < rocking.cols(); ++i) {
    const Eigen::Vector3d x = placeOf(sphere().mesh(), seen.points[i]);
    rocking.col(i) = (push().place + Eigen::Vector3d(0, 0, 0.9))
                         .cross(push().force)
                         .cross(x + Eigen::Vector3d(0, 0, 0.9));
    largest = std::max(largest, rocking.col(i).cwiseAbs().maxCoeff());
  }
  seen.displacements += 0.3 * most / largest * rocking;
  const HardCase here = hard("contacts on a clamp that rocks: 30 % of the displacements",
                             "forces by displacements that the clamp makes");
  const ContactRecovery result = recoverOn(sphere(), seen);
  here.expectAtMost("error of the force", errorOf(result), 0.08);
  here.expectSaid(result.warnings.empty() ? "" : result.warnings.front(),
                  "the support gives way by other than the model's");
}

TEST(HardRecovery, ContactBetweenSharpEdges) {
  const TouchedBody cube(makeModel(
      box({1, 1, 1}, {6, 6, 6}), [](const Eigen::Vector3d& x) { return x.z() < 1e-6; }, 2e4, 0.4));
  const KnownContact contact{{0.9, 0.55, 1}, {0, 0, -2}, 0.2};
  const auto seen = observedOn(cube, displacementUnder(cube, {contact}), cube.mesh(), 100, 0.01, 3);
  const ContactRecovery result = recoverOn(cube, seen);
  const HardCase here = hard("a contact beside a cube's sharp edge, 1 % noise",
                             "normals of an edge, along which nothing may push");
  here.expectAtMost("error of the force", (result.force - contact.force).norm() / 2, 0.05);
  here.expectAtMost(
      "error of the place, edges",
      (result.contacts[0].centre - contact.place).norm() / cube.mesh().meanEdgeLength(), 0.5);
}

}  // namespace
}  // namespace palpate::test
