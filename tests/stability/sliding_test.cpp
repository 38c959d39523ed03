// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Sliding over what meshes hold in store. WatchedContact checks every tick against the bound on the
// jump of force that SlidingContact states; what is asked here comes on top.

#include <gtest/gtest.h>

#include <numeric>

#include "haptics/point_touch.h"
#include "support/contact_bodies.h"
#include "support/synthetic_greens.h"
#include "support/watched_contact.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Unit sphere of meridians that meet at its poles, as many as are wanted.
Shape meridianSphere(int meridians, int rings) {
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ()};
  for (int r = 1; r <= rings; ++r)
    for (int m = 0; m < meridians; ++m) {
      const double a = kPi * r / (rings + 1), b = 2 * kPi * m / meridians;
      points.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  const auto at = [&](int r, int m) { return 2 + (r - 1) * meridians + m % meridians; };
  std::vector<Eigen::Vector3i> triangles;
  for (int m = 0; m < meridians; ++m) {
    triangles.emplace_back(0, at(1, m), at(1, m + 1));
    for (int r = 1; r < rings; ++r) {
      triangles.emplace_back(at(r, m), at(r + 1, m), at(r + 1, m + 1));
      triangles.emplace_back(at(r, m), at(r + 1, m + 1), at(r, m + 1));
    }
    triangles.emplace_back(1, at(rings, m + 1), at(rings, m));
  }
  return fromLists(points, triangles);
}

struct HardBody {
  const char* name;
  Shape shape;
  Place fixed;
  double rigid;  ///< k_Rigid over the default
};

void PrintTo(const HardBody& body, std::ostream* out) {
  *out << body.name;
}

std::vector<HardBody> hardBodies() {
  const auto base = [](const Eigen::Vector3d& x) { return x.z() < 1e-9; };
  const auto low = [](const Eigen::Vector3d& x) { return x.z() < -0.6; };
  const auto half = [](const Eigen::Vector3d& x) { return x.z() < 0.1; };
  return {
      {"cube", box({1, 1, 1}, {5, 5, 5}), base, 1},
      {"needles", boxWithNeedles(1e-6), base, 1},
      {"forty meridians", meridianSphere(40, 5), low, 1},
      {"jittered", jitteredSphere(2, 0.2), low, 1},
      {"stiff support", jitteredSphere(2, 0.2), half, 20},
      {"soft support", jitteredSphere(2, 0.2), half, 0.2},
      {"torus", torus(1, 0.4, 16, 9), [](const auto& x) { return x.x() < -1; }, 1},
      {"thin plate", box({1, 1, 0.1}, {6, 6, 1}), [](const auto& x) { return x.x() < 1e-9; }, 1}};
}

std::shared_ptr<const SurfaceStiffness> stiffnessOf(const HardBody& body) {
  const ElasticModel model = makeModel(body.shape, body.fixed, 1, 0.3);
  const auto mesh = body.shape.mesh();
  const auto stiffness = std::make_shared<SurfaceStiffness>(
      computeGreens(model, {}), mesh, MaskShape::Linear, 2 * mesh->meanEdgeLength());
  return stiffness->withRigidStiffness(body.rigid * stiffness->rigidStiffness());
}

class SlidingOver : public testing::TestWithParam<HardBody> {
 protected:
  void SetUp() override {
    stiffness_ = stiffnessOf(GetParam());
    edge_ = stiffness_->mesh().meanEdgeLength();
  }
  /// A place beside the surface, beyond a random point of it: below it by `depth` edges.
  Eigen::Vector3d beside(double depth) {
    const SurfaceMesh& mesh = stiffness_->mesh();
    const Eigen::Vector3d weights = randomVectors(1, random_).cwiseAbs();
    const int f = static_cast<int>(random_() % mesh.triangleCount());
    return placeOf(mesh, {f, weights / weights.sum()}) -
           depth * edge_ * mesh.triangleNormals().col(f);
  }
  std::shared_ptr<const SurfaceStiffness> stiffness_;
  double edge_;
  std::mt19937 random_{5};
};

TEST_P(SlidingOver, NeitherJumpsNorLosesTheSurfaceOnRandomWays) {
  const SurfaceLocator locator(stiffness_->sharedMesh());
  double largest = 0;
  int touching = 0, lost = 0;
  for (double mu : {0.0, 0.3, 1.0}) {
    WatchedContact contact(stiffness_, mu);
    contact.advance(beside(-2));
    for (int way = 0; way < 150; ++way) {
      // Slow and fast, shallow and deep, with a pull and a change of friction now and then.
      const double step = edge_ * std::pow(10, -3 + 0.25 * (way % 9));
      const double depth = 0.1 * double(random_() % 8) - 0.2;
      contact.contact.setAdhesion(way % 10 == 9);
      contact.contact.setFriction(way % 7 == 6 ? 0.1 : mu);
      Eigen::Vector3d to = beside(depth);
      to = contact.place() +
           (to - contact.place()) * std::min(1., 100 * step / (to - contact.place()).norm());
      contact.moveTo(to, step, [&] {
        touching += contact.contact.isTouching();
        const Eigen::Vector3d nearest = placeOf(locator.mesh(), locator.nearest(contact.place()));
        const bool isDeep =
            locator.isInside(contact.place()) && (nearest - contact.place()).norm() > 0.02 * edge_;
        lost += isDeep && !contact.contact.isTouching();
      });
    }
    largest = std::max(largest, contact.largestRatio);
  }
  EXPECT_EQ(lost, 0) << "times it was below the surface without a contact";
  EXPECT_GT(touching, 1000) << "there should be contact to speak of";
  EXPECT_GT(largest, 0.3) << "the bound should be near what happens";
}

