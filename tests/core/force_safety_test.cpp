// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/force_safety.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "support/allocation_count.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPeriod = 1e-3;

/// A hand at rest, a force wanted, and what can go wrong with them.
class AHandThatFeels : public testing::Test {
 protected:
  AHandThatFeels() {
    state_.sequence = 1;
    request_.wanted = {{0, 0, 1}, {0, 0.02, 0}};
  }

  /// A tick with a new report.
  Wrench tick(double elapsed = kPeriod) {
    ++state_.sequence;
    return silentTick(elapsed);
  }
  Wrench silentTick(double elapsed = kPeriod) {
    safety_.admit(present_, state_, elapsed);
    const Wrench wrench = safety_.limit(request_, elapsed);
    safety_.delivered(delivered_);
    return wrench;
  }
  void tickUntilItRenders() {
    for (int i = 0; i < 700 && phase() != SafetyPhase::Rendering; ++i) tick();
    ASSERT_EQ(phase(), SafetyPhase::Rendering);
    for (int i = 0; i < 10; ++i) tick();
  }
  SafetyPhase phase() const { return safety_.report().phase; }
  std::int64_t faults(Fault fault) const {
    return safety_.report().faults[static_cast<int>(fault)];
  }
  /// It comes back only after the whole settling time, and then over the whole ramp.
  void expectToReturnByARamp() {
    int zeros = 0, rising = 0;
    double last = 0, largestRise = 0;
    while (phase() != SafetyPhase::Rendering && zeros + rising < 2000) {
      const double force = tick().force.norm();
      (force == 0 ? zeros : rising) += 1;
      largestRise = std::max(largestRise, force - last);
      EXPECT_GE(force, last);
      last = force;
    }
    EXPECT_NEAR(zeros, settings_.settleSeconds / kPeriod, 3);
    EXPECT_NEAR(rising, settings_.rampSeconds / kPeriod, 1);
    EXPECT_NEAR(last, request_.wanted.force.norm(), 1e-12);
    EXPECT_NEAR(largestRise, last * kPeriod / settings_.rampSeconds, 1e-12);
    EXPECT_EQ(safety_.report().fault, Fault::None);
  }

  SafetySettings settings_;
  ForceSafety safety_{settings_, kPeriod};
  DeviceState state_;
  ForceSafety::Request request_{};
  bool present_ = true, delivered_ = true;
};

TEST_F(AHandThatFeels, NothingAtFirstAndThenTheForceByARamp) {
  expectToReturnByARamp();
  EXPECT_EQ(tick().force, request_.wanted.force);
  EXPECT_EQ(tick().torque, request_.wanted.torque);
}

TEST_F(AHandThatFeels, NeverMoreThanTheLargestForceAndTorqueInTheirDirections) {
  request_.wanted = {{0, 300, 400}, {50, 0, 0}};
  tickUntilItRenders();
  EXPECT_LE((tick().force - Vector3d(0, 1.8, 2.4)).norm(), 1e-12);
  EXPECT_LE((tick().torque - Vector3d(0.1, 0, 0)).norm(), 1e-12);
  EXPECT_GT(safety_.report().limitedTicks, 0);
  request_.wanted.force.setConstant(1e308);
  EXPECT_NEAR(tick().force.norm(), 3, 1.01) << "its norm overflows, the force does not";
}

TEST_F(AHandThatFeels, ADeviceThatRendersNoneIsGivenNone) {
  settings_.largestForce = settings_.largestTorque = 0;
  safety_ = ForceSafety(settings_, kPeriod);
  tickUntilItRenders();
  EXPECT_EQ(tick().force, Vector3d::Zero());
  EXPECT_EQ(tick().torque, Vector3d::Zero());
}

TEST_F(AHandThatFeels, NoChangeFasterThanTheSlewLimit) {
  tickUntilItRenders();
  Vector3d last = tick().force;
  request_.wanted.force = {-2, 1, 0};
  int ticks = 0;
  for (; (last - request_.wanted.force).norm() > 1e-12 && ticks < 10; ++ticks) {
    const Vector3d force = tick().force;
    EXPECT_LE((force - last).norm(), settings_.forceSlew * kPeriod * (1 + 1e-12));
    last = force;
  }
  EXPECT_EQ(ticks, 3) << "the square root of 6 newtons at one a millisecond";
  EXPECT_EQ(safety_.report().slewedTicks, 2);
}

