// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/probed_touch.h"

#include <gtest/gtest.h>

#include "bem/interior_probes.h"
#include "greens/surface_fields.h"
#include "haptics/touch_session.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

const Eigen::Vector3d kUnderTheTop(0.1, -0.05, 0.6), kMiddle(0, 0, 0);

struct Probed {
  TouchedBody body = touchedSphere(2, true);
  ElasticModel model{body.mesh, body.greens->info().material, body.greens->info().conditions,
                     Eigen::VectorXi::Zero(body.mesh->triangleCount())};
  Eigen::Matrix3Xd points;
  std::shared_ptr<const ProbeRows> rows;

  Probed() : points(3, 2) {
    points << kUnderTheTop, kMiddle;
    rows = std::make_shared<const ProbeRows>(probeRows(*body.greens, model, points));
  }
  TouchSession session(const std::string& effects, const std::string& tool) const {
    SceneBody sceneBody{body.greens, body.mesh};
    sceneBody.probeRows = rows;
    return TouchSession(
        parseScene("{\"models\": [{\"file\": \"sphere\"}], \"tools\": [{" + tool +
                   ", \"device\": \"d\"}], \"devices\": [{\"name\": \"d\", \"type\": "
                   "\"scripted\", \"file\": \"m\"}], \"effects\": {" +
                   effects + "}}"),
        {sceneBody});
  }
};

const std::string kPlaces =
    "\"probes\": [{\"name\": \"near\", \"inside\": [0.1, -0.05, 0.6], \"von_mises_limit\": 0.02}, "
    "{\"name\": \"top\", \"node\": 0}, "
    "{\"name\": \"middle\", \"inside\": [0, 0, 0], \"gradient_limit\": 9}]";
const std::string kPoint = "\"shape\": \"point\"";
const std::string kBall = "\"shape\": \"sphere\", \"radius\": 0.3";

TEST(ProbeRows, GiveWhatTheSurfacesWholeSolutionGives) {
  const Probed probed;
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, probed.body.greens->nodeCount());
  const std::vector<int> free = probed.model.conditions().freeNodes();
  ProbeValues values[2] = {ProbeValues::Zero(), ProbeValues::Zero()};
  for (std::size_t i = 0; i < free.size(); i += 7) {
    given.col(free[i]) = Eigen::Vector3d(0.01 * i, 1, -0.5);
    for (int point = 0; point < 2; ++point)
      probed.rows->accumulate(point, free[i], given.col(free[i]), values[point]);
  }
  Eigen::Matrix3Xd displacement = solveReferenceProblem(*probed.body.greens, given),
                   traction = given;
  for (int node : probed.model.conditions().fixedNodes()) {
    traction.col(node) = displacement.col(node);
    displacement.col(node).setZero();
  }
  const auto fields = InteriorProbes(probed.model, probed.points).evaluate(displacement, traction);
  for (int point = 0; point < 2; ++point) {
    const ProbedField field = fieldOf(values[point], probed.rows->stiffness(point));
    EXPECT_LT((field.displacement - fields[point].displacement).norm(),
              1e-12 * fields[point].displacement.norm());
    EXPECT_LT((field.gradient - fields[point].gradient).norm(),
              1e-12 * fields[point].gradient.norm());
    EXPECT_LT((field.stress - fields[point].stress).norm(), 1e-11 * fields[point].stress.norm());
  }
}

