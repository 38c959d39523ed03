// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/sliding_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "contact/point_contact.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"
#include "support/watched_contact.h"

namespace palpate::test {
namespace {

constexpr double kStep = 1e-3;
// What a tick leaves of an excess over the cone to the next one, over |f|.
constexpr double kSettled = 1e-6;

class SlidingContactOnAPlate : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Shape shape = box({1, 1, 0.5}, {6, 6, 3});
    body_ = new TouchedBody(
        touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() == 0; }), true));
    stiffness_ = maskedStiffness(*body_, 2);
  }
  static void TearDownTestSuite() {
    stiffness_.reset();
    delete body_;
  }
  /// Pressed from above into the top, whose inner triangles have one normal.
  static WatchedContact pressed(double friction, double depth = 0.05) {
    WatchedContact contact(stiffness_, friction);
    contact.advance({0.45, 0.5, 0.6});
    contact.moveTo({0.45, 0.5, 0.5 - depth}, kStep);
    EXPECT_TRUE(contact.contact.isTouching());
    EXPECT_LE((contact.contact.normal() - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
    return contact;
  }
  static TouchedBody* body_;
  static std::shared_ptr<const SurfaceStiffness> stiffness_;
};
TouchedBody* SlidingContactOnAPlate::body_ = nullptr;
std::shared_ptr<const SurfaceStiffness> SlidingContactOnAPlate::stiffness_;

TEST_F(SlidingContactOnAPlate, SlidesUnderAmontonsForce) {
  for (double mu : {0.0, 0.1, 0.3, 0.6}) {
    WatchedContact drag = pressed(mu);
    const Eigen::Vector3d start = drag.contact.staticPoint();
    int sliding = 0;
    drag.moveTo({0.65, 0.55, 0.45}, kStep, [&] {
      EXPECT_FALSE(drag.contact.wasHeldBack());
      if (!drag.contact.isSliding()) return;
      ++sliding;
      EXPECT_NEAR(drag.across(), mu * drag.pressing(), kSettled * drag.contact.force().norm());
      EXPECT_GE(drag.contact.force().dot(drag.contact.staticPoint() - start),
                -kSettled * drag.contact.force().norm())
          << "it is dragged the way it goes";
    });
    EXPECT_GT(sliding, 100);
  }
}

TEST_F(SlidingContactOnAPlate, SticksUntilTheForcesTangentExceedsMu) {
  for (double mu : {0.2, 0.5, 1.0}) {
    WatchedContact drag = pressed(mu);
    const Eigen::Vector3d start = drag.contact.staticPoint();
    bool hasSlipped = false;
    int stuck = 0;
    const Eigen::Vector3d away = drag.place() + Eigen::Vector3d(-0.15, 0.1, 0);
    drag.moveTo(away, 1e-4, [&] {
      if (hasSlipped) return;
      hasSlipped = drag.contact.isSliding();
      if (!hasSlipped) {
        ++stuck;
        EXPECT_LE(drag.across(), mu * drag.pressing() * (1 + 1e-8));
        EXPECT_EQ(drag.contact.staticPoint(), start);
        return;
      }
      // The first slip brings back what one step of 1e-4 at most goes beyond the cone.
      EXPECT_NEAR(drag.across(), mu * drag.pressing(), kSettled * drag.contact.force().norm());
      EXPECT_LE((drag.contact.staticPoint() - start).norm(), 2e-4);
    });
    EXPECT_TRUE(hasSlipped);
    EXPECT_GT(stuck, 10);
  }
}

TEST_F(SlidingContactOnAPlate, AContactThatSticksGivesBackAllItsWork) {
  WatchedContact push = pressed(10);
  const Eigen::Vector3d start = push.contact.staticPoint(), home = push.place();
  push.work = 0;
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(0.03, 0, 0), Eigen::Vector3d(0.02, 0.03, -0.04),
                                    Eigen::Vector3d(-0.03, 0.01, 0.02), Eigen::Vector3d(0, 0, 0)})
    push.moveTo(home + by, kStep);
  EXPECT_EQ(push.contact.staticPoint(), start);
  EXPECT_LE(std::abs(push.work), 1e-14);  // of forces and ways below one
}