TEST_F(AHandThatFeels, AMissedTickDoesNotLetTheForceChangeFaster) {
  tickUntilItRenders();
  request_.wanted.force = {-2, 1, 0};
  const Vector3d last = safety_.limit(request_, 0).force;
  EXPECT_LE((tick(15 * kPeriod).force - last).norm(), settings_.forceSlew * kPeriod * (1 + 1e-12));
}

TEST_F(AHandThatFeels, AForceThatFadesLinearlyToExactlyZeroAfterAPoseThatIsNotValid) {
  std::vector<ToolPose> poses(8);
  poses[0].position.y() = NAN;
  poses[1].position.x() = INFINITY;
  poses[2].position.z() = 1e300;
  poses[3].orientation.coeffs().setZero();
  poses[4].orientation.w() = NAN;
  poses[5].jointCount = 1;
  poses[5].joints[0] = INFINITY;
  poses[6].jointCount = ToolPose::kMostJoints + 1;
  poses[7].jointCount = -1;
  std::int64_t count = 0;
  for (const ToolPose& pose : poses) {
    state_.pose = ToolPose();
    tickUntilItRenders();
    const Wrench before = tick();
    EXPECT_GT(before.force.norm(), 0.9);
    const int ticks = static_cast<int>(std::lround(settings_.fadeSeconds / kPeriod));
    for (int i = 1; i <= ticks; ++i) {
      state_.pose = i < 4 ? pose : ToolPose();  // nor does it stop when they are valid again
      const Wrench wrench = tick();
      const double share = 1 - i / static_cast<double>(ticks);
      EXPECT_LE((wrench.force - share * before.force).norm(), 1e-15);
      EXPECT_LE((wrench.torque - share * before.torque).norm(), 1e-15);
      EXPECT_EQ(safety_.report().fault, Fault::InvalidPose);
    }
    EXPECT_EQ(tick().force, Vector3d::Zero());
    count += 3;
    EXPECT_EQ(faults(Fault::InvalidPose), count);
    expectToReturnByARamp();
  }
}

TEST_F(AHandThatFeels, TheModelOnlyEverSeesPosesThatAreValid) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-20, 20);
  const double odd[] = {NAN, INFINITY, -INFINITY, 1e308, 0};
  for (int i = 0; i < 1000000; ++i) {
    state_.sequence += random() % 2;
    double* const values[] = {&state_.pose.position.x(), &state_.pose.position.y(),
                              &state_.pose.position.z(), &state_.pose.orientation.x(),
                              &state_.pose.orientation.w()};
    for (double* value : values) *value = random() % 8 ? uniform(random) : odd[random() % 5];
    if (random() % 2) state_.pose.orientation.normalize();
    present_ = random() % 10;
    const ToolPose& pose = safety_.admit(present_, state_, kPeriod);
    ASSERT_TRUE(pose.position.norm() <= settings_.largestReach);
    ASSERT_NEAR(pose.orientation.norm(), 1, 1e-15);
    const Wrench& wrench = safety_.limit(request_, kPeriod);
    ASSERT_TRUE(wrench.force.norm() <= settings_.largestForce * (1 + 1e-15));
  }
}

TEST_F(AHandThatFeels, AQuaternionRoundedByTheDeviceIsMadeAUnitOne) {
  state_.pose.orientation = Quaterniond(1.01, 0, 0, 0);
  ++state_.sequence;
  EXPECT_EQ(safety_.admit(true, state_, kPeriod).orientation.norm(), 1);
  tick();
  EXPECT_EQ(safety_.report().fault, Fault::None);
}

TEST_F(AHandThatFeels, AForceThatFadesLinearlyToExactlyZeroInTheFadeTimeAfterAJump) {
  for (double wanted : {1.0, 1e-3, 3.0}) {
    request_.wanted.force = {0, wanted, 0};
    tickUntilItRenders();
    const Vector3d before = tick().force;
    state_.pose.position.x() += 0.06;
    request_.wanted.force = {100, 0, 0};  // what the model makes of it does not matter
    for (int i = 1; i <= 10; ++i) {
      const Wrench wrench = tick();
      EXPECT_LE((wrench.force - (1 - 0.1 * i) * before).norm(), 1e-15);
      EXPECT_EQ(safety_.report().fault, Fault::Jump);
    }
    EXPECT_EQ(tick().force, Vector3d::Zero());
    request_.wanted.force = {0, wanted, 0};
    expectToReturnByARamp();
  }
  EXPECT_EQ(faults(Fault::Jump), 3);
}

