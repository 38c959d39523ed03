// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/evaluation_plan.h"

#include <gtest/gtest.h>

#include <random>

#include "greens/counting_greens.h"
#include "haptics/tool_touch.h"
#include "support/contact_bodies.h"
#include "support/process_state.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kAgreement = 0.2;  ///< of a prediction with what is counted

/// A scene with one or several mice.
Scene sceneOf(const std::string& tool, const std::string& effects, int tools = 1) {
  std::string list, devices;
  for (int i = 0; i < tools; ++i) {
    const std::string name = "\"mouse " + std::to_string(i) + "\"", comma = i ? ", " : "";
    list += comma + "{" + tool + ", \"device\": " + name + "}";
    devices += comma + "{\"name\": " + name + ", \"type\": \"mouse\"}";
  }
  return parseScene("{\"models\": [{\"file\": \"sphere\"}], \"tools\": [" + list +
                    "], \"devices\": [" + devices + "], \"effects\": {" + effects + "}}");
}

const std::string kPoint = "\"shape\": \"point\"";
const std::string kBall = "\"shape\": \"sphere\", \"radius\": 1";

const TouchedBody& body() {
  static const TouchedBody body = touchedSphere(3, true);
  return body;
}

/// What is asked of Green's functions in the course of a few touches.
struct Course {
  std::shared_ptr<const CountingGreens> greens = std::make_shared<CountingGreens>(body().greens);
  TouchSession session;
  CountingGreens::Counts setup, tick, frame;  ///< a tick's and a frame's mean
  double loaded = 0, watched = 0;

  explicit Course(const Scene& scene) : session(scene, {{greens, body().mesh}}) {
    setup = greens->counts();
  }

  /// Presses a depth into the surface at random places of the upper half, and looks at half of it.
  void touch(int touches, double depth, double radius) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    ContactSnapshot snapshot = session.model()->makeSnapshot();
    std::vector<std::vector<int>> visible(1);
    for (int v = 0; v < greens->nodeCount(); v += 2) visible[0].push_back(v);
    for (int i = 0; i < touches; ++i) {
      Eigen::Vector3d way(normal(random), normal(random), std::abs(normal(random)) + 0.5);
      way.normalize();
      session.model()->reset();
      ToolPose pose;
      Wrench wrench;
      for (int step = 0; step <= 30; ++step) {
        pose.position = (1 + radius + 0.2 - (0.2 + depth) * step / 30) * way;
        session.model()->step(&pose, &wrench);
      }
      session.model()->fill(snapshot);
      loaded += loadedNodes(snapshot) / double(touches);
      greens->clearCounts();
      session.computeFrame(snapshot, visible);
      frame.multiplyAdds += greens->counts().multiplyAdds / touches;
      frame.bytes += greens->counts().bytes / touches;
      frame.calls += greens->counts().calls;
    }
  }

  /// Strokes the surface at a depth, by an arc over the top.
  void stroke(double depth, double radius, double speed, double rate) {
    constexpr int sinking = 100;       // ticks that do not count
    const double turn = speed / rate;  // rad a tick: the speed is that at the surface
    const auto* shapes = dynamic_cast<const ToolTouch*>(session.model().get());
    ToolPose pose;
    Wrench wrench;
    session.model()->reset();
    greens->clearCounts();
    int ticks = 0;
    for (double angle = -0.9; angle < 0.9; angle += turn, ++ticks) {
      const double sunk = std::min(1., 2. * ticks / sinking) * (depth + 0.2);
      pose.position =
          (1 + radius + 0.2 - sunk) * Eigen::Vector3d(std::sin(angle), 0, std::cos(angle));
      const ContactCertificate certificate = session.model()->step(&pose, &wrench);
      if (ticks == sinking) greens->clearCounts();
      if (ticks <= sinking || !shapes) continue;
      watched += shapes->contact().watchedCount();
      loaded += certificate.contactCount;
    }
    for (double* sum : {&watched, &loaded}) *sum /= ticks - 1 - sinking;
    tick.gatheredBlocks = greens->counts().gatheredBlocks / (ticks - 1 - sinking);
    tick.bytes = greens->counts().bytes / (ticks - 1 - sinking);
  }

  int loadedNodes(const ContactSnapshot& snapshot) const {
    return static_cast<int>(
        snapshotTractions(*greens, snapshot, 0, Eigen::Matrix3d::Identity(), 1).nodes.size());
  }
};