TEST(ProbedTouches, ReadWhatTheContactDoesInsideAndKeepTheLargest) {
  const Probed probed;
  for (const std::string& tool : {kPoint, kBall})
    for (double scale : {1., 4.}) {
      TouchSession session =
          probed.session(kPlaces + ", \"stiffness_scale\": " + std::to_string(scale), tool);
      ContactSnapshot snapshot = session.model()->makeSnapshot();
      ASSERT_EQ(snapshot.probes.size(), 2u);
      const double touching = tool == kPoint ? 1 : 1.3;
      double largest = 0;
      std::int64_t exceeded = -1;
      ToolPose pose;
      Wrench wrench;
      for (int tick = 0; tick < 80; ++tick) {
        const double depth = 0.15 * std::min(tick, 79 - tick) / 40. - 0.01;
        pose.position = {0, 0, touching - depth};
        const long before = allocationCount();
        session.model()->step(&pose, &wrench);
        session.model()->fill(snapshot);
        EXPECT_EQ(allocationCount(), before);
        largest = std::max(largest, snapshot.probes[0].vonMises);
        if (exceeded < 0 && snapshot.probes[0].vonMises > 0.02) exceeded = tick;
        if (tick != 40) continue;
        session.computeFrame(snapshot);
        EXPECT_EQ(session.probeDisplacements().cols(), 3);
        EXPECT_EQ(session.probeDisplacements().col(0), snapshot.probes[0].displacement);
        EXPECT_EQ(session.probeDisplacements().col(1), session.displacement(0).col(0));
        // By the surface's deformation and tractions, whatever the scale of the forces.
        const SnapshotTractions loads =
            snapshotTractions(*probed.body.greens, snapshot, 0, Eigen::Matrix3d::Identity(), scale);
        Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, probed.body.greens->nodeCount());
        for (std::size_t i = 0; i < loads.nodes.size(); ++i)
          given.col(loads.nodes[i]) = loads.values.segment<3>(3 * i);
        Eigen::Matrix3Xd displacement = solveReferenceProblem(*probed.body.greens, given),
                         traction = given;
        for (int node : probed.model.conditions().fixedNodes()) {
          traction.col(node) = displacement.col(node);
          displacement.col(node).setZero();
        }
        const ProbedField field =
            InteriorProbes(probed.model, probed.points).evaluate(displacement, traction)[0];
        EXPECT_NEAR(snapshot.probes[0].vonMises, vonMisesStress(field.stress),
                    1e-9 * vonMisesStress(field.stress));
        EXPECT_NEAR(snapshot.probes[0].gradient, spectralNorm(field.gradient),
                    1e-9 * spectralNorm(field.gradient));
      }
      EXPECT_GT(largest, 0.02);
      EXPECT_EQ(snapshot.probes[0].largestVonMises, largest);
      EXPECT_LT(snapshot.probes[0].vonMises, largest);
      EXPECT_EQ(snapshot.probes[0].exceededTick, exceeded);
      EXPECT_EQ(snapshot.probes[1].exceededTick, -1);
      EXPECT_GT(snapshot.probes[1].largestGradient, 0);
    }
}

TEST(ProbedTouches, CostNothingWhereNoneIsAskedFor) {
  const Probed probed;
  TouchSession session = probed.session("", kBall);
  EXPECT_EQ(session.model().get(), &session.contact());
  EXPECT_TRUE(session.model()->makeSnapshot().probes.empty());
}

TEST(ProbedTouches, RefuseProbesWithoutRowsAndRowsOfAnotherBody) {
  Probed probed;
  EXPECT_TRUE(isRefused(
      [&] {
        probed.rows = nullptr;
        probed.session(kPlaces, kBall);
      },
      "of which there are no rows"));
  EXPECT_TRUE(isRefused(
      [] { ProbeRows(Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(12, 3), {Matrix6d::Zero()}); },
      "not 12 by 3"));
  EXPECT_TRUE(isRefused(
      [&] {
        probed.rows = std::make_shared<const ProbeRows>(probed.points, Eigen::MatrixXd::Zero(26, 3),
                                                        std::vector<Matrix6d>(2, Matrix6d::Zero()));
        probed.session(kPlaces, kBall);
      },
      "rows of 2 probes and 1 nodes"));
  EXPECT_TRUE(
      isRefused([&] { probeRows(*probed.body.greens, probed.model, Eigen::Vector3d(0, 0, 2)); },
                "is not inside the material"));
}

}  // namespace
}  // namespace palpate::test
