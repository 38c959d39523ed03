// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/point_coupling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>

#include "contact/point_contact.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "greens/counting_greens.h"
#include "support/point_masks.h"

namespace palpate::test {
namespace {

class PointCouplings : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    body_ = new TouchedBody(touchedSphere(2, true));
    stiffness_ = maskedStiffness(*body_, 2);
  }
  static void TearDownTestSuite() {
    stiffness_.reset();
    delete body_;
  }
  static SurfacePoint nearestTo(const Eigen::Vector3d& place) {
    return nearestSurfacePoint(*body_->mesh, place);
  }
  static void put(PointCoupling& coupling, int point, const SurfacePoint& place,
                  const SurfaceStiffness& stiffness = *stiffness_) {
    coupling.place(point, place, servedAt(place, stiffness));
  }
  static Eigen::Matrix3d servedAt(const SurfacePoint& place,
                                  const SurfaceStiffness& stiffness = *stiffness_) {
    return stiffness.hapticAt(place.triangle, place.barycentric);
  }
  static TouchedBody* body_;
  static std::shared_ptr<const SurfaceStiffness> stiffness_;
};
TouchedBody* PointCouplings::body_ = nullptr;
std::shared_ptr<const SurfaceStiffness> PointCouplings::stiffness_;

TEST_F(PointCouplings, AreWhatIsStatedOfMasksAndGreensFunctions) {
  const SurfacePoint a = nearestTo({0.1, 0.2, 1}), b = nearestTo({1, 0.3, 0.3});
  const SurfacePoint low = nearestTo({0.3, -1, -0.55});  // a corner is fixed
  PointCoupling coupling(*stiffness_, 3);
  put(coupling, 0, a);
  put(coupling, 1, b);
  put(coupling, 2, low);
  const SurfacePoint points[] = {a, b, low};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      const Eigen::Matrix3d dense = coupledCompliance(
          {{stiffness_, 1}}, points[i], servedAt(points[i]), points[j], servedAt(points[j]));
      EXPECT_LE((coupling.block(i, j) - dense).norm(), 1e-12 * dense.norm()) << i << ", " << j;
      EXPECT_EQ(coupling.block(i, j), Eigen::Matrix3d(coupling.block(j, i).transpose()));
    }
  Eigen::VectorXd forces(9);
  forces << 1, 2, 3, -1, 0, 4, 2, 2, 2;
  const Eigen::Vector3d sum =
      coupling.block(0, 1) * forces.segment<3>(3) + coupling.block(0, 2) * forces.segment<3>(6);
  EXPECT_LE((coupling.shift(0, forces) - sum).norm(), 1e-15);
  coupling.remove(2);
  EXPECT_LE((coupling.shift(0, forces) - coupling.block(0, 1) * forces.segment<3>(3)).norm(),
            1e-15);
}

TEST_F(PointCouplings, AlongAWayAreWhatTheyAreAfresh) {
  PointCoupling walked(*stiffness_, 2);
  put(walked, 1, nearestTo({0, 1, 0.4}));
  for (int step = 0; step <= 60; ++step) {
    const SurfacePoint here = nearestTo({std::sin(0.03 * step), 0.1, std::cos(0.03 * step)});
    put(walked, 0, here);
    PointCoupling fresh(*stiffness_, 2);
    put(fresh, 1, nearestTo({0, 1, 0.4}));
    put(fresh, 0, here);
    EXPECT_EQ(walked.block(0, 1), fresh.block(0, 1)) << step;
  }
}

TEST_F(PointCouplings, GatherWhatIsNewAndNothingElse) {
  const auto counting = std::make_shared<CountingGreens>(body_->greens);
  const auto stiffness = maskedStiffness({body_->mesh, counting}, 2);
  const SurfacePoint here = nearestTo({0.3, 0.2, 1});
  const auto& mesh = *body_->mesh;
  PointCoupling coupling(*stiffness, 2);
  put(coupling, 0, here);
  counting->clearCounts();
  coupling.shift(0, Eigen::VectorXd::Ones(6));
  EXPECT_EQ(counting->counts().calls, 0) << "one alone";
  put(coupling, 1, nearestTo({1, 0.1, 0}));
  coupling.shift(0, Eigen::VectorXd::Zero(6));
  EXPECT_EQ(counting->counts().calls, 0) << "without a force";
  coupling.block(0, 1);
  const double all = counting->counts().gatheredBlocks;
  EXPECT_GT(all, 0);
  put(coupling, 0, {here.triangle, {0.2, 0.3, 0.5}});
  coupling.block(0, 1);
  EXPECT_EQ(counting->counts().gatheredBlocks, all) << "within the triangle";
  // Over an edge one corner is new.
  int next = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    int shared = 0;
    for (int k = 0; k < 3; ++k)
      shared += (mesh.triangles().col(f).array() == mesh.triangles()(k, here.triangle)).any();
    if (shared == 2) next = f;
  }
  put(coupling, 0, {next, {0.2, 0.3, 0.5}});
  coupling.block(0, 1);
  const double more = counting->counts().gatheredBlocks - all;
  EXPECT_GT(more, 0);
  EXPECT_LT(more, 0.5 * all);
}