TEST_F(AHandThatFeels, TheTimeOfTheFirstFaultOfEachKindIsKept) {
  for (int i = 0; i < 20; ++i) tick();
  state_.pose.position.x() = NAN;
  for (int i = 0; i < 5; ++i) tick();
  state_.pose = ToolPose();
  tick(2 * kPeriod);
  present_ = false;
  for (int i = 0; i < 3; ++i) tick();
  present_ = true;
  for (int i = 0; i < 30; ++i) tick();
  state_.pose.position.x() = NAN;
  tick();
  EXPECT_EQ(faults(Fault::InvalidPose), 6);
  EXPECT_EQ(faults(Fault::Unplugged), 3);
  const auto& first = safety_.report().firstFaults;
  EXPECT_NEAR(first[static_cast<int>(Fault::InvalidPose)], 20 * kPeriod, 1e-12);
  EXPECT_NEAR(first[static_cast<int>(Fault::Unplugged)], 27 * kPeriod, 1e-12);
}

TEST_F(AHandThatFeels, FadingTakesTheSameTimeWhenTicksAreMissed) {
  tickUntilItRenders();
  state_.pose.position.x() += 0.06;
  const double before = tick(0).force.norm();
  EXPECT_NEAR(tick(4 * kPeriod).force.norm(), 0.6 * before, 1e-12);
  EXPECT_EQ(tick(6 * kPeriod).force, Vector3d::Zero());
}

TEST_F(AHandThatFeels, FiveCentimetresAMillisecondIsTheFastestThatIsNoJump) {
  tickUntilItRenders();
  state_.pose.position.x() += 0.0499;
  tick();
  EXPECT_EQ(faults(Fault::Jump), 0);
  state_.pose.position.x() += 0.0501;
  tick();
  EXPECT_EQ(faults(Fault::Jump), 1);
  // From where it jumped to, it may go on; over two periods twice as far.
  silentTick();
  state_.pose.position.x() += 0.0999;
  tick();
  EXPECT_EQ(faults(Fault::Jump), 1);
  state_.pose.orientation = Quaterniond(Eigen::AngleAxisd(0.51, Vector3d::UnitX()));
  tick();
  EXPECT_EQ(faults(Fault::Jump), 2);
  state_.pose.orientation.coeffs() *= -1;  // the same rotation
  tick();
  EXPECT_EQ(faults(Fault::Jump), 2);
}

TEST_F(AHandThatFeels, ThreeSilentTicksBringTheForceToZeroAndAReportBringsItBackByARamp) {
  tickUntilItRenders();
  const double before = tick().force.norm();
  EXPECT_EQ(silentTick().force.norm(), before) << "one is tolerated";
  EXPECT_NEAR(silentTick().force.norm(), before / 2, 1e-12);
  EXPECT_EQ(silentTick().force, Vector3d::Zero());
  EXPECT_EQ(safety_.report().fault, Fault::Silent);
  EXPECT_EQ(faults(Fault::Silent), 1);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(silentTick().force, Vector3d::Zero());
  expectToReturnByARamp();
}

TEST_F(AHandThatFeels, AReportInTimeEndsASilenceWithoutAFault) {
  tickUntilItRenders();
  silentTick();
  EXPECT_LT(silentTick().force.norm(), 0.6);
  EXPECT_EQ(tick().force, request_.wanted.force) << "half a newton is within the slew limit";
  EXPECT_EQ(faults(Fault::Silent), 0);
  EXPECT_EQ(phase(), SafetyPhase::Rendering);
}

/// Ticks of a device that reports in every `every`-th one only.
class ASlowDevice : public AHandThatFeels, public testing::WithParamInterface<int> {
 protected:
  const int every_ = GetParam();
  const double rate_ = 1 / (kPeriod * every_);

  /// @return the least and the largest force.
  std::pair<double, double> forces(int reports) {
    std::pair<double, double> range{HUGE_VAL, 0};
    for (int i = 0; i < reports * every_; ++i) {
      const double force = (i % every_ ? silentTick() : tick()).force.norm();
      range = {std::min(range.first, force), std::max(range.second, force)};
    }
    return range;
  }
  void startWith(double statedRate) {
    safety_ = ForceSafety(settings_, kPeriod, statedRate);
    forces(1000 / every_);
  }
};