TEST_F(SlidingContactOnAPlate, PullsWhileItAdheresAndFadesWhenItDoesNot) {
  WatchedContact pull = pressed(0.3);
  const Eigen::Vector3d start = pull.contact.staticPoint();
  pull.contact.setAdhesion(true);
  pull.moveTo({0.5, 0.47, 0.55}, kStep, [&] {
    EXPECT_EQ(pull.contact.staticPoint(), start);
    const Eigen::Vector3d expected = pull.contact.servedStiffness() * (pull.place() - start);
    EXPECT_LE((pull.contact.force() - expected).norm(), 1e-15);
  });
  EXPECT_LT(pull.pressing(), -0.01) << "the body is drawn out";
  pull.contact.setAdhesion(false);
  // At rest the force goes by the relaxation's share a tick, in no more than |f| over it.
  const double share = SlidingContact::kContinuity * pull.contact.relaxation() *
                       pull.contact.servedStiffness().operatorNorm();
  const int most = 10 + int(pull.contact.force().norm() / share);
  double before = pull.contact.force().norm();
  for (int tick = 0; tick < most && before > 0; ++tick) {
    pull.advance(pull.place());
    EXPECT_FALSE(pull.contact.isTouching());
    EXPECT_LT(pull.contact.force().norm(), before);
    before = pull.contact.force().norm();
  }
  EXPECT_EQ(before, 0);
}

TEST_F(SlidingContactOnAPlate, APushThatStopsAdheringSlidesHomeIntoTheCone) {
  WatchedContact push = pressed(0.3);
  push.contact.setAdhesion(true);
  push.moveTo(push.place() + Eigen::Vector3d(0.15, 0, 0), kStep);
  EXPECT_GT(push.across(), push.pressing());
  push.contact.setAdhesion(false);
  for (int tick = 0; tick < 2000; ++tick) push.advance(push.place());
  EXPECT_TRUE(push.contact.isTouching());
  EXPECT_LE(push.across(), 0.3 * push.pressing() + kSettled * push.contact.force().norm());
}

TEST_F(SlidingContactOnAPlate, ShowsTheThreePointsOfFigure8) {
  WatchedContact push = pressed(0.5);
  push.moveTo({0.47, 0.52, 0.44}, kStep);
  const PointContact image(stiffness_, push.contact.point());
  const ContactResponse points = image.push(push.contact.force());
  EXPECT_LE((points.staticPoint - push.contact.staticPoint()).norm(), 1e-15);
  EXPECT_LE((points.hapticPoint - push.place()).norm(), 1e-13);
  EXPECT_LE((points.hapticDisplacement - (push.place() - push.contact.staticPoint())).norm(),
            1e-13);
  // No stiffness is limited here: x^E is x^H but for what interpolating K means between vertices as
  // far apart as two thirds of the masks' radius.
  EXPECT_LE((points.elasticPoint - push.place()).norm(), 0.15 * points.hapticDisplacement.norm());
}

TEST_F(SlidingContactOnAPlate, FrictionMayChangeAtAnyTime) {
  WatchedContact drag = pressed(1);
  drag.moveTo({0.48, 0.5, 0.45}, kStep);
  EXPECT_FALSE(drag.contact.isSliding());
  const Eigen::Vector3d before = drag.contact.force();
  drag.contact.setFriction(0.1);
  drag.advance(drag.place());
  EXPECT_TRUE(drag.contact.wasHeldBack());
  EXPECT_LE(drag.jump, 0.05 * before.norm());
  for (int tick = 0; tick < 1000; ++tick) drag.advance(drag.place());
  // The last slip may end a little within the cone, as stiffness varies on its way.
  EXPECT_LE(drag.across(), 0.1 * drag.pressing() + kSettled * before.norm());
  EXPECT_GE(drag.across(), 0.1 * drag.pressing() * (1 - 1e-3));
}

