// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/touch_rehearsal.h"

#include <gtest/gtest.h>

#include <tuple>

#include "mesh/subdivision.h"
#include "support/contact_bodies.h"
#include "support/data_models.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

/// A ball, moved by a mouse or a simulated device, with friction.
Scene ballOf(double radius, const std::string& device = "mouse", double forceScale = 1) {
  return parseScene(
      "{\"models\": [{\"file\": \"a\"}], \"tools\": [{\"shape\": \"sphere\", \"radius\": " +
      std::to_string(radius) +
      ", \"device\": \"d\"}], \"devices\": [{\"name\": \"d\", \"type\": \"" + device +
      "\", \"mapping\": {\"force_scale\": " + std::to_string(forceScale) +
      "}}], \"effects\": {\"friction\": {\"mu\": 0.3}}, \"solver\": {\"largest_updates\": 12}}");
}

/// One of data/, subdivided.
TouchedBody dataBody(const std::string& name, int levels) {
  DataModel model = readDataModel(name);
  for (int level = 0; level < levels; ++level) {
    const auto mesh = model.shape.mesh();
    const auto refined =
        subdivide(*mesh, Eigen::VectorXi::Zero(mesh->triangleCount()), Subdivision::Loop);
    model.boundaryTypes = refineBoundaryTypes(refined, model.boundaryTypes);
    model.shape = {refined.points, refined.triangles};
  }
  return touchedBody(model.shape, model.boundaryTypes, true);
}

TouchedBody cube() {
  const Shape shape = box({1, 1, 1}, {6, 6, 6});
  return touchedBody(shape, fixedWhere(shape, [](const auto& x) { return x.z() == 0; }), true);
}