/// Least eigenvalue of the compliance of all, relative to the points' own.
double definiteness(PointCoupling& coupling, const std::vector<SurfacePoint>& points,
                    const SurfaceStiffness& stiffness) {
  const int count = static_cast<int>(points.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(3 * count, 3 * count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      if (i == j) continue;
      const Eigen::LLT<Eigen::Matrix3d> left(
          stiffness.hapticAt(points[i].triangle, points[i].barycentric)),
          right(stiffness.hapticAt(points[j].triangle, points[j].barycentric));
      all.block<3, 3>(3 * i, 3 * j) =
          Eigen::Matrix3d(left.matrixU()) * coupling.block(i, j) * Eigen::Matrix3d(right.matrixL());
    }
  return all.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
}

TEST_F(PointCouplings, StayPositiveDefiniteAndAreLoweredForNothingElse) {
  const SurfacePoint here = nearestTo({0.3, 0.2, 1}), away = nearestTo({0.9, 0.2, 0.4});
  PointCoupling coupling(*stiffness_, 2);
  put(coupling, 0, here);
  put(coupling, 1, away);
  coupling.limit();
  const Eigen::Matrix3d dense =
      coupledCompliance({{stiffness_, 1}}, here, servedAt(here), away, servedAt(away));
  EXPECT_LE((coupling.block(0, 1) - dense).norm(), 1e-12 * dense.norm());
  EXPECT_GT(definiteness(coupling, {here, away}, *stiffness_), 1 - PointCoupling::kLargestShare);
  // In one place, and a third and a fourth as well.
  put(coupling, 1, here);
  coupling.limit();
  EXPECT_GE(definiteness(coupling, {here, here}, *stiffness_),
            1 - PointCoupling::kLargestShare - 1e-9);
  PointCoupling many(*stiffness_, 4);
  for (int i = 0; i < 4; ++i) put(many, i, here);
  many.limit();
  EXPECT_GE(definiteness(many, {here, here, here, here}, *stiffness_),
            1 - PointCoupling::kLargestShare - 1e-9);
}

TEST_F(PointCouplings, GoOverToAnotherStiffnessBySharesOfBoth) {
  const auto wide = maskedStiffness(*body_, 3);
  const SurfacePoint a = nearestTo({0.1, 0.2, 1}), b = nearestTo({1, 0.3, 0.3});
  PointCoupling coupling(*stiffness_, 2);
  put(coupling, 0, a);
  put(coupling, 1, b);
  const Eigen::Matrix3d before = coupling.block(0, 1);
  coupling.setStiffness(*wide);
  EXPECT_EQ(coupling.block(0, 1), before);
  for (double share : {0.25, 1.0}) {
    const auto served = [&](const SurfacePoint& place) -> Eigen::Matrix3d {
      return share * servedAt(place, *wide) + (1 - share) * servedAt(place);
    };
    coupling.setShare(share);
    coupling.place(0, a, served(a));
    coupling.place(1, b, served(b));
    const Eigen::Matrix3d stated =
        coupledCompliance({{wide, share}, {stiffness_, 1 - share}}, a, served(a), b, served(b));
    EXPECT_LE((coupling.block(0, 1) - stated).norm(), 1e-12 * before.norm()) << share;
    EXPECT_GT((coupling.block(0, 1) - before).norm(), 1e-3 * before.norm()) << share;
  }
}

/// How far the displacement of one vertex under the mask of another, which stiffnesses are by, is
/// from what points feel, at the vertices of a line from one.
TEST_F(PointCouplings, AreNearToTheDisplacementsThatStiffnessesAreBy) {
  const TouchedBody fine = touchedSphere(3, true);
  const auto stiffness = maskedStiffness(fine, 3);
  const auto atVertex = [&](int vertex) {
    for (int f = 0; f < fine.mesh->triangleCount(); ++f)
      for (int k = 0; k < 3; ++k)
        if (fine.mesh->triangles()(k, f) == vertex)
          return SurfacePoint{f, Eigen::Vector3d::Unit(k)};
    throw std::logic_error("no triangle");
  };
  const auto vertexNear = [&](double angle) {
    int nearest = 0;
    (fine.mesh->points().colwise() - Eigen::Vector3d(std::sin(angle), 0, std::cos(angle)))
        .colwise()
        .squaredNorm()
        .minCoeff(&nearest);
    return nearest;
  };
  const int top = vertexNear(0);
  const SurfacePoint first = atVertex(top);
  PointCoupling coupling(*stiffness, 2);
  put(coupling, 0, first, *stiffness);
  double worst = 0, worstMean = 0;
  for (double angle = 0; angle < 0.9; angle += 0.1) {
    const int other = vertexNear(angle);
    const SurfacePoint second = atVertex(other);
    put(coupling, 1, second, *stiffness);
    Eigen::Matrix3d seen;
    Eigen::Matrix3Xd displacement, traction;
    for (int c = 0; c < 3; ++c) {
      PointContact(stiffness, second).deform(Eigen::Vector3d::Unit(c), displacement, traction);
      seen.col(c) = displacement.col(top);
    }
    const auto off = [&](const Eigen::Matrix3d& block) {
      return (block - seen).norm() / seen.norm();
    };
    worst = std::max(worst, off(coupling.block(0, 1)));
    worstMean = std::max(worstMean, off(meanCompliance(stiffness, first, second)));
  }
  EXPECT_LE(worst, 0.1);
  EXPECT_GE(worstMean, 2 * worst);
}

TEST_F(PointCouplings, DoNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  PointCoupling coupling(*stiffness_, 2);
  const SurfacePoint a = nearestTo({0.1, 0.2, 1}), b = nearestTo({1, 0.3, 0.3});
  const long before = allocationCount();
  put(coupling, 0, a);
  put(coupling, 1, b);
  coupling.block(0, 1);
  put(coupling, 0, b);  // in one place, where eigenvalues are asked for
  coupling.limit();
  put(coupling, 1, a);
  coupling.block(0, 1);
  coupling.setStiffness(*stiffness_);
  coupling.setShare(0.5);
  coupling.block(0, 1);
  EXPECT_EQ(allocationCount(), before);
}

}  // namespace
}  // namespace palpate::test