TEST_F(SlidingContactOnAPlate, AChangeOfStiffnessIsSpreadOverItsTicks) {
  const double radius = 3 * body_->mesh->meanEdgeLength();
  for (const auto& other :
       {stiffness_->withYoungsModulus(10 * 2.5), stiffness_->withRigidStiffness(1),
        std::shared_ptr<const SurfaceStiffness>(std::make_shared<SurfaceStiffness>(
            body_->greens, body_->mesh, MaskShape::Hertzian, radius))}) {
    WatchedContact push = pressed(0.5);
    const SurfacePoint at = push.contact.point();
    const Eigen::Vector3d u = push.place() - push.contact.staticPoint();
    const Eigen::Matrix3d change = other->hapticAt(at.triangle, at.barycentric) -
                                   stiffness_->hapticAt(at.triangle, at.barycentric);
    const Eigen::Vector3d before = push.contact.force();
    push.contact.setStiffness(other);
    EXPECT_EQ(push.contact.force(), before);
    for (int tick = 1; tick <= SlidingContact::kBlendTicks; ++tick) {
      EXPECT_TRUE(push.contact.isChanging());
      push.advance(push.place());
      // A hundredth a tick, but for what x^C slips when stiffness couples differently.
      const double share = (change * u).norm() / SlidingContact::kBlendTicks;
      const double settling = SlidingContact::kContinuity * push.contact.relaxation() *
                              push.contact.servedStiffness().operatorNorm();
      EXPECT_LE(push.jump, share * (1 + 1e-9) + settling);
    }
    EXPECT_FALSE(push.contact.isChanging());
    EXPECT_LE((push.contact.force() -
               other->hapticAt(push.contact.point().triangle, push.contact.point().barycentric) *
                   (push.place() - push.contact.staticPoint()))
                  .norm(),
              1e-12 * push.contact.force().norm());
  }
}

TEST_F(SlidingContactOnAPlate, AFastProbeIsNotLost) {
  WatchedContact probe(stiffness_, 0);
  probe.advance({0.45, 0.5, 0.7});
  probe.advance({0.45, 0.5, -0.1});  // through the whole body in one tick
  EXPECT_TRUE(probe.contact.isTouching());
  EXPECT_NEAR(probe.contact.staticPoint().z(), 0.5, 1e-12);
  EXPECT_GT(probe.pressing(), 0);
}

TEST_F(SlidingContactOnAPlate, AProbeThatBeginsInsideTouchesTheNearestPlaceByAndBy) {
  WatchedContact probe(stiffness_, 0.5), pushed(stiffness_, 0.5);
  const Eigen::Vector3d place(0.4, 0.4, 0.45);
  probe.advance(place);
  EXPECT_TRUE(probe.contact.startedInside());
  EXPECT_TRUE(probe.contact.isTouching());
  EXPECT_NEAR(probe.contact.staticPoint().z(), 0.5, 1e-12);
  pushed.advance({0.4, 0.4, 0.51});
  pushed.moveTo(place, kStep);
  EXPECT_LE(probe.contact.force().norm(), 0.05 * pushed.contact.force().norm());
  double last = 0;
  for (int tick = 0; tick < 2000; ++tick) {  // each of which is held to the bound on jumps
    probe.advance(place);
    EXPECT_FALSE(probe.contact.startedInside());
    EXPECT_GE(probe.contact.force().norm(), last * (1 - 1e-9));
    last = probe.contact.force().norm();
  }
  EXPECT_LE((probe.contact.force() - pushed.contact.force()).norm(), 1e-9 * last);
  probe.moveTo({0.4, 0.4, 0.51}, kStep);
  EXPECT_FALSE(probe.contact.isTouching());
}

TEST_F(SlidingContactOnAPlate, APlaceThatIsNoneEndsTheContactAtOnce) {
  for (double bad : {double(NAN), double(INFINITY)}) {
    WatchedContact push = pressed(0.5);
    const double before = push.contact.force().norm();
    push.contact.advance({0.5, bad, 0.4});
    EXPECT_EQ(push.contact.force(), Eigen::Vector3d::Zero());
    EXPECT_FALSE(push.contact.isTouching());
    push.contact.advance({0.45, 0.5, 0.45});  // inside: from zero
    EXPECT_TRUE(push.contact.startedInside());
    EXPECT_LE(push.contact.force().norm(), 0.05 * before);
  }
}