/// Strokes of another seed, as many again, cost a tick as much to a fifth: both are means whose
/// standard errors are 4 %, so that their ratio is off by a fifth only at 3.5 of its own.
TEST(TouchRehearsals, PredictWhatOtherStrokesCost) {
  double worst = 0;
  for (const auto& [name, body, radius] :
       {std::tuple("kidney of 22 vertices", dataBody("kidney", 0), 0.3),
        std::tuple("kidney", dataBody("kidney", 2), 3.0),
        std::tuple("nodule", dataBody("nodule", 2), 0.3),
        std::tuple("spatula", dataBody("spatula", 1), 3.0), std::tuple("cube", cube(), 0.3),
        std::tuple("sphere", touchedSphere(2, true), 3.0)}) {
    const double edge = body.mesh->meanEdgeLength();
    const Scene scene = ballOf(radius * edge);
    RehearsalSettings settings;
    settings.speed = 10 * edge;
    const RehearsedTouch planned = rehearse(scene, {{body.greens, body.mesh}}, {}, settings);
    settings.seed = 77;
    const RehearsedTouch counted = rehearse(scene, {{body.greens, body.mesh}}, {}, settings);
    const auto expectNear = [&](double a, double b, const char* what) {
      worst = std::max(worst, std::abs(a / b - 1));
      EXPECT_NEAR(a, b, 0.2 * b) << what << ", " << name << ", " << radius << " edges, "
                                 << planned.strokes << " strokes";
    };
    expectNear(planned.gatheredBlocks + planned.displacementBlocks,
               counted.gatheredBlocks + counted.displacementBlocks, "Green's functions");
    expectNear(planned.solverMultiplications, counted.solverMultiplications, "the solver");
    expectNear(planned.watched, counted.watched, "watched");
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(TouchRehearsals, AreTheSameEachTime) {
  const TouchedBody body = touchedSphere(1, true);
  const Scene scene = ballOf(0.5);
  const RehearsedTouch one = rehearse(scene, {{body.greens, body.mesh}});
  const RehearsedTouch other = rehearse(scene, {{body.greens, body.mesh}});
  EXPECT_EQ(one.strokes, other.strokes);
  EXPECT_EQ(one.gatheredBlocks, other.gatheredBlocks);
  EXPECT_EQ(one.solverMultiplications, other.solverMultiplications);
  EXPECT_EQ(one.loaded, other.loaded);
}

/// A ball is pressed in by its radius or an edge, at the hand's speed, but no farther than to what
/// the hand is given: of a scale that makes the model's forces a thousand times as large, less.
TEST(TouchRehearsals, StrokeAsTheSceneAllows) {
  const TouchedBody body = touchedSphere(1, true);
  const SceneBody touched = {body.greens, body.mesh};
  const double edge = body.mesh->meanEdgeLength();
  constexpr double digits = 1e-6;  // in which a radius is written
  EXPECT_NEAR(rehearse(ballOf(edge / 4), {touched}).depth, edge / 4, digits);
  EXPECT_NEAR(rehearse(ballOf(4 * edge), {touched}).depth, edge, digits);
  EXPECT_NEAR(rehearse(ballOf(4 * edge, "simulated", 0.01), {touched}).depth, edge, digits);
  const RehearsedTouch held = rehearse(ballOf(4 * edge, "simulated", 1000), {touched});
  EXPECT_LT(held.depth, 0.5 * edge);
  EXPECT_GT(held.watched, 0);
  EXPECT_EQ(held.speed, 0.1);
  Scene gentle = ballOf(4 * edge, "simulated");
  gentle.safety.largestForce = SafetySettings{}.largestForce / 1000;
  EXPECT_EQ(rehearse(gentle, {touched}).depth, held.depth);
  gentle.safety.largestForce = 0;  // none
  EXPECT_NEAR(rehearse(gentle, {touched}).depth, edge, digits);
}

TEST(TouchRehearsals, TellHowFarTheyAreAndStop) {
  const TouchedBody body = touchedSphere(1, true);
  double last = -1;
  const Progress progress([&](double fraction, const char*) {
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return true;
  });
  rehearse(ballOf(1), {{body.greens, body.mesh}}, {}, {}, progress);
  EXPECT_EQ(last, 1);
  const Progress abort([](double, const char*) { return false; });
  EXPECT_THROW(rehearse(ballOf(1), {{body.greens, body.mesh}}, {}, {}, abort), Aborted);
}

/// Planes, capsules, hands and meshes come down on the body and touch it.
TEST(TouchRehearsals, TouchWithToolsOfAnyShape) {
  const TouchedBody body = touchedSphere(1, true);
  RehearsalSettings few;
  few.error = 1;
  const Shape wedge = box({0.4, 0.3, 0.2}, {1, 1, 1});
  for (const std::string tool : {"\"shape\": \"plane\"", "\"shape\": \"hand\", \"length\": 1",
                                 "\"shape\": \"capsule\", \"radius\": 0.3, \"length\": 1",
                                 "\"shape\": \"mesh\", \"file\": \"wedge\""}) {
    const Scene scene =
        parseScene("{\"models\": [{\"file\": \"a\"}], \"tools\": [{" + tool +
                   ", \"device\": \"d\"}], \"devices\": [{\"name\": \"d\", \"type\": \"scripted\", "
                   "\"file\": \"moves\"}]}");
    const RehearsedTouch touched = rehearse(scene, {{body.greens, body.mesh}}, {wedge.mesh()}, few);
    EXPECT_GT(touched.loaded[0], 0.5) << tool;
    EXPECT_GT(touched.solverMultiplications, 0) << tool;
  }
  const Scene point = parseScene(
      "{\"models\": [{\"file\": \"a\"}], \"tools\": [{\"shape\": \"point\", \"device\": "
      "\"d\"}], \"devices\": [{\"name\": \"d\", \"type\": \"mouse\"}]}");
  EXPECT_TRUE(isRefused([&] { rehearse(point, {{body.greens, body.mesh}}); }, "no rehearsal"));
}

}  // namespace
}  // namespace palpate::test
