// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/torque_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "contact/point_contact.h"
#include "support/contact_bodies.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

class TorqueMaskOnASphere : public testing::Test {
 protected:
  static void SetUpTestSuite() { body_ = new TouchedBody(touchedSphere(2, true)); }
  static void TearDownTestSuite() { delete body_; }
  static const BoundaryConditions& conditions() { return body_->greens->info().conditions; }
  static TorqueMask maskAt(int vertex, MaskShape shape = MaskShape::Linear) {
    return torqueMask(*body_->mesh,
                      PressureMasks(*body_->mesh, conditions(), shape, 0.6).at(vertex));
  }
  static TouchedBody* body_;
};
TouchedBody* TorqueMaskOnASphere::body_ = nullptr;

TEST_F(TorqueMaskOnASphere, TransmitsTheTorqueAboutAnyPointAndNoForce) {
  const Eigen::Vector3d torque(0.3, -2, 1), elsewhere(5, 6, -7);
  for (int v : conditions().freeNodes()) {
    const TorqueMask mask = maskAt(v);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), about = force;
    for (std::size_t j = 0; j < mask.nodes.size(); ++j) {
      const int node = mask.nodes[j];
      const Eigen::Vector3d f =
          body_->mesh->vertexAreas()[node] * mask.tensor(static_cast<int>(j)) * torque;
      force += f;
      about += (body_->mesh->points().col(node) - elsewhere).cross(f);
    }
    EXPECT_LE(force.norm(), 1e-13 * torque.norm() / 0.6);
    EXPECT_LE((about - torque).norm(), 1e-12 * torque.norm());
  }
}

TEST_F(TorqueMaskOnASphere, SeesOfARigidMotionItsRotationAlone) {
  const Eigen::Vector3d turn(0.1, 0.4, -0.2), shift(3, 2, 1);
  for (int v : conditions().freeNodes()) {
    const TorqueMask mask = maskAt(v, MaskShape::Hertzian);
    Eigen::Matrix3Xd moved(3, mask.nodes.size());
    for (std::size_t j = 0; j < mask.nodes.size(); ++j)
      moved.col(j) = shift + turn.cross(Eigen::Vector3d(body_->mesh->points().col(mask.nodes[j])));
    EXPECT_LE((mask.meanRotation(moved) - turn).norm(), 1e-12);
  }
}

TEST_F(TorqueMaskOnASphere, HasAComplianceThatIsSymmetricPositiveDefiniteOneEnergy) {
  for (int v : conditions().freeNodes()) {
    const Matrix6d c = wrenchCompliance(*body_->greens, maskAt(v));
    // Entries of different units: each is held to the two on the diagonal.
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        EXPECT_LE(std::abs(c(i, j) - c(j, i)), 1e-12 * std::sqrt(c(i, i) * c(j, j)));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(c).eigenvalues()[0], 0);
    const Eigen::Matrix3d k = rotationalStiffness(*body_->greens, maskAt(v));
    EXPECT_LE((k * c.bottomRightCorner<3, 3>() - Eigen::Matrix3d::Identity()).norm(), 1e-10);
  }
}

TEST_F(TorqueMaskOnASphere, ATorqueAtAPointTurnsItsSurroundingsByTheCompliance) {
  const auto stiffness =
      std::make_shared<SurfaceStiffness>(body_->greens, body_->mesh, MaskShape::Linear, 0.6);
  const Eigen::Vector3d torque(0.02, 0.01, -0.03), force(1, -2, 3);
  for (int f = 0; f < body_->mesh->triangleCount(); f += 17) {
    const Eigen::Vector3i corners = body_->mesh->triangles().col(f);
    if (body_->greens->isFixed(corners[0])) continue;
    const PointContact contact(stiffness, {f, Eigen::Vector3d::UnitX()});
    Eigen::Matrix3Xd moved, traction, moved2, traction2;
    const Eigen::Vector3d turned = contact.deform(force, torque, moved, traction);
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << force, torque;
    const Matrix6d c = wrenchCompliance(*body_->greens, maskAt(corners[0]));
    EXPECT_LE((turned - (c * wrench).tail<3>()).norm(), 1e-12 * turned.norm());
    // Without a torque it is the push that it was.
    contact.deform(force, moved, traction);
    contact.deform(force, Eigen::Vector3d::Zero(), moved2, traction2);
    EXPECT_EQ(moved, moved2);
    EXPECT_EQ(traction, traction2);
  }
}