EvaluationPlan planOf(const Scene& scene, const ExpectedTouch& touch = {}) {
  return planEvaluation(scene, {{body().greens, body().mesh}}, touch);
}

void expectNear(double predicted, double counted, const std::string& what) {
  EXPECT_NEAR(predicted, counted, kAgreement * counted) << what;
}

TEST(EvaluationPlans, PredictTheFramesOfBalls) {
  for (const double radius : {0.7, 2.0})
    for (const double depth : {0.1, 0.2})
      for (const std::string rows : {"all", "visible", "contact"}) {
        const std::string what =
            rows + ", radius " + std::to_string(radius) + ", depth " + std::to_string(depth);
        const Scene scene = sceneOf("\"shape\": \"sphere\", \"radius\": " + std::to_string(radius),
                                    "\"deformation\": \"" + rows + "\"");
        ExpectedTouch touch;
        touch.depth = depth;
        const EvaluationPlan plan = planOf(scene, touch);
        Course course(scene);
        course.touch(30, depth, radius);
        expectNear(plan.loaded, course.loaded, what);
        expectNear(total(plan.frame).flops, 2 * course.frame.multiplyAdds, what);
        expectNear(total(plan.frame).bytes, course.frame.bytes, what);
      }
}

TEST(EvaluationPlans, PredictTheFramesOfPointsUnderMasks) {
  for (const double edges : {0.0, 1.0, 1.5, 2.0, 3.0})
    for (const std::string rows : {"all", "visible", "contact"}) {
      const std::string what = rows + ", mask of " + std::to_string(edges) + " edges";
      const Scene scene =
          sceneOf(kPoint, "\"deformation\": \"" + rows +
                              "\", \"masks\": {\"radius_edges\": " + std::to_string(edges) + "}");
      const EvaluationPlan plan = planOf(scene);
      Course course(scene);
      course.touch(40, 0.1, 0);
      expectNear(plan.loaded, course.loaded, what);
      expectNear(total(plan.frame).flops, 2 * course.frame.multiplyAdds, what);
      expectNear(total(plan.frame).bytes, course.frame.bytes, what);
    }
}

TEST(EvaluationPlans, PredictTheStiffnessOfTheSurface) {
  for (const double edges : {0.0, 1.0, 2.0, 3.0}) {
    const Scene scene =
        sceneOf(kPoint, "\"masks\": {\"radius_edges\": " + std::to_string(edges) + "}");
    const Course course(scene);
    const EvaluationPlan plan = planOf(scene);
    expectNear(plan.setup.at(0).bytes, course.setup.bytes, std::to_string(edges) + " edges");
  }
}

TEST(EvaluationPlans, PredictGravity) {
  Scene scene = sceneOf(kBall, "\"deformation\": \"none\"");
  scene.models[0].density = 1e-3;
  scene.effects.gravity = {0, 0, -1};
  const auto greens = std::make_shared<CountingGreens>(body().greens);
  const SceneBody touched = {greens, body().mesh,
                             Eigen::VectorXi::Zero(body().mesh->triangleCount())};
  const EvaluationPlan plan = planEvaluation(scene, {touched});
  const TouchSession warm(scene, {touched});  // arenas have their size
  greens->clearCounts();
  const double before = heapBytes();
  const TouchSession session(scene, {touched});
  expectNear(plan.setup.at(0).bytes, greens->counts().bytes, "gravity");
  expectNear(totalBytes(plan.memory) - plan.memory.back().bytes, heapBytes() - before, "memory");
}

