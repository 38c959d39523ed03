// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>

#include "haptics/point_touch.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/point_masks.h"

// Several points on one body.

namespace palpate::test {
namespace {

std::shared_ptr<const SurfaceStiffness> stiffnessOf(
    const TouchedBody& body, double edges,
    DisplacementMeasure measure = DisplacementMeasure::Mean) {
  const PressureMasks masks(*body.mesh, body.greens->info().conditions, MaskShape::Linear,
                            edges * body.mesh->meanEdgeLength());
  return std::make_shared<SurfaceStiffness>(body.greens, body.mesh, masks,
                                            StiffnessOptions{0, measure});
}

const TouchedBody& sphere() {
  static const TouchedBody body = touchedSphere(2, true);
  return body;
}
const std::shared_ptr<const SurfaceStiffness>& sphereStiffness(
    DisplacementMeasure measure = DisplacementMeasure::Mean) {
  static const auto mean = stiffnessOf(sphere(), 1.5, DisplacementMeasure::Mean),
                    vertex = stiffnessOf(sphere(), 1.5, DisplacementMeasure::Vertex);
  return measure == DisplacementMeasure::Mean ? mean : vertex;
}

Eigen::Vector3d vertexNearestTo(const Eigen::Vector3d& place) {
  int nearest;
  (sphere().mesh->points().colwise() - place).colwise().norm().minCoeff(&nearest);
  return sphere().mesh->points().col(nearest);
}

using Places = std::vector<Eigen::Vector3d>;

/// Probes whose every tick is held to what PointTouch promises.
class Probes {
 public:
  Probes(std::shared_ptr<const SurfaceStiffness> stiffness, int count, double friction)
      : touch(stiffness, count, friction), stiffness_(std::move(stiffness)) {}

  void step(const Places& places, std::uint32_t buttons = 0) {
    const int count = touch.toolCount();
    std::vector<ToolPose> poses(count);
    std::vector<Wrench> wrenches(count);
    std::vector<SlidingContact> before;
    Places shifts;
    for (int i = 0; i < count; ++i) {
      poses[i].position = places[i];
      poses[i].buttons = buttons;
      before.push_back(touch.contact(i));
      shifts.push_back(touch.shift(i));
    }
    certificate = touch.step(poses.data(), wrenches.data());
    sweeps = std::max(sweeps, certificate.iterations);
    for (int i = 0; !last_.empty() && i < count; ++i) {
      const SlidingContact &from = before[i], &to = touch.contact(i);
      const bool touched = from.isTouching();
      const double norm = touched ? from.servedStiffness().operatorNorm() : largestNorm();
      const Eigen::Vector3d step = places[i] - last_[i], shift = touch.shift(i) - shifts[i];
      const double way = touched ? (step - shift).norm() : step.norm();
      EXPECT_LE((to.force() - from.force()).norm(), norm * (way + to.relaxation()) * (1 + 1e-7));
      const Eigen::Vector3d mean = (from.force() + to.force()) / 2;
      work += mean.dot(step);
      throughput += std::abs(mean.dot(step));
      if (!touched || !to.isTouching()) continue;
      const Eigen::Vector3d u0 = last_[i] - shifts[i] - from.staticPoint(),
                            u1 = places[i] - touch.shift(i) - to.staticPoint();
      mayGiveBack += std::abs(u0.dot((to.servedStiffness() - from.servedStiffness()) * u1)) / 2;
      mayGiveBack += std::max(0., -mean.dot(to.staticPoint() - from.staticPoint()));
    }
    if (!last_.empty() && count == 2) {
      const Eigen::Matrix3d change =
          coupling(touch.contact(0), touch.contact(1)) - coupling(before[0], before[1]);
      mayGiveBack += std::abs(before[0].force().dot(change * touch.contact(1).force()) +
                              touch.contact(0).force().dot(change * before[1].force())) /
                     2;
    }
    last_ = places;
  }
  /// Straight on to places.
  void move(const Places& to, int ticks, std::uint32_t buttons = 0) {
    const Places from = last_;
    for (int t = 1; t <= ticks; ++t) {
      Places places;
      for (std::size_t i = 0; i < to.size(); ++i)
        places.push_back(from[i] + double(t) / ticks * (to[i] - from[i]));
      step(places, buttons);
    }
  }
  SurfacePoint point(int i) const { return touch.contact(i).point(); }
  Eigen::Vector3d force(int i) const { return touch.contact(i).force(); }
  /// Of x^H from x^C.
  Eigen::Vector3d displacement(int i) const { return last_[i] - touch.contact(i).staticPoint(); }

  PointTouch touch;
  ContactCertificate certificate;
  int sweeps = 0;
  double work = 0;         ///< of the hands so far
  double mayGiveBack = 0;  ///< that a closed path may, by the header
  double throughput = 0;   ///< work by its absolute value