TEST_F(TorqueMaskOnASphere, OfASurfaceHoldsWhereThereIsAMaskWideEnough) {
  const SurfaceStiffness masked(body_->greens, body_->mesh, MaskShape::Linear, 0.6);
  const SurfaceStiffness single(body_->greens, body_->mesh, MaskShape::Linear, 0);
  const auto wide = rotationalStiffnesses(masked), narrow = rotationalStiffnesses(single);
  for (int v = 0; v < body_->mesh->vertexCount(); ++v) {
    EXPECT_EQ(wide[v].hasNaN(), conditions().isFixed(v));
    EXPECT_TRUE(narrow[v].hasNaN());
  }
  EXPECT_THROW(rotationalStiffnesses(masked, [](double, const char*) { return false; }), Aborted);
  EXPECT_TRUE(isRefused([&] { torqueMask(*body_->mesh, single.mask(0)); },
                        "a torque needs a pressure mask of three nodes or more"));
}

/// The exact mean rotation of a spherical cavity of radius 1 in infinite space per torque under a
/// linear mask of a chord radius, around the mask's axis, for G = 1. The tractions, t(a) at a polar
/// angle, are the sum of t_l dP_l/da, l >= 1; such a mode moves the surface by 1 / (l + 2) of
/// itself (u falls like r^-(l + 1), t = -G (du/dr - u/r)), the first as a whole: T = 8 pi G.
double exactTwist(double chord) {
  constexpr int kModes = 80, kSteps = 4000;
  const double rim = 2 * std::asin(chord / 2);
  double torque = 0, projection[kModes + 1] = {};
  for (int i = 0; i < kSteps; ++i) {
    const double a = rim * (i + 0.5) / kSteps, area = 2 * kPi * std::sin(a) * rim / kSteps;
    const double traction = (1 - 2 * std::sin(a / 2) / chord) * std::sin(a);
    torque += traction * std::sin(a) * area;
    double before = 1, legendre = std::cos(a);
    for (int l = 1; l <= kModes; ++l) {
      const double slope = l * (std::cos(a) * legendre - before) / std::sin(a);
      projection[l] += traction * slope * area;
      const double next = ((2 * l + 1) * std::cos(a) * legendre - l * before) / (l + 1);
      before = legendre;
      legendre = next;
    }
  }
  double work = 0;
  for (int l = 1; l <= kModes; ++l)
    work += projection[l] * projection[l] * (2 * l + 1) / (4 * kPi * l * (l + 1)) / (l + 2);
  return work / (torque * torque);
}

TEST(TorqueMask, TwistsASphericalCavityByItsTorsionalModes) {
  constexpr double kChord = 0.9;
  double errors[2];
  int vertices[2];
  for (int level : {2, 3}) {
    const Shape shape = icosphere(level);
    const ElasticModel model = makeModel(
        shape, [](const auto&) { return false; }, 2.6, 0.3, 180, Domain::Exterior);
    const VertexMask mask =
        PressureMasks(model.mesh(), model.conditions(), MaskShape::Linear, kChord).at(0);
    const auto greens = computeGreens(model, {});
    const double twist = wrenchCompliance(*greens, torqueMask(model.mesh(), mask))(5, 5);
    errors[level - 2] = std::abs(twist / exactTwist(kChord) - 1);
    vertices[level - 2] = model.mesh().vertexCount();
    RecordProperty("error" + std::to_string(level), std::to_string(errors[level - 2]));
  }
  EXPECT_LT(errors[1], 0.01);  // edges of a sixth of the mask's radius
  EXPECT_GT(convergenceOrder(errors[0], vertices[0], errors[1], vertices[1]), 1.5);
  // The whole sphere turns as one under tractions like sin a: much stiffer.
  EXPECT_GT(exactTwist(kChord), 2 / (8 * kPi));
}

}  // namespace
}  // namespace palpate::test