bool lists(const EvaluationPlan& plan, const std::string& what) {
  return toText(plan).find(what) != std::string::npos;
}

/// Of Green's functions, a tick, as planned.
double plannedBytes(const EvaluationPlan& plan) {
  double bytes = 0;
  for (const PlannedWork& work : plan.tick)
    if (work.columns > 0) bytes += work.bytes;
  return bytes;
}

/// The rehearsal's strokes go over all of the body in all directions; these follow one arc.
TEST(EvaluationPlans, PredictTheTicksOfAStroke) {
  for (const double radius : {0.3, 0.7, 2.0}) {
    const double depth = std::min(0.1, radius / 2);
    const std::string what = "radius " + std::to_string(radius);
    const Scene scene = sceneOf("\"shape\": \"sphere\", \"radius\": " + std::to_string(radius), "");
    ExpectedTouch touch;
    touch.depth = depth;
    touch.speed = 1;
    const EvaluationPlan plan = planOf(scene, touch);
    Course course(scene);
    course.stroke(depth, radius, touch.speed, scene.servo.rate);
    expectNear(plannedBytes(plan), course.tick.bytes, what);
    expectNear(plan.watched, course.watched, what);
  }
}

/// Ticks of points ask Green's functions for nothing.
TEST(EvaluationPlans, LetPointsTickWithoutRows) {
  const Scene scene = sceneOf(kPoint, "");
  Course course(scene);
  course.stroke(0.1, 0, 1, 1000);
  EXPECT_EQ(course.tick.gatheredBlocks, 0);
  const PlannedWork sum = total(planOf(scene).tick);
  EXPECT_EQ(sum.rows, 0);
  EXPECT_EQ(sum.columns, 0);
}

/// Ticks of several ask for the compliance between corners that they come to.
TEST(EvaluationPlans, PredictTheTicksOfPointsThatFeelEachOther) {
  for (const int tools : {2, 3})
    for (const double edges : {0.0, 1.5, 2.5}) {
      const Scene scene =
          sceneOf(kPoint, "\"masks\": {\"radius_edges\": " + std::to_string(edges) + "}", tools);
      const Course course(scene);
      ExpectedTouch touch;
      touch.speed = 3;
      const double turn = touch.speed / scene.servo.rate;
      double ticks = 0, bytes = 0, sweeps = 0;
      for (int stroke = 0; stroke < 12; ++stroke) {
        course.session.model()->reset();
        std::vector<ToolPose> poses(tools);
        std::vector<Wrench> wrenches(tools);
        for (int t = 0; t < 400; ++t) {
          for (int i = 0; i < tools; ++i) {
            const double along = 0.2 + turn * t, across = 2 * kPi * i / tools + 0.5 * stroke;
            poses[i].position =
                (t == 0 ? 1.1 : 0.95) * Eigen::Vector3d(std::sin(along) * std::cos(across),
                                                        std::sin(along) * std::sin(across),
                                                        std::cos(along));
          }
          if (t == 50) course.greens->clearCounts();
          sweeps += course.session.model()->step(poses.data(), wrenches.data()).iterations;
        }
        bytes += course.greens->counts().bytes;
        ticks += 350;
      }
      const EvaluationPlan plan = planOf(scene, touch);
      const std::string what =
          std::to_string(tools) + " points, masks of " + std::to_string(edges) + " edges";
      ASSERT_TRUE(lists(plan, "compliance between points"));
      expectNear(plan.tick.at(1).bytes, bytes / ticks, what);
      RecordProperty("sweeps of " + what, std::to_string(sweeps / ticks * 350 / 400));
    }
  EXPECT_FALSE(lists(planOf(sceneOf(kPoint, "")), "compliance between points"));
}

