// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/pressing_hand.h"

#include <gtest/gtest.h>

#include "contact/mesh_shape.h"
#include "contact/rigid_shape.h"
#include "support/contact_bodies.h"
#include "support/half_space.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

class PressingHands : public testing::Test {
 protected:
  PressPlan plan(const SceneTool& tool, const SurfaceMesh* mesh = nullptr) {
    return planPress(body_, tool, mesh, taken_);
  }
  /// Of the body's vertices from a tool at a place.
  double nearest(const RigidShape& shape, const Vector3d& place) const {
    double least = HUGE_VAL;
    for (const auto& x : body_.mesh->points().colwise())
      least = std::min(least, shape.proximity(x - place).distance);
    return least;
  }

  TouchedBody touched_ = touchedSphere(2, true);
  SceneBody body_{touched_.greens, touched_.mesh};
  std::vector<Vector3d> taken_;
};

/// A sphere's normals are those of its jittered facets: a vertex beside the place is a little
/// nearer.
TEST_F(PressingHands, JustTouchAtFirst) {
  const double close = 0.02 * body_.mesh->diagonal();
  SceneTool ball;
  ball.shape = ToolShape::Sphere;
  ball.radius = 0.3;
  EXPECT_NEAR(nearest(SphereShape(0.3), plan(ball).contact), 0, close);
  SceneTool rod = ball;
  rod.shape = ToolShape::Capsule;
  rod.length = 2;
  EXPECT_NEAR(nearest(CapsuleShape(Vector3d::Zero(), {0, 0, 2}, 0.3), plan(rod).contact), 0, close);
  SceneTool plane;
  plane.shape = ToolShape::Plane;
  EXPECT_NEAR(nearest(PlaneShape(), plan(plane).contact), 0, 1e-12);
  SceneTool tool;
  tool.shape = ToolShape::Mesh;
  const auto spoon = std::make_shared<const SurfaceMesh>(
      (0.2 * body_.mesh->points()).colwise() + Vector3d(1, 2, 3), body_.mesh->triangles());
  const Vector3d place = plan(tool, spoon.get()).contact;
  EXPECT_NEAR(nearest(MeshShape(spoon), place), 0, close);
}

TEST_F(PressingHands, AreFarFromTheSupportAndFromEachOther) {
  std::vector<Vector3d> places;
  for (int hand = 0; hand < 3; ++hand) {
    places.push_back(plan(SceneTool()).contact);
    EXPECT_GT(places.back().z(), -0.6);
    for (int other = 0; other < hand; ++other)
      EXPECT_GT((places[hand] - places[other]).norm(), 0.8);
  }
  EXPECT_GT(places[0].z(), 0.9);
}

/// Beyond its rim a half-space's surface cannot be touched.
TEST_F(PressingHands, PressAHalfSpaceFarFromItsRim) {
  const HalfSpace patch = halfSpace(plate(1, 6).moved({2, 3, 0}));
  const SceneBody body{patch.greens, patch.mesh};
  const auto points = patch.mesh->points();
  const Vector3d middle = (points.rowwise().minCoeff() + points.rowwise().maxCoeff()) / 2;
  const int first = farthestFreeVertex(body);
  EXPECT_LE((points.col(first) - middle).norm(), 1e-12);
  const Vector3d second = points.col(farthestFreeVertex(body, {points.col(first)}));
  EXPECT_GE((second - middle).norm(), patch.mesh->meanEdgeLength());
  EXPECT_LT((second - middle).cwiseAbs().maxCoeff(),
            (points.col(0) - middle).cwiseAbs().maxCoeff());
}

/// Wherever its origin is: here beyond one of its ends.
TEST_F(PressingHands, PressWhatNothingFixesFarFromItsMiddle) {
  int pressed[2];
  for (int moved : {0, 1}) {
    const Shape shape = box({1, 1, 3}, {1, 1, 3}).moved(moved * Vector3d(-4, 3, 9));
    const TouchedBody body =
        touchedBody(shape, std::vector<unsigned char>(shape.points.cols(), 0), true,
                    Domain::Exterior);  // as an unsupported one, it has no fixed vertex
    pressed[moved] = farthestFreeVertex({body.greens, body.mesh});
    const double height = body.mesh->points()(2, pressed[moved]) - 9 * moved;
    EXPECT_TRUE(height == 0 || height == 3) << height;
  }
  EXPECT_EQ(pressed[0], pressed[1]);
}

TEST_F(PressingHands, GoDownToTheirDepthAndBackWhereverTheDeviceLies) {
  SceneTool ball;
  ball.shape = ToolShape::Sphere;
  ball.radius = 0.3;
  const PressPlan press = plan(ball);
  WorkspaceMapping mapping;
  mapping.origin = {1, 2, 3};
  mapping.scale = 2;
  mapping.rotation = Eigen::AngleAxisd(1, Vector3d(1, 2, 3).normalized());
  const double period = 5e-4;
  const auto device = pressingDevice(press, mapping, period);
  double least = HUGE_VAL, most = -HUGE_VAL;
  DeviceState state;
  for (int tick = 0; tick < 4000; ++tick) {
    ASSERT_TRUE(device->read(state));
    const double height =
        (mapping.toScene(state.pose).position - press.contact).dot(press.outwards);
    if (tick == 0) {
      EXPECT_NEAR(height, press.clearance, 1e-12);
    }
    if (tick == 2000) {
      EXPECT_NEAR(height, -press.depth, 0.1 * press.depth);
    }
    least = std::min(least, height);
    most = std::max(most, height);
  }
  EXPECT_NEAR(least, -press.depth, 0.1 * press.depth);
  EXPECT_NEAR(most, press.clearance, 0.1 * press.clearance);
}

TEST_F(PressingHands, MoveNoHandAndPressNothingWithoutGreensFunctions) {
  SceneTool hand;
  hand.shape = ToolShape::Hand;
  EXPECT_TRUE(isRefused([&] { plan(hand); }, "a simulated device has no joints"));
  GreensFunctionsInfo info = touched_.greens->info();
  info.columnNodes.clear();
  const auto none = denseGreens(info, denseMatrix(*touched_.greens));
  EXPECT_TRUE(isRefused([&] { farthestFreeVertex({none, touched_.mesh}); }, "no free vertex with"));
}

}  // namespace
}  // namespace palpate::test