TEST_F(SlidingContactOnAPlate, WhereThereIsNoStiffnessThereIsNoContactNorAWayInto) {
  // Columns of the top's middle alone, so that masks elsewhere cannot be made.
  GreensFunctionsInfo info = body_->greens->info();
  info.columnNodes.clear();
  const auto isNear = [](const Eigen::Vector3d& x) {
    return x.z() == 0.5 && (x - Eigen::Vector3d(0.5, 0.5, 0.5)).norm() < 0.45;
  };
  std::vector<int> columns;
  for (int v = 0; v < body_->mesh->vertexCount(); ++v)
    if (isNear(body_->mesh->points().col(v))) columns.push_back(v);
  info.columnNodes = columns;
  const Eigen::MatrixXd whole = denseMatrix(*body_->greens);
  const auto few = denseGreens(info, whole);
  const auto served = std::make_shared<SurfaceStiffness>(few, body_->mesh, MaskShape::Linear, 0.2);
  WatchedContact probe(served, 0.1);
  probe.advance({0.05, 0.05, 0.6});
  probe.advance({0.05, 0.05, 0.45});
  EXPECT_TRUE(probe.contact.isUnserved());
  EXPECT_EQ(probe.contact.force(), Eigen::Vector3d::Zero());
  probe.advance({0.5, 0.5, 0.6});
  probe.moveTo({0.5, 0.5, 0.45}, kStep);
  EXPECT_TRUE(probe.contact.isTouching());
  probe.moveTo({0.95, 0.5, 0.45}, kStep, [&] {
    EXPECT_TRUE(probe.contact.force().allFinite());
    EXPECT_TRUE(probe.contact.servedStiffness().allFinite());
  });
  EXPECT_LT(probe.contact.staticPoint().x(), 0.85);
  probe.moveTo({0.99, 0.5, 0.45}, kStep, [&] { EXPECT_TRUE(probe.contact.isStuck()); });
}

TEST_F(SlidingContactOnAPlate, ATickAllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  const auto surface = std::make_shared<const TouchedSurface>(body_->mesh);
  SlidingContact contact(stiffness_, surface);
  contact.setFriction(0.3);
  const auto other = stiffness_->withYoungsModulus(5);
  const long before = allocationCount();
  double sum = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick == 400) contact.setStiffness(other);
    contact.setAdhesion(tick > 800);
    sum += contact.advance({0.2 + 6e-4 * tick, 0.5, 0.5 + 0.1 * std::cos(0.01 * tick)}).norm();
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(sum, 0);
}

TEST(SlidingContact, OnAnotherMeshThanItsStiffnessIsRefused) {
  const TouchedBody body = touchedSphere(1, true);
  const auto surface = std::make_shared<const TouchedSurface>(icosphere(1).mesh());
  EXPECT_TRUE(isRefused([&] { SlidingContact(maskedStiffness(body, 2), surface); },
                        "the stiffness is that of another mesh than the one to be touched"));
}

TEST(SlidingContact, WithoutFrictionItsForceIsAlongTheNormal) {
  const TouchedBody body = touchedSphere(3, true);
  WatchedContact contact(maskedStiffness(body, 2), 0);
  contact.advance({0, 0, 1.1});
  contact.moveTo({0, 0, 0.9}, kStep);
  for (double angle = 0; angle < 2; angle += 0.001) {
    contact.advance(0.9 * Eigen::Vector3d(std::sin(angle), 0, std::cos(angle)));
    ASSERT_TRUE(contact.contact.isTouching());
    EXPECT_LE(contact.across(), 1e-3 * contact.pressing()) << angle;
    EXPECT_GT(contact.pressing(), 0);
    // The contact stays above the probe, as interpolated normals of an irregular mesh go.
    EXPECT_LE((contact.contact.staticPoint().normalized() - contact.place().normalized()).norm(),
              0.05);
  }
}

}  // namespace
}  // namespace palpate::test