TEST(EvaluationPlans, PredictProbes) {
  const std::string probes =
      "\"probes\": [{\"name\": \"a\", \"node\": 3}, {\"name\": \"b\", \"node\": 40}], ";
  const Scene none = sceneOf(kBall, probes + "\"deformation\": \"none\"");
  ExpectedTouch touch;
  touch.depth = 0.15;
  Course course(none);
  course.touch(30, touch.depth, 1);
  expectNear(total(planOf(none, touch).frame).flops, 2 * course.frame.multiplyAdds, "probes alone");
  const Scene all = sceneOf(kBall, probes + "\"deformation\": \"all\"");
  const Scene without = sceneOf(kBall, "\"deformation\": \"all\"");
  EXPECT_EQ(total(planOf(all, touch).frame).flops, total(planOf(without, touch).frame).flops);
}

TEST(EvaluationPlans, ListNothingThatIsNotAskedFor) {
  const EvaluationPlan bare = planOf(sceneOf(kBall, "\"deformation\": \"none\""));
  EXPECT_TRUE(bare.frame.empty());
  EXPECT_TRUE(bare.setup.empty());
  for (const char* what : {"displacements", "probes", "torque", "stiffness of"})
    EXPECT_FALSE(lists(bare, what)) << what;
  const EvaluationPlan point = planOf(sceneOf(kPoint, "\"deformation\": \"none\""));
  EXPECT_TRUE(point.frame.empty());
  for (const char* what : {"displacements", "solver", "torque", "unilateral", "watched"})
    EXPECT_FALSE(lists(point, what)) << what;
  const EvaluationPlan rich =
      planOf(sceneOf(kBall, "\"torque\": true, \"probes\": [{\"name\": \"a\", \"node\": 3}]"));
  for (const char* what : {"displacements", "probes", "torque", "solver", "unilateral", "together"})
    EXPECT_TRUE(lists(rich, what)) << what;
}

/// What a session reserves, by the C library's count.
TEST(EvaluationPlans, PredictMemory) {
  const std::string masks = "\"masks\": {\"radius_edges\": 2}";
  for (const auto& [tool, effects, tools] :
       {std::tuple(kBall, std::string("\"deformation\": \"all\""), 1),
        std::tuple(kBall, std::string("\"deformation\": \"none\""), 3),
        std::tuple(kPoint, masks, 1),
        std::tuple(kPoint, masks + ", \"deformation\": \"none\"", 2)}) {
    const Scene scene = sceneOf(tool, effects, tools);
    double planned = 0;
    for (const PlannedMemory& entry : planOf(scene).memory)
      if (entry.what != "snapshots of contacts") planned += entry.bytes;
    const SceneBody touched = {body().greens, body().mesh};
    const double before = heapBytes();
    const TouchSession session(scene, {touched});
    expectNear(planned, heapBytes() - before, tool + effects);
  }
}

TEST(EvaluationPlans, PartnersAddTheirOwnRows) {
  const Scene scene = parseScene(
      "{\"models\": [{\"file\": \"a\"}, {\"file\": \"b\", \"position\": [0, 0, 1.95], "
      "\"orientation\": {\"axis\": [1, 0, 0], \"angle\": 3.14}}], \"tools\": "
      "[{" +
      kBall +
      ", \"device\": \"m\"}], \"devices\": [{\"name\": \"m\", \"type\": \"mouse\"}], "
      "\"effects\": {\"elastic_elastic\": true}}");
  const SceneBody sphere = {body().greens, body().mesh};
  const EvaluationPlan plan = planEvaluation(scene, {sphere, sphere});
  ASSERT_EQ(plan.frame.size(), 2u);
  EXPECT_EQ(plan.frame[1].rows, body().mesh->vertexCount());
  EXPECT_GT(plan.frame[1].columns, 0);
  EXPECT_TRUE(isRefused([&] { planEvaluation(scene, {sphere}); }, "has 2 models, but there are"));
}

}  // namespace
}  // namespace palpate::test