TEST_P(ASlowDevice, GetsASteadyForceWhateverItStates) {
  for (double stated : {0.0, rate_, 1 / kPeriod, 10 * rate_}) {
    startWith(stated);
    const auto [least, largest] = forces(100);
    EXPECT_EQ(least, request_.wanted.force.norm()) << stated;
    EXPECT_EQ(largest, least);
    for (std::int64_t ticks : safety_.report().faults) EXPECT_EQ(ticks, 0);
  }
}

TEST_P(ASlowDevice, MayLoseAReportAndNoMore) {
  for (double stated : {0.0, rate_}) {
    startWith(stated);
    const double before = tick().force.norm();
    for (int i = 1; i < 2 * every_; ++i) EXPECT_EQ(silentTick().force.norm(), before);
    EXPECT_LT(silentTick().force.norm(), before);
    EXPECT_EQ(faults(Fault::Silent), 0);
  }
}

TEST_P(ASlowDevice, FallingSilentHasNoForceAfterThreeOfItsIntervals) {
  for (double stated : {0.0, rate_}) {
    startWith(stated);
    double last = tick().force.norm(), steepest = 0;
    for (int i = 1; i <= 3 * every_; ++i) {
      EXPECT_EQ(faults(Fault::Silent), 0);
      const double force = silentTick().force.norm();
      EXPECT_LE(force, last);
      steepest = std::max(steepest, last - force);
      last = force;
    }
    EXPECT_EQ(last, 0);
    EXPECT_NEAR(steepest, request_.wanted.force.norm() / (every_ + 1), 1e-12) << "in equal steps";
    EXPECT_EQ(faults(Fault::Silent), 1);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(silentTick().force, Vector3d::Zero());
    expectToReturnByARamp();
  }
}

INSTANTIATE_TEST_SUITE_P(Intervals, ASlowDevice, testing::Values(1, 2, 3, 4, 8, 20));

TEST_F(AHandThatFeels, ADeviceOfLessThanFiftyReportsASecondGetsNoForceAndThatIsTold) {
  for (int every : {21, 50, 100})
    for (double stated : {0.0, 1 / (every * kPeriod)}) {
      safety_ = ForceSafety(settings_, kPeriod, stated);
      for (int i = 0; i < 3000; ++i)
        EXPECT_EQ((i % every ? silentTick() : tick()).force, Vector3d::Zero());
      EXPECT_EQ(safety_.report().fault, Fault::Silent);
    }
}

TEST_F(AHandThatFeels, TheEndOfARecordingIsToldAsThat) {
  tickUntilItRenders();
  state_.isOver = true;
  for (int i = 0; i < 10; ++i) silentTick();
  EXPECT_EQ(silentTick().force, Vector3d::Zero());
  EXPECT_EQ(safety_.report().fault, Fault::Ended);
  EXPECT_EQ(faults(Fault::Silent), 0);
  EXPECT_STREQ(describe(Fault::Ended), "the end of the recording");
}

TEST_F(AHandThatFeels, ATickThatComesLateIsOfTheDeviceNoMoreThanAReportThatIsMissing) {
  tickUntilItRenders();
  const double before = tick().force.norm();
  EXPECT_EQ(silentTick(15 * kPeriod).force.norm(), before);
  EXPECT_EQ(tick().force.norm(), before);
  EXPECT_EQ(faults(Fault::Silent), 0);
}

TEST_F(AHandThatFeels, NothingInTheSameTickAsADeviceIsUnpluggedAndARampWhenItReturns) {
  for (int cycle = 0; cycle < 3; ++cycle) {
    tickUntilItRenders();
    present_ = false;
    EXPECT_EQ(tick().force, Vector3d::Zero());
    EXPECT_EQ(safety_.report().fault, Fault::Unplugged);
    for (int i = 0; i < 100; ++i) tick();
    present_ = true;
    state_.pose.position.x() = 0.1 * cycle;  // wherever it comes back is no jump
    expectToReturnByARamp();
  }
  EXPECT_EQ(faults(Fault::Unplugged), 3 * 101);
  EXPECT_EQ(faults(Fault::Jump), 0);
}