 private:
  Eigen::Matrix3d coupling(const SlidingContact& i, const SlidingContact& j) const {
    if (i.force().isZero(0) || j.force().isZero(0)) return Eigen::Matrix3d::Zero();
    return coupledCompliance({{stiffness_, 1}}, i.point(), i.servedStiffness(), j.point(),
                             j.servedStiffness());
  }
  double largestNorm() {
    if (largestNorm_ == 0)
      for (int v = 0; v < stiffness_->mesh().vertexCount(); ++v)
        largestNorm_ = std::max(largestNorm_, stiffness_->haptic(v).operatorNorm());
    return largestNorm_;
  }

  std::shared_ptr<const SurfaceStiffness> stiffness_;
  double largestNorm_ = 0;
  Places last_;
};

/// The measure of stiffnesses, each of which points feel each other by.
class PointsTogetherBy : public testing::TestWithParam<DisplacementMeasure> {};

/// At vertices the stiffness is exact, and so the two patches are where they are held.
TEST(PointsTogether, HoldTheirPatchesWhereTheyAre) {
  const auto& stiffness = sphereStiffness();
  const Places at = {vertexNearestTo({0, 0, 1}), vertexNearestTo({0.7, 0.1, 0.7})};
  Probes probes(stiffness, 2, 50);
  probes.step({1.1 * at[0], 1.1 * at[1]});
  // Each enters at its vertex as long as the other does not press.
  constexpr double touching = 1 - 1e-9;
  probes.move({touching * at[0], 1.1 * at[1]}, 100);
  probes.move({touching * at[0], touching * at[1]}, 100);
  probes.move({0.9 * at[0], 0.95 * at[1]}, 200);
  probes.move({0.9 * at[0], 0.95 * at[1] + Eigen::Vector3d(0, 0.02, 0)}, 200);
  EXPECT_LE(probes.certificate.residual, PointTouch::kTolerance);
  Eigen::Matrix3Xd displacement, traction,
      sum = Eigen::Matrix3Xd::Zero(3, sphere().mesh->vertexCount());
  for (int i = 0; i < 2; ++i) {
    PointContact(stiffness, probes.point(i)).deform(probes.force(i), displacement, traction);
    sum += displacement;
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_LE((probes.touch.contact(i).staticPoint() - at[i]).norm(), 1e-8);
    const Eigen::Vector3d asked = probes.displacement(i);
    EXPECT_LE((meanUnderMask(*stiffness, probes.point(i), sum) - asked).norm(),
              1e-6 * asked.norm());
    // Each alone would be pressed by much more than that.
    const Eigen::Vector3d alone =
        stiffness->hapticAt(probes.point(i).triangle, probes.point(i).barycentric) * asked;
    EXPECT_GT((alone - probes.force(i)).norm(), 0.05 * alone.norm());
  }
}

TEST_P(PointsTogetherBy, AgreeWithADenseSolveOfAllBlocks) {
  const auto& stiffness = sphereStiffness(GetParam());
  for (const int count : {2, 3, 5}) {
    Probes probes(stiffness, count, 50);
    Places out, in;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d way =
          Eigen::Vector3d(std::cos(1.2 * i), std::sin(1.2 * i), 0.4 + 0.1 * i).normalized();
      out.push_back(1.1 * way);
      in.push_back((0.97 - 0.02 * i) * way);
    }
    probes.step(out);
    probes.move(in, 200);
    probes.move(in, 20);
    Eigen::MatrixXd compliance(3 * count, 3 * count);
    Eigen::VectorXd asked(3 * count), served(3 * count);
    for (int i = 0; i < count; ++i) {
      asked.segment<3>(3 * i) = probes.displacement(i);
      served.segment<3>(3 * i) = probes.force(i);
      for (int j = 0; j < count; ++j)
        compliance.block<3, 3>(3 * i, 3 * j) =
            i == j ? Eigen::Matrix3d(probes.touch.contact(i).servedStiffness().inverse())
                   : coupledCompliance({{stiffness, 1}}, probes.point(i),
                                       probes.touch.contact(i).servedStiffness(), probes.point(j),
                                       probes.touch.contact(j).servedStiffness());
    }
    const Eigen::VectorXd solved = compliance.partialPivLu().solve(asked);
    EXPECT_LE((served - solved).norm(), 1e-6 * solved.norm()) << count;
    EXPECT_LE(probes.certificate.residual, PointTouch::kTolerance);
    RecordProperty("sweeps", probes.sweeps);
    EXPECT_LE(probes.sweeps, PointTouch::kMostSweeps);
    for (int i = 0; i < count; ++i) EXPECT_GT(probes.force(i).norm(), 0);
  }
}

/// Both stick: there is one energy.
TEST_P(PointsTogetherBy, WhileTheyStickGiveBackAllOfTheirWork) {
  Probes probes(sphereStiffness(GetParam()), 2, 50);
  const Places out = {{0, 0, 1.1}, {0.5, 0, 1.1}}, in = {{0, 0, 0.93}, {0.48, 0, 0.8}};
  probes.step(out);
  probes.move(in, 200);
  const double before = probes.work;
  double largest = 0;
  for (int t = 0; t <= 400; ++t) {
    const double a = t * std::acos(-1.) / 200;
    const Eigen::Vector3d one(0.02 * std::sin(a), 0.02 * (1 - std::cos(a)), -0.01 * std::sin(a)),
        other(0.02 * std::sin(2 * a), 0.01 * std::sin(a), 0.02 * (std::cos(a) - 1));
    probes.step({in[0] + one, in[1] + other});
    largest = std::max(largest, std::abs(probes.work - before));
  }
  EXPECT_LE(std::abs(probes.work - before), 1e-7 * largest);
  EXPECT_GT(largest, 0);
}

TEST_P(PointsTogetherBy, GiveBackNoMoreThanIsStatedWhenTheySlide) {
  for (const double friction : {0., 0.3}) {
    Probes probes(sphereStiffness(GetParam()), 2, friction);
    const Places out = {{0, 0, 1.15}, {0.5, 0, 1.1}};
    probes.step(out);
    probes.move({{0, 0, 0.93}, {0.45, 0.1, 0.82}}, 200);
    probes.move({{-0.2, 0.2, 0.9}, {0.45, 0.1, 0.82}}, 300);
    probes.move({{-0.2, -0.2, 0.9}, {0.35, 0.3, 0.8}}, 300);
    probes.move({{0, 0, 0.93}, {0.45, 0.1, 0.82}}, 300);
    probes.move(out, 200);
    probes.move(out, 300);
    EXPECT_EQ(probes.force(0), Eigen::Vector3d::Zero());
    EXPECT_EQ(probes.force(1), Eigen::Vector3d::Zero());
    EXPECT_GE(probes.work, -probes.mayGiveBack - 1e-9 * probes.throughput);
    EXPECT_LE(probes.mayGiveBack, 0.4 * probes.throughput) << "else it says nothing";
    RecordProperty("friction " + std::to_string(friction),
                   std::to_string(probes.work / probes.throughput) + " bound " +
                       std::to_string(probes.mayGiveBack / probes.throughput));
    EXPECT_LE(probes.sweeps, PointTouch::kMostSweeps);
  }
}

TEST(PointsTogether, FarApartFeelNothing) {
  const Shape shape = box({6, 1, 1}, {12, 2, 2});
  const TouchedBody bar = touchedBody(
      shape, fixedWhere(shape, [](const auto& x) { return std::abs(x.x() - 3) < 1.6; }), true);
  const auto stiffness = stiffnessOf(bar, 1);
  const Places out = {{0.8, 0.4, 1.1}, {5.2, 0.6, 1.1}}, in = {{0.8, 0.4, 0.9}, {5.2, 0.6, 0.95}};
  Probes both(stiffness, 2, 0.3);
  both.step(out);
  both.move(in, 200);
  for (int i = 0; i < 2; ++i) {
    Probes alone(stiffness, 1, 0.3);
    alone.step({out[i]});
    alone.move({in[i]}, 200);
    EXPECT_GT(alone.force(0).norm(), 0);
    EXPECT_LE((alone.force(0) - both.force(i)).norm(), 5e-3 * alone.force(0).norm());
    EXPECT_NE(alone.force(0), both.force(i)) << "they do, if little";
  }
}

/// What one has pressed away, another does not reach; and when the first goes, it does.
TEST(PointsTogether, DoNotTouchWhatAnotherHasPressedAway) {
  const auto& stiffness = sphereStiffness();
  Probes probes(stiffness, 2, 0.3);
  const Eigen::Vector3d beside(0.18, 0, 0.97);
  probes.step({{0, 0, 1.1}, {0.18, 0, 1.1}});
  probes.move({{0, 0, 0.8}, {0.18, 0, 1.1}}, 200);
  probes.move({{0, 0, 0.8}, beside}, 200);
  for (int t = 0; t < 100; ++t) {
    probes.step({{0, 0, 0.8}, beside});
    EXPECT_EQ(probes.force(1), Eigen::Vector3d::Zero());
  }
  EXPECT_GT(probes.force(0).norm(), 0);
  probes.move({{0, 0, 1.1}, beside}, 400);
  EXPECT_GT(probes.force(1).norm(), 0);
  Probes alone(stiffness, 1, 0.3);
  alone.step({{0.18, 0, 1.1}});
  alone.move({beside}, 200);
  EXPECT_GT(alone.force(0).norm(), 0);
}

TEST_P(PointsTogetherBy, PullTogetherWithTheirButtons) {
  const auto& stiffness = sphereStiffness(GetParam());
  Probes probes(stiffness, 2, 0.3);
  const Places out = {{0, 0, 1.1}, {0.4, 0, 1.05}}, in = {{0, 0, 0.95}, {0.36, 0, 0.85}};
  probes.step(out);
  probes.move(in, 100);
  probes.move(out, 200, PointTouch::kAdheres);
  for (int i = 0; i < 2; ++i) EXPECT_GT(probes.force(i).z(), 0) << "on the body";
  // Each lifts the other's patch: it takes less than alone.
  Probes alone(stiffness, 1, 0.3);
  alone.step({out[0]});
  alone.move({in[0]}, 100);
  alone.move({out[0]}, 200, PointTouch::kAdheres);
  EXPECT_LT(probes.force(0).z(), alone.force(0).z());
  probes.move(out, 400);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(probes.force(i), Eigen::Vector3d::Zero());
}

TEST_P(PointsTogetherBy, StayFiniteAndInBoundsWhereverTheyGo) {
  const auto& stiffness = sphereStiffness(GetParam());
  Probes probes(stiffness, 3, 0.4);
  for (int t = 0; t < 1500; ++t) {
    Places places;
    for (int i = 0; i < 3; ++i)
      places.push_back((0.95 + 0.15 * std::sin(0.017 * t + i)) *
                       Eigen::Vector3d(0.4 * std::sin(0.011 * t + 0.5 * i),
                                       0.4 * std::cos(0.013 * t * (i + 1)), 0.9)
                           .normalized());
    probes.step(places, t % 400 > 350);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(probes.force(i).allFinite());
    EXPECT_LE(probes.certificate.iterations, PointTouch::kMostSweeps);
  }
  RecordProperty("most sweeps", probes.sweeps);
}

/// Two that press at one place share what one would bear, as near as definiteness lets them.
TEST_P(PointsTogetherBy, AtOnePlaceBearTogetherWhatOneBears) {
  const auto& stiffness = sphereStiffness(GetParam());
  const Eigen::Vector3d out(0.1, 0.2, 1.1), in(0.08, 0.16, 0.88);
  Probes alone(stiffness, 1, 0.3), both(stiffness, 2, 0.3);
  alone.step({out});
  alone.move({in}, 200);
  both.step({out, out});
  both.move({in, in}, 200);
  both.move({in, in}, 50);
  const Eigen::Vector3d sum = both.force(0) + both.force(1), one = alone.force(0);
  EXPECT_LE((both.force(0) - both.force(1)).norm(), 1e-3 * one.norm());
  EXPECT_LE((sum - one).norm(), 0.03 * one.norm());
  EXPECT_NEAR(sum.norm() / one.norm(), 2 / (1 + PointCoupling::kLargestShare), 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Measures, PointsTogetherBy,
                         testing::Values(DisplacementMeasure::Mean, DisplacementMeasure::Vertex),
                         [](const auto& measure) {
                           return measure.param == DisplacementMeasure::Mean ? "Mean" : "Vertex";
                         });

TEST(PointsTogether, GoOverToAnotherStiffnessWithoutAJump) {
  const auto& stiffness = sphereStiffness();
  const auto other = stiffnessOf(sphere(), 2.5);
  Probes probes(stiffness, 2, 50);
  const Places in = {{0, 0, 0.93}, {0.48, 0, 0.8}};
  probes.step({{0, 0, 1.1}, {0.5, 0, 1.1}});
  probes.move(in, 200);
  const Eigen::Vector3d before = probes.force(0);
  probes.touch.setStiffness(other);
  Eigen::Vector3d last = before;
  double jump = 0;
  const ToolPose poses[2] = {{in[0]}, {in[1]}};
  Wrench wrenches[2];
  for (int t = 0; t < 2 * SlidingContact::kBlendTicks; ++t) {
    probes.touch.step(poses, wrenches);
    jump = std::max(jump, (probes.force(0) - last).norm());
    last = probes.force(0);
  }
  EXPECT_GT((last - before).norm(), 1e-2 * before.norm());
  EXPECT_LE(jump, 5 * (last - before).norm() / SlidingContact::kBlendTicks);
}

TEST(PointsTogether, DoNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  PointTouch touch(sphereStiffness(), 3, 0.3);
  Wrench wrenches[3];
  const long before = allocationCount();
  for (int t = 0; t < 600; ++t) {
    ToolPose poses[3];
    for (int i = 0; i < 3; ++i)
      poses[i].position = {0.3 * i + 0.2 * std::sin(0.01 * t), 0.1 * i,
                           1 - 0.2 * std::sin(0.01 * t)};
    touch.step(poses, wrenches);
  }
  EXPECT_EQ(allocationCount(), before);
}

}  // namespace
}  // namespace palpate::test