TEST_P(SlidingOver, TracksAtOneDepthKeepTheContactPressing) {
  // Straight towards other places of the surface, always a fifth of an edge below it.
  const SurfaceWalk walk(stiffness_->sharedMesh());
  const SurfaceMesh& mesh = stiffness_->mesh();
  for (double mu : {0.0, 0.1}) {
    int pressed = 0, ticks = 0;
    for (int track = 0; track < 10; ++track) {
      const int f = static_cast<int>(random_() % mesh.triangleCount());
      SurfaceWalk::Walker walker{{f, Eigen::Vector3d::Constant(1. / 3)}, Eigen::Vector3d::Zero()};
      const auto below = [&](double depth) -> Eigen::Vector3d {
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
          normal += walker.point.barycentric[k] *
                    mesh.vertexNormals().col(mesh.triangles()(k, walker.point.triangle));
        return placeOf(mesh, walker.point) - depth * edge_ * normal.normalized();
      };
      WatchedContact contact(stiffness_, mu);
      contact.advance(below(-0.1));
      contact.moveTo(below(0.2), 0.005 * edge_);
      Eigen::Vector3d way = randomDirection(random_).cross(mesh.triangleNormals().col(f));
      for (int tick = 0; tick < 2000; ++tick) {
        walker = walk.start(walker.point, 0.005 * edge_ * way.normalized());
        while (!walker.hasArrived()) {
          way = walker.ahead;
          walk.step(walker);
        }
        contact.advance(below(0.2));
        ++ticks;
        // On its way out of where friction has held it at an edge, what is left of the force may
        // pull a little.
        pressed += contact.contact.isTouching() &&
                   contact.pressing() >= -0.05 * contact.contact.force().norm();
      }
    }
    EXPECT_EQ(pressed, ticks) << "mu " << mu;
  }
}