TEST_F(AHandThatFeels, PluggingInAndOutForeverNeverRendersAForce) {
  for (int cycle = 0; cycle < 10000; ++cycle) {
    present_ = cycle % 2;
    EXPECT_EQ(tick().force, Vector3d::Zero());
  }
}

TEST_F(AHandThatFeels, ADeviceThatTakesNoForceIsAFault) {
  tickUntilItRenders();
  delivered_ = false;
  for (int i = 0; i < 3; ++i) tick();
  EXPECT_EQ(safety_.report().fault, Fault::None);
  for (int i = 0; i < 10; ++i) tick();
  EXPECT_EQ(safety_.report().fault, Fault::Undelivered);
  EXPECT_EQ(tick().force, Vector3d::Zero());
  delivered_ = true;
  tick();
  expectToReturnByARamp();
}

TEST_F(AHandThatFeels, TheLastSoundForceFadesFromTheFirstFailedSolveOn) {
  tickUntilItRenders();
  const Vector3d before = tick().force;
  for (double bad : {0.0, static_cast<double>(NAN)}) {
    request_.wanted.force = {bad, 0, 5};
    request_.certificate.failed = bad == 0;
    for (int i = 1; i <= 2; ++i) EXPECT_LE((tick().force - (1 - 0.1 * i) * before).norm(), 1e-15);
    EXPECT_EQ(faults(Fault::FailedSolves), 0) << "two in a row are passed over";
    request_.wanted.force = before;
    request_.certificate.failed = false;
    EXPECT_EQ(tick().force, before);
  }
  request_.certificate.failed = true;
  for (int i = 1; i <= 10; ++i) EXPECT_LE((tick().force - (1 - 0.1 * i) * before).norm(), 1e-15);
  EXPECT_EQ(tick().force, Vector3d::Zero());
  EXPECT_EQ(safety_.report().fault, Fault::FailedSolves);
  request_.certificate.failed = false;
  expectToReturnByARamp();
}

TEST_F(AHandThatFeels, ManyLateSolvesInARowAreAFaultAndFewAreNot) {
  tickUntilItRenders();
  for (int i = 0; i < 200; ++i) {
    request_.late = i % 20;
    tick();
  }
  EXPECT_EQ(faults(Fault::LateSolves), 0);
  request_.late = false;
  tick();
}

/// However the periods are shared among ticks: the hand has felt one force all the while.
TEST_F(AHandThatFeels, OneTickOfManyPeriodsIsTheFaultThatManyLateOnesAre) {
  for (const int ticks : {1, 2, 4, 5, 10}) {
    tickUntilItRenders();
    const auto before = faults(Fault::LateSolves);
    request_.late = true;
    request_.taken = 20 / ticks * kPeriod;
    for (int i = 1; i < ticks; ++i) EXPECT_EQ(tick().force, request_.wanted.force) << ticks;
    EXPECT_EQ(faults(Fault::LateSolves), before) << ticks;
    const Vector3d force = tick().force;
    EXPECT_EQ(faults(Fault::LateSolves), before + 1) << ticks;
    if (ticks <= 2) {
      EXPECT_EQ(force, Vector3d::Zero()) << "held for longer than a force fades";
    }
    request_.late = false;
    request_.taken = 0;
    for (int i = 0; i < 10 && safety_.report().phase == SafetyPhase::Fading; ++i) tick();
    EXPECT_EQ(safety_.report().phase, SafetyPhase::Settling);
    expectToReturnByARamp();
  }
}

/// A loop that was not let run, or waited for something, computed little in that time.
TEST_F(AHandThatFeels, AForceThatWasHeldForManyPeriodsIsAFaultWhateverTheTickComputed) {
  tickUntilItRenders();
  EXPECT_EQ(tick(19 * kPeriod).force, request_.wanted.force);
  EXPECT_EQ(faults(Fault::LateSolves), 0);
  EXPECT_EQ(tick(20 * kPeriod).force, Vector3d::Zero());
  EXPECT_EQ(faults(Fault::LateSolves), 1);
  expectToReturnByARamp();
  request_.taken = 20 * kPeriod;
  EXPECT_EQ(tick().force, Vector3d::Zero());
  EXPECT_EQ(faults(Fault::LateSolves), 2);
}

