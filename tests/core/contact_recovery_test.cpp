// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/contact_recovery.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/subdivision.h"
#include "support/data_models.h"
#include "support/recoveries.h"

namespace palpate {
namespace {

using test::KnownContact;
using test::TouchedBody;

constexpr double kYoung = 2e4, kPoisson = 0.4;

const TouchedBody& coarseSphere() {
  static const TouchedBody body(test::makeModel(test::icosphere(2), test::cap, kYoung, kPoisson));
  return body;
}

const TouchedBody& fineSphere() {
  static const TouchedBody body(test::makeModel(test::icosphere(3), test::cap, kYoung, kPoisson));
  return body;
}

Eigen::Vector3d onSphere(double polar, double turn) {
  const double p = polar * M_PI / 180, t = turn * M_PI / 180;
  return {std::sin(p) * std::cos(t), std::sin(p) * std::sin(t), std::cos(p)};
}

/// A push that is tilted by some degrees from the normal of a unit sphere.
KnownContact pushOn(const Eigen::Vector3d& place, double size, double tilt, double radius) {
  const double angle = tilt * M_PI / 180;
  return {place, size * (-std::cos(angle) * place + std::sin(angle) * place.unitOrthogonal()),
          radius};
}

/// Of the contact nearest to a place.
const RecoveredContact& contactAt(const ContactRecovery& result, const Eigen::Vector3d& place) {
  return *std::min_element(result.contacts.begin(), result.contacts.end(),
                           [&](const RecoveredContact& a, const RecoveredContact& b) {
                             return (a.centre - place).norm() < (b.centre - place).norm();
                           });
}

struct Errors {
  double force, centre, peak;  ///< relative, and in edges
};

Errors errorsOf(const ContactRecovery& result, const SurfaceMesh& mesh,
                const KnownContact& contact) {
  const RecoveredContact& found = contactAt(result, contact.place);
  return {(found.force - contact.force).norm() / contact.force.norm(),
          (found.centre - contact.place).norm() / mesh.meanEdgeLength(),
          (mesh.points().col(found.peak) - contact.place).norm() / mesh.meanEdgeLength()};
}

TEST(ContactRecovery, ExactDisplacementsGiveTheForceThatCausedThem) {
  const TouchedBody& body = coarseSphere();
  ASSERT_FALSE(body.model.conditions().isFixed(17));
  const Eigen::Vector3d force = -2 * body.mesh().vertexNormals().col(17);
  Eigen::Matrix3Xd traction = Eigen::Matrix3Xd::Zero(3, body.mesh().vertexCount());
  traction.col(17) = force / body.mesh().vertexAreas()[17];
  Eigen::Matrix3Xd u = solveReferenceProblem(*body.greens, traction);
  for (int node : body.model.conditions().fixedNodes()) u.col(node).setZero();
  const ContactRecovery result =
      test::recoverOn(body, test::observedOn(body, u, body.mesh(), 60, 0, 1));
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_EQ(result.contacts[0].peak, 17);
  // What the fit's ridge and tolerance leave.
  EXPECT_LT((result.force - force).norm(), 1e-4 * force.norm());
  EXPECT_LT((result.traction - traction).norm(), 1e-3 * traction.norm());
  EXPECT_LT((result.displacement - u).norm(), 1e-4 * u.norm());
  EXPECT_LT(result.residuals.cwiseAbs().maxCoeff(), 1e-4 * u.cwiseAbs().maxCoeff());
}

TEST(ContactRecovery, TractionsPushWithinFrictionAndSumUpToTheForces) {
  const TouchedBody& body = coarseSphere();
  const std::vector<KnownContact> contacts{pushOn(onSphere(40, 20), 1, 10, 0.4),
                                           pushOn(onSphere(70, 200), 0.7, 0, 0.4)};
  const auto observed =
      test::observedOn(body, displacementUnder(body, contacts), body.mesh(), 100, 0.01, 3);
  for (double friction : {0.0, 0.5}) {
    RecoveryOptions options;
    options.friction = friction;
    options.radius = 0;  // single nodes: each is in the cone itself
    const ContactRecovery result = test::recoverOn(body, observed, options);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), ofContacts = sum;
    for (int node = 0; node < body.mesh().vertexCount(); ++node) {
      const Eigen::Vector3d traction = result.traction.col(node),
                            normal = body.mesh().vertexNormals().col(node);
      sum += body.mesh().vertexAreas()[node] * traction;
      const double pressure = -traction.dot(normal);
      EXPECT_GE(pressure, 0) << node;
      EXPECT_LE((traction + pressure * normal).norm(), friction * pressure + 1e-9) << node;
      EXPECT_NEAR(result.pressure[node], pressure, 1e-9 * result.pressure.maxCoeff());
    }
    for (const RecoveredContact& contact : result.contacts) ofContacts += contact.force;
    EXPECT_LT((sum - result.force).norm(), 1e-12 * result.force.norm());
    EXPECT_LT((ofContacts - result.force).norm(), 1e-12 * result.force.norm());
  }
}

/// Several places, directions and sets of noise on one body.
void expectRecovered(const TouchedBody& truth, const TouchedBody& body,
                     const std::vector<std::vector<KnownContact>>& cases, int markers, double noise,
                     const RecoveryOptions& options, double mostForce, double meanForce) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto observed = test::observedOn(truth, displacementUnder(truth, cases[i]), body.mesh(),
                                           markers, noise, static_cast<unsigned>(i) + 1);
    const ContactRecovery result = test::recoverOn(body, observed, options);
    EXPECT_EQ(result.contacts.size(), cases[i].size()) << "case " << i;
    for (const KnownContact& contact : cases[i]) {
      const Errors errors = errorsOf(result, body.mesh(), contact);
      EXPECT_LE(errors.peak, 1) << "case " << i;
      EXPECT_LE(errors.centre, 0.5) << "case " << i;
      EXPECT_LE(errors.force, mostForce) << "case " << i;
      sum += errors.force;
      ++count;
    }
  }
  EXPECT_LE(sum / count, meanForce);
}

