// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/passivity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

TEST(ServedStiffness, IsTheColgateBound) {
  EXPECT_DOUBLE_EQ(servedStiffness(0.5, 1e-3, 0), 1000);
  EXPECT_DOUBLE_EQ(servedStiffness(0.5, 1e-3, 1), 1000. / 3);
  EXPECT_DOUBLE_EQ(servedStiffness(0.5, 1e-3, 2), 200);
  EXPECT_EQ(servedStiffness(0, 1e-3, 0), 0);
}

TEST(ServedStiffness, RefusesWhatNoDeviceHas) {
  EXPECT_TRUE(isRefused([] { servedStiffness(-1, 1e-3, 0); }, "damping must not be negative: -1"));
  EXPECT_TRUE(isRefused([] { servedStiffness(NAN, 1e-3, 0); }, "damping must not be negative"));
  EXPECT_TRUE(isRefused([] { servedStiffness(1, 0, 0); }, "period must be positive: 0"));
  EXPECT_TRUE(isRefused([] { servedStiffness(1, 1e-3, -1); }, "delay must not be negative: -1"));
}

/// Moves along x through a spring's force as a sampled loop sees it, there and back.
double energyOfAStroke(double stiffness, double speed, double period) {
  PassivityObserver observer;
  const int ticks = 100;
  for (int i = -ticks; i <= ticks; ++i) {
    const Vector3d position = Vector3d::UnitX() * speed * period * (ticks - std::abs(i));
    observer.advance(position);
    observer.hold(-stiffness * position);
  }
  return observer.energy();
}

TEST(PassivityObserver, ASampledSpringMakesKTimesVelocitySquaredTimesPeriodPerSecond) {
  // Each force is held while the hand moves on by v T: K v^2 T^2 / 2 a tick too little on the way
  // in and too much on the way out, 2 x 100 ticks of it.
  for (double speed : {0.01, 0.1})
    EXPECT_NEAR(energyOfAStroke(500, speed, 1e-3), -200 * 500 * speed * speed * 1e-6 / 2,
                1e-12 * speed * speed);
}

TEST(PassivityObserver, ADamperTakesItsPowerTimesItsTime) {
  PassivityObserver observer;
  const Vector3d velocity(0.1, -0.2, 0.3);
  for (int i = 0; i <= 1000; ++i) {
    observer.advance(1e-3 * i * velocity);
    observer.hold(-2 * velocity);
  }
  EXPECT_NEAR(observer.energy(), 2 * velocity.squaredNorm(), 1e-12);
}

TEST(PassivityObserver, EachContactIsAlsoCountedByItself) {
  PassivityObserver observer;
  auto move = [&](double x, double force) {
    observer.advance({x, 0, 0});
    observer.hold({force, 0, 0});
  };
  move(0, 1);
  move(1, 0);
  EXPECT_EQ(observer.energy(), -1);
  EXPECT_EQ(observer.contactEnergy(), 0);
  move(2, -3);
  move(3, -3);
  EXPECT_EQ(observer.energy(), 2);
  EXPECT_EQ(observer.contactEnergy(), 3);
  observer.interrupt();
  move(100, 0);
  EXPECT_EQ(observer.energy(), 2) << "no force was held over the interruption";
}

TEST(PassivityDamping, TakesBackInOneTickWhatWasMade) {
  const Vector3d velocity(0.1, 0, 0);
  const double period = 1e-3, made = -1e-5, damping = passivityDamping(made, velocity, period, 75);
  PassivityObserver observer;
  observer.advance(Vector3d::Zero());
  observer.hold(-damping * velocity);
  observer.advance(period * velocity);
  EXPECT_NEAR(observer.energy(), -made, 1e-18);
}

TEST(PassivityDamping, DoesNothingToAPassiveOrRestingHandAndNeverTooMuch) {
  EXPECT_EQ(passivityDamping(1e-3, Vector3d::UnitX(), 1e-3, 75), 0);
  EXPECT_EQ(passivityDamping(-1e-3, Vector3d::Zero(), 1e-3, 75), 0);
  EXPECT_EQ(passivityDamping(NAN, Vector3d::UnitX(), 1e-3, 75), 0);
  EXPECT_EQ(passivityDamping(-1, 1e-3 * Vector3d::UnitX(), 1e-3, 75), 75);
}

}  // namespace
}  // namespace palpate::test