/// What was cut near its tolerance presses as it should.
TEST_F(AHandThatFeels, SolvesThatWereCutWithAResidualThatIsNotFeltAreNoFault) {
  tickUntilItRenders();
  request_.certificate.budgetCut = true;
  request_.certificate.residual = 1e-3;
  for (int i = 0; i < 200; ++i) EXPECT_EQ(tick().force, request_.wanted.force);
  EXPECT_EQ(faults(Fault::RoughSolves), 0);
  request_.certificate.residual = 1.001e-3;
  for (int i = 0; i < 20; ++i) tick();
  EXPECT_EQ(faults(Fault::RoughSolves), 1);
}

TEST_F(AHandThatFeels, EachReasonToDoubtSolvesHasANameOfItsOwn) {
  const auto only = [](bool late, bool cut, bool heldBack) {
    ForceSafety::Request request;
    request.late = late;
    request.certificate.budgetCut = cut;
    request.certificate.residual = cut ? 2e-3 : 0;
    request.certificate.heldBack = heldBack;
    return request;
  };
  const std::pair<Fault, ForceSafety::Request> reasons[] = {
      {Fault::LateSolves, only(true, false, false)},
      {Fault::RoughSolves, only(false, true, false)},
      {Fault::HeldBack, only(false, false, true)},
      {Fault::LateSolves, only(true, true, true)}};
  std::set<std::string> names;
  tickUntilItRenders();
  for (const auto& [fault, reason] : reasons) {
    const Wrench wanted = request_.wanted;
    request_ = reason;
    request_.wanted = wanted;
    for (int i = 0; i < 19; ++i) EXPECT_EQ(tick().force, request_.wanted.force);
    for (int i = 0; i < 10; ++i) tick();
    EXPECT_EQ(tick().force, Vector3d::Zero());
    EXPECT_EQ(safety_.report().fault, fault);
    names.insert(describe(fault));
    request_ = {};
    request_.wanted = wanted;
    expectToReturnByARamp();
  }
  EXPECT_EQ(names.size(), 3u);
}

TEST_F(AHandThatFeels, ATouchThatBeginsInsideIsToldAndReturnsByARamp) {
  tickUntilItRenders();
  request_.certificate.startedInside = true;
  tick();
  EXPECT_EQ(safety_.report().fault, Fault::StartedInside);
  EXPECT_EQ(faults(Fault::StartedInside), 1);
  request_.certificate.startedInside = false;
  for (int i = 0; i < 10; ++i) tick();
  EXPECT_EQ(tick().force, Vector3d::Zero());
  expectToReturnByARamp();
}

TEST_F(AHandThatFeels, AForceOfTooFewContactsIsRenderedAsItIs) {
  tickUntilItRenders();
  request_.certificate.truncated = true;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tick().force, request_.wanted.force);
  EXPECT_EQ(safety_.report().fault, Fault::None);
}

TEST_F(AHandThatFeels, OneFaultAfterAnotherNeverRaisesAForceThatFades) {
  settings_.longestInterval = kPeriod;  // so that two silent ticks are always too many
  safety_ = ForceSafety(settings_, kPeriod);
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    state_.pose.position.setZero();
    present_ = delivered_ = true;
    request_ = ForceSafety::Request();
    request_.wanted.force = {0, 0, 1};
    tickUntilItRenders();
    double last = tick().force.norm();
    for (int i = 0; i < 30; ++i) {
      // Always something: silence beyond what is tolerated, a jump, a failure or a pause.
      const unsigned what = random() % 4;
      request_.certificate.failed = what == 1;
      request_.paused = what == 2;
      if (what == 3) state_.pose.position.x() = state_.pose.position.x() > 0 ? 0 : 1;
      const bool silent = what == 0 && i > 0;
      if (silent) silentTick();
      const double force = (silent ? silentTick() : tick()).force.norm();
      EXPECT_LE(force, last + (what == 0 && i == 0 ? 1 : 0));
      last = force;
    }
    EXPECT_EQ(last, 0);
    request_ = ForceSafety::Request();
    for (int i = 0; i < 20; ++i) tick();
  }
}