std::vector<std::vector<KnownContact>> pushesAllOver(int count, double radius, double tilt) {
  std::vector<std::vector<KnownContact>> cases;
  for (int i = 0; i < count; ++i)
    cases.push_back({pushOn(onSphere(15 + 80.0 * i / count, 137.5 * i), 1.5, tilt, radius)});
  return cases;
}

std::vector<std::vector<KnownContact>> pairsAllOver(int count, double radius, double tilt) {
  std::vector<std::vector<KnownContact>> cases;
  for (int i = 0; i < count; ++i)
    cases.push_back({pushOn(onSphere(20 + 60.0 * i / count, 137.5 * i), 1.5, tilt, radius),
                     pushOn(onSphere(60 + 20.0 * i / count, 137.5 * i + 170), 1, tilt, radius)});
  return cases;
}

TEST(ContactRecovery, ForceAndPlaceOfAContactAtOnePercentNoise) {
  RecoveryOptions options;
  options.samples = 0;
  expectRecovered(fineSphere(), fineSphere(), pushesAllOver(8, 0.3, 15), 100, 0.01, options, 0.05,
                  0.03);
}

TEST(ContactRecovery, TwoContactsAtOnePercentNoise) {
  RecoveryOptions options;
  options.samples = 0;
  expectRecovered(fineSphere(), fineSphere(), pairsAllOver(6, 0.3, 15), 150, 0.01, options, 0.05,
                  0.03);
}

TEST(ContactRecovery, ContactsOfABodyThatAFinerMeshIsOf) {
  RecoveryOptions options;
  options.samples = 0;
  expectRecovered(fineSphere(), coarseSphere(), pushesAllOver(8, 0.4, 15), 150, 0.01, options, 0.1,
                  0.05);
}

TEST(ContactRecovery, DeviationsAreThoseOfRepetitions) {
  const KnownContact contact = pushOn(onSphere(50, 30), 1.5, 15, 0.4);
  const Eigen::Matrix3Xd u = displacementUnder(coarseSphere(), {contact});
  constexpr int sets = 20;
  double ofForce = 0, ofPlace = 0, noise = 0;
  for (unsigned seed = 1; seed <= sets; ++seed) {
    const auto observed =
        test::observedOn(coarseSphere(), u, coarseSphere().mesh(), 100, 0.01, seed);
    const ContactRecovery result = test::recoverOn(coarseSphere(), observed);
    ASSERT_EQ(result.contacts.size(), 1u);
    const RecoveredContact& found = result.contacts[0];
    ofForce += (found.force - contact.force).squaredNorm() / found.forceDeviation.squaredNorm();
    ofPlace += (found.centre - contact.place).squaredNorm() / std::pow(found.centreDeviation, 2);
    noise += result.noise / (0.01 * observed.displacements.cwiseAbs().maxCoeff());
  }
  // Of three and of two numbers; places stay off by what the patches' shape lacks.
  EXPECT_GT(std::sqrt(ofForce / sets), 0.5);
  EXPECT_LT(std::sqrt(ofForce / sets), 2);
  EXPECT_GT(std::sqrt(ofPlace / sets), 0.3);
  EXPECT_LT(std::sqrt(ofPlace / sets), 4);
  EXPECT_NEAR(noise / sets, 1, 0.1);
}

/// The kidney's control mesh, refined so many times.
TouchedBody kidney(int levels) {
  const test::DataModel data = test::readDataModel("kidney");
  auto mesh = data.shape.mesh();
  Eigen::VectorXi patches = Eigen::VectorXi::Zero(mesh->triangleCount());
  std::vector<unsigned char> types = data.boundaryTypes;
  for (int level = 0; level < levels; ++level) {
    const SubdivisionLevel finer = subdivide(*mesh, patches, Subdivision::Curved);
    types = refineBoundaryTypes(finer, types);
    patches = refineSmoothPatches(finer, patches);
    mesh = std::make_shared<SurfaceMesh>(finer.points, finer.triangles);
  }
  return TouchedBody(
      {mesh, Material(data.youngsModulus, data.poissonRatio), BoundaryConditions(types), patches});
}

TEST(ContactRecovery, ContactsOfAKidney) {
  const TouchedBody body = kidney(2);
  const SurfaceMesh& mesh = body.mesh();
  RecoveryOptions options;
  options.samples = 0;
  const auto isNearSupport = [&](const Eigen::Vector3d& place) {
    for (int node : body.model.conditions().fixedNodes())
      if ((mesh.points().col(node) - place).norm() < 3 * mesh.meanEdgeLength()) return true;
    return false;
  };
  std::vector<std::vector<KnownContact>> cases;
  for (const SurfacePoint& place : test::markersOn(body, 30, 11))
    if (!isNearSupport(placeOf(mesh, place)))  // where little moves, little is told
      cases.push_back({{placeOf(mesh, place), -0.3 * mesh.triangleNormals().col(place.triangle),
                        2 * mesh.meanEdgeLength()}});
  ASSERT_GE(cases.size(), 5u);
  expectRecovered(body, body, cases, 100, 0.01, options, 0.05, 0.03);
}

}  // namespace
}  // namespace palpate