INSTANTIATE_TEST_SUITE_P(HardBodies, SlidingOver, testing::ValuesIn(hardBodies()),
                         [](const auto& body) {
                           std::string name = body.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(SlidingOverACubesEdge, ChangesTheForceByLessThanATwentiethATick) {
  // 0.1 m/s at 1 kHz over the edge of a cube of 10 cm, masks of two edges of 2 cm.
  const Shape cube = box({0.1, 0.1, 0.1}, {5, 5, 5});
  const HardBody body{"cube", cube, [](const Eigen::Vector3d& x) { return x.z() < 1e-9; }, 1};
  const auto stiffness = stiffnessOf(body);
  for (double mu : {0.0, 0.2, 0.5})
    for (double y : {0.05, 0.047})
      for (double depth : {0.002, 0.005, 0.01}) {
        WatchedContact contact(stiffness, mu);
        contact.advance({0.05, y, 0.11});
        contact.moveTo({0.05, y, 0.1 - depth}, 1e-4);
        double worst = 0;
        const auto visit = [&] {
          worst = std::max(worst, contact.jump / contact.contact.force().norm());
          EXPECT_TRUE(contact.contact.isTouching());
          EXPECT_GT(contact.pressing(), 0);
        };
        // Along the top, round the edge at the same depth, down the side.
        contact.moveTo({0.1 - depth, y, 0.1 - depth}, 1e-4, visit);
        contact.moveTo({0.1 - depth, y, 0.05}, 1e-4, visit);
        // At 2 mm a step is 5 % of the depth, and a spring's force changes by as much.
        EXPECT_LE(worst, depth > 0.002 ? 0.05 : 0.06) << mu << " " << depth;
        if (mu == 0) {
          EXPECT_NEAR(contact.contact.staticPoint().x(), 0.1, 1e-12) << "it has gone round";
        }
        RecordProperty("worst" + std::to_string(mu) + "_" + std::to_string(depth),
                       std::to_string(worst));
      }
}

/// Pressed in by up to 1.5 edges, and ten times as fast: the contact point lags behind for up to
/// 150 ticks while the force turns, but always goes on, so that nothing need end the force.
TEST(SlidingOverACubesEdge, GoesOnHoweverDeepAndFast) {
  const Shape cube = box({0.1, 0.1, 0.1}, {5, 5, 5});
  const HardBody body{"cube", cube, [](const Eigen::Vector3d& x) { return x.z() < 1e-9; }, 1};
  const auto stiffness = stiffnessOf(body);
  int mostHeld = 0;
  for (double mu : {0.0, 0.3, 0.8})
    for (double depth : {0.002, 0.005, 0.01, 0.015, 0.02, 0.03})
      for (double speed : {0.1, 0.3, 1.0}) {
        PointTouch touch(stiffness, 1, mu);
        const SlidingContact& contact = touch.contact(0);
        Eigen::Vector3d place(0.05, 0.047, 0.11), before = Eigen::Vector3d::Zero();
        int held = 0, heldBack = 0;
        double worst = 0;
        const auto moveTo = [&](const Eigen::Vector3d& to, double step) {
          const Eigen::Vector3d from = place;
          const int count = static_cast<int>(std::ceil((to - from).norm() / step));
          for (int i = 1; i <= count; ++i) {
            place = from + double(i) / count * (to - from);
            ToolPose pose;
            pose.position = place;
            Wrench wrench;
            heldBack += touch.step(&pose, &wrench).heldBack;
            held += contact.wasHeldBack();
            worst = std::max(worst, (contact.force() - before).norm() / contact.force().norm());
            before = contact.force();
          }
        };
        moveTo({0.05, 0.047, 0.1 - depth}, 1e-4);
        held = 0;
        worst = 0;
        for (const Eigen::Vector3d& to : {Eigen::Vector3d(0.1 - depth, 0.047, 0.1 - depth),
                                          Eigen::Vector3d(0.1 - depth, 0.047, 0.05)}) {
          moveTo(to, speed * 1e-3);
          EXPECT_TRUE(contact.isTouching()) << mu << ' ' << depth << ' ' << speed;
          EXPECT_LT(contact.normal().dot(contact.force()), 0);
        }
        EXPECT_EQ(heldBack, 0) << mu << ' ' << depth << ' ' << speed;
        EXPECT_TRUE(speed > 0.1 || depth < 0.005 || worst <= 0.05) << worst;
        mostHeld = std::max(mostHeld, held);
      }
  EXPECT_GE(mostHeld, 20) << "it was held back for longer than ForceSafety bears";
}

class EnergyOf : public testing::TestWithParam<bool> {};

TEST_P(EnergyOf, ClosedWaysIsGivenBackWithinItsBound) {
  const Shape shape = GetParam() ? jitteredSphere(2, 0.2) : icosphere(2);
  const HardBody body{"", shape, [](const Eigen::Vector3d& x) { return x.z() < -0.6; }, 1};
  const auto stiffness = stiffnessOf(body);
  std::mt19937 random(9);
  const double step = 2e-3, largest = std::sqrt(3.0) * stiffness->rigidStiffness();
  double mostGiven = 0, mostOfBound = 0, relative = 0;
  for (double mu : {0.0, 0.1, 0.5})
    for (int loop = 0; loop < 40; ++loop) {
      // In at one place, below the surface to others, out at the last, and home outside.
      WatchedContact contact(stiffness, mu);
      Eigen::Vector3d direction = randomDirection(random);
      if (direction.z() < 0) direction.z() *= -1;
      const Eigen::Vector3d home = 1.2 * direction;
      contact.advance(home);
      const auto along = [&](double radius) {
        Eigen::Vector3d next = direction + 0.5 * randomDirection(random);
        if (next.z() < -0.2) next.z() = 0.2;
        next.normalize();
        for (double t = 0; t <= 1; t += 0.01)
          contact.moveTo(radius * ((1 - t) * direction + t * next).normalized(), step);
        direction = next;
      };
      const double depth = 0.02 + 0.04 * (loop % 4);
      contact.moveTo((1 - depth) * direction, step);
      for (int leg = 0; leg < 3; ++leg) along(1 - depth);
      contact.moveTo(1.2 * direction, step);
      for (int tick = 0; tick < 300; ++tick) contact.advance(contact.place());
      EXPECT_EQ(contact.contact.force(), Eigen::Vector3d::Zero());
      contact.moveTo(1.2 * home, step);
      contact.moveTo(home, step);
      // Steps in which contact is made or lost are not all within it.
      const double ofEnds = 4 * largest * step * step;
      EXPECT_LE(-contact.work, contact.byStiffness + contact.byNormals + ofEnds) << mu;
      if (mu == 0.5) {
        EXPECT_GT(contact.work, 0) << "friction takes more than the bound";
      }
      mostGiven = std::max(mostGiven, -contact.work / (largest * depth * depth));
      relative =
          std::max(relative, (contact.byStiffness + contact.byNormals) / (largest * depth * depth));
      if (contact.work < 0)
        mostOfBound = std::max(mostOfBound,
                               -contact.work / (contact.byStiffness + contact.byNormals + ofEnds));
    }
  RecordProperty("given_back_over_K_depth2", std::to_string(mostGiven));
  RecordProperty("bound_over_K_depth2", std::to_string(relative));
  RecordProperty("given_back_over_bound", std::to_string(mostOfBound));
}
INSTANTIATE_TEST_SUITE_P(SmoothAndJittered, EnergyOf, testing::Bool(), [](const auto& jittered) {
  return jittered.param ? "JitteredSphere" : "RegularSphere";
});

}  // namespace
}  // namespace palpate::test