TEST_F(AHandThatFeels, PausingFadesWithoutAFaultAndResumingRamps) {
  tickUntilItRenders();
  const double before = tick().force.norm();
  request_.paused = true;
  EXPECT_NEAR(tick().force.norm(), 0.9 * before, 1e-12);
  for (int i = 0; i < 9; ++i) tick();
  EXPECT_EQ(tick().force, Vector3d::Zero());
  EXPECT_EQ(safety_.report().fault, Fault::None);
  request_.paused = false;
  expectToReturnByARamp();
}

TEST_F(AHandThatFeels, ContactStartsAnewAfterWhatBreaksAPath) {
  EXPECT_FALSE(safety_.startsAnew());
  tick();
  EXPECT_TRUE(safety_.startsAnew());
  tick();
  EXPECT_FALSE(safety_.startsAnew());
  state_.pose.position.x() = 0.3;
  tick();
  EXPECT_FALSE(safety_.startsAnew()) << "the jump itself is not believed";
  EXPECT_EQ(safety_.admit(true, state_, kPeriod).position.x(), 0);
  tick();
  EXPECT_TRUE(safety_.startsAnew());
  present_ = false;
  tick();
  EXPECT_FALSE(safety_.startsAnew());
  present_ = true;
  tick();
  EXPECT_TRUE(safety_.startsAnew());
}

TEST_F(AHandThatFeels, ATickAllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  const long before = allocationCount();
  for (int i = 0; i < 1000; ++i) {
    state_.pose.position.x() = i % 100 ? 0 : NAN;
    present_ = i % 70;
    tick();
  }
  EXPECT_EQ(allocationCount(), before);
}

TEST(ForceSafety, EveryFaultHasItsOwnWords) {
  std::vector<std::string> words;
  for (int f = 0; f < kFaultCount; ++f) {
    words.push_back(describe(static_cast<Fault>(f)));
    EXPECT_FALSE(words.back().empty());
    for (int g = 0; g < f; ++g) EXPECT_NE(words[f], words[g]);
  }
}

TEST(ForceSafety, RefusesSettingsThatProtectNobody) {
  auto with = [](auto change, const char* name) {
    return isRefused(
        [&] {
          SafetySettings settings;
          change(settings);
          ForceSafety(settings, kPeriod);
        },
        std::string("the safety setting ") + name + " is out of range");
  };
  EXPECT_TRUE(with([](auto& s) { s.largestForce = -1; }, "largestForce"));
  EXPECT_TRUE(with([](auto& s) { s.largestForce = INFINITY; }, "largestForce"));
  EXPECT_TRUE(with([](auto& s) { s.largestTorque = NAN; }, "largestTorque"));
  EXPECT_TRUE(with([](auto& s) { s.forceSlew = 0; }, "forceSlew"));
  EXPECT_TRUE(with([](auto& s) { s.torqueSlew = 0; }, "torqueSlew"));
  EXPECT_TRUE(with([](auto& s) { s.fadeSeconds = 0; }, "fadeSeconds"));
  EXPECT_TRUE(with([](auto& s) { s.settleSeconds = -1; }, "settleSeconds"));
  EXPECT_TRUE(with([](auto& s) { s.rampSeconds = 0; }, "rampSeconds"));
  EXPECT_TRUE(with([](auto& s) { s.largestSpeed = NAN; }, "largestSpeed"));
  EXPECT_TRUE(with([](auto& s) { s.largestTurning = 0; }, "largestTurning"));
  EXPECT_TRUE(with([](auto& s) { s.largestReach = INFINITY; }, "largestReach"));
  EXPECT_TRUE(with([](auto& s) { s.toleratedSilence = -1; }, "toleratedSilence"));
  EXPECT_TRUE(with([](auto& s) { s.largestSilence = 1; }, "largestSilence"));
  EXPECT_TRUE(with([](auto& s) { s.longestInterval = 0; }, "longestInterval"));
  EXPECT_TRUE(with([](auto& s) { s.undeliveredTicks = 0; }, "undeliveredTicks"));
  EXPECT_TRUE(with([](auto& s) { s.failedSolves = 0; }, "failedSolves"));
  EXPECT_TRUE(with([](auto& s) { s.lateSolves = 0; }, "lateSolves"));
  EXPECT_TRUE(isRefused([] { ForceSafety({}, 0); }, "the safety setting period"));
  EXPECT_TRUE(isRefused([] { ForceSafety({}, kPeriod, NAN); }, "the safety setting reportRate"));
}

}  // namespace
}  // namespace palpate::test
