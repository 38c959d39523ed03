// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/touch_session.h"

#include <gtest/gtest.h>

#include "greens/counting_greens.h"
#include "haptics/point_touch.h"
#include "haptics/tool_touch.h"
#include "support/allocation_count.h"
#include "support/contact_bodies.h"
#include "support/lock_count.h"
#include "support/process_state.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

/// A scene of one body and tools that recordings move.
std::string sceneText(const std::string& shapes, const std::string& effects,
                      const std::string& models = "{\"file\": \"sphere\"}") {
  std::string tools, devices;
  int count = 0;
  for (std::size_t at = 0; at < shapes.size();) {
    const std::size_t end = std::min(shapes.find(';', at), shapes.size());
    const std::string name = "\"device " + std::to_string(count) + "\"",
                      comma = count++ ? ", " : "";
    tools += comma + "{" + shapes.substr(at, end - at) + ", \"device\": " + name + "}";
    devices += comma + "{\"name\": " + name + ", \"type\": \"scripted\", \"file\": \"motion.txt\"}";
    at = end + 1;
  }
  return "{\"models\": [" + models + "], \"tools\": [" + tools + "], \"devices\": [" + devices +
         "], \"effects\": {" + effects + "}}";
}

const std::string kPoint = "\"shape\": \"point\"";
const std::string kBall = "\"shape\": \"sphere\", \"radius\": 0.3";

/// A session with a body whose use is counted.
struct Counted {
  explicit Counted(const TouchedBody& body, const std::string& shapes, const std::string& effects)
      : greens(std::make_shared<CountingGreens>(body.greens)),
        session(parseScene(sceneText(shapes, effects)), {{greens, body.mesh}}),
        snapshot(session.model()->makeSnapshot()) {}

  /// Presses from above, down to a height of the tool.
  void press(double x, double height) {
    ToolPose pose;
    Wrench wrenches[4];
    for (int tick = 0; tick <= 40; ++tick) {
      pose.position = {x, 0, 1.5 + tick / 40. * (height - 1.5)};
      session.model()->step(&pose, wrenches);
    }
    wrench = wrenches[0];
    session.model()->fill(snapshot);
    greens->clearCounts();
  }

  std::shared_ptr<const CountingGreens> greens;
  TouchSession session;
  ContactSnapshot snapshot;
  Wrench wrench;
};

int loadedCount(const Counted& counted) {
  return static_cast<int>(
      snapshotTractions(*counted.greens, counted.snapshot, 0, Eigen::Matrix3d::Identity(), 1)
          .nodes.size());
}

/// Tools that are not unilateral pull with their first button.
TEST(TouchSessions, HoldWhatIsTouchedIfTheSceneSaysSo) {
  const TouchedBody body = touchedSphere(2, true);
  for (const bool unilateral : {true, false}) {
    Counted counted(body, kBall, std::string("\"unilateral\": ") + (unilateral ? "true" : "false"));
    counted.press(0, 1.2);
    ToolPose pose;
    pose.buttons = 1;
    for (const double height : {1.2, 1.2, 1.4}) {
      pose.position = {0, 0, height};
      counted.session.model()->step(&pose, &counted.wrench);
    }
    if (unilateral) {
      EXPECT_EQ(counted.wrench.force, Eigen::Vector3d::Zero());
    } else {
      EXPECT_LT(counted.wrench.force.z(), 0);
    }
  }
}

/// As a scene says nothing of it: many contacts at once, whose statuses change.
TEST(TouchSessions, TicksOfADefaultSceneNeitherLockNorAllocateNorThrow) {
  ASSERT_TRUE(locksAreCounted() && allocationsAreCounted());
  const TouchedBody body = touchedSphere(3, true);
  for (const std::string& tool : {kPoint, std::string("\"shape\": \"sphere\", \"radius\": 2"),
                                  std::string("\"shape\": \"plane\"")}) {
    const Scene scene = parseScene(sceneText(tool, "\"friction\": {\"mu\": 0.3}"));
    TouchSession session(scene, {{body.greens, body.mesh}});
    ContactSnapshot snapshot = session.model()->makeSnapshot();
    const bool isPlane = scene.tools[0].shape == ToolShape::Plane;
    const double off = isPlane ? 1 : 1 + scene.tools[0].radius;
    ToolPose pose;
    if (isPlane) pose.orientation = Eigen::AngleAxisd(3.14, Eigen::Vector3d::UnitX());
    Wrench wrench = kNoWrench;
    int most = 0;
    const long before = allocationCount() + lockCount() + exceptionCount();
    for (int tick = 0; tick < 300; ++tick) {
      const double angle = 0.001 * tick;
      pose.position =
          (off + 0.05 - 0.001 * tick) * Eigen::Vector3d(std::sin(angle), 0, std::cos(angle));
      most = std::max(most, session.model()->step(&pose, &wrench).contactCount);
      session.model()->fill(snapshot);
    }
    EXPECT_EQ(allocationCount() + lockCount() + exceptionCount(), before) << tool;
    EXPECT_GT(wrench.force.norm(), 0) << tool;
    EXPECT_GT(most, tool == kPoint ? 0 : 30) << tool;
  }
}

TEST(TouchSessions, TouchWithPointsOrWithShapes) {
  const TouchedBody body = touchedSphere(2, true);
  Counted point(body, kPoint, "\"friction\": {\"mu\": 0.4}");
  const auto* pointTouch = dynamic_cast<const PointTouch*>(point.session.model().get());
  ASSERT_TRUE(pointTouch);
  EXPECT_EQ(pointTouch->friction(), 0.4);
  Counted shapes(body,
                 kBall + ";\"shape\": \"capsule\", \"radius\": 0.1, \"length\": 1" +
                     ";\"shape\": \"plane\";\"shape\": \"hand\", \"length\": 1",
                 "");
  const auto* toolTouch = dynamic_cast<const ToolTouch*>(shapes.session.model().get());
  ASSERT_TRUE(toolTouch);
  EXPECT_EQ(toolTouch->contact().obstacleCount(), 3 + kHandCapsuleCount);
}

/// Each choice of rows gives the rows of the whole deformation, and pays for no others.
TEST(TouchSessions, ComputeTheRowsAskedForAndNoOthers) {
  const TouchedBody body = touchedSphere(3, true);
  for (const std::string& tool : {kPoint, kBall}) {
    const double height = tool == kPoint ? 0.9 : 1.2;
    Counted all(body, tool, "\"deformation\": \"all\"");
    all.press(0.1, height);
    const double loaded = loadedCount(all), nodes = body.mesh->vertexCount();
    ASSERT_GT(loaded, 0);
    all.session.computeFrame(all.snapshot);
    EXPECT_EQ(all.greens->counts().multiplyAdds, 9 * nodes * loaded);
    const Eigen::Matrix3Xd& whole = all.session.displacement(0);
    EXPECT_GT(whole.norm(), 0);

    Counted visible(body, tool, "\"deformation\": \"visible\"");
    visible.press(0.1, height);
    const std::vector<int> inView = {3, 77, 200};
    visible.session.computeFrame(visible.snapshot, {inView});
    EXPECT_EQ(visible.greens->counts().multiplyAdds, 9 * 3 * loaded);
    for (int node = 0; node < nodes; ++node) {
      const bool isAsked = std::count(inView.begin(), inView.end(), node) > 0;
      const Eigen::Vector3d exact =
          isAsked ? Eigen::Vector3d(whole.col(node)) : Eigen::Vector3d::Zero();
      EXPECT_LE((visible.session.displacement(0).col(node) - exact).norm(), 1e-12 * whole.norm());
    }
    // What goes out of view goes back.
    visible.session.computeFrame(visible.snapshot, {{5}});
    EXPECT_TRUE(visible.session.displacement(0).col(77).isZero(0));
    EXPECT_TRUE(isRefused([&] { visible.session.computeFrame(visible.snapshot, {{9999}}); },
                          "there is no node 9999"));

    Counted contact(body, tool, "\"deformation\": \"contact\"");
    contact.press(0.1, height);
    contact.session.computeFrame(contact.snapshot);
    EXPECT_EQ(contact.greens->counts().multiplyAdds, 9 * loaded * loaded);

    Counted none(body, tool, "\"deformation\": \"none\"");
    none.press(0.1, height);
    none.session.computeFrame(none.snapshot);
    EXPECT_EQ(none.greens->counts().calls, 0);
    EXPECT_FALSE(none.session.deforms());
    EXPECT_THROW(none.session.displacement(0), std::out_of_range);
  }
}

TEST(TouchSessions, ProbesCostTheirOwnRowsUnlessAllAreComputed) {
  const TouchedBody body = touchedSphere(2, true);
  const Eigen::Vector3i corners = body.mesh->triangles().col(20);
  const Eigen::Vector3d middle =
      (body.mesh->points().col(corners[0]) + body.mesh->points().col(corners[1]) +
       body.mesh->points().col(corners[2])) /
      3;
  const std::string place = std::to_string(middle.x()) + ", " + std::to_string(middle.y()) + ", " +
                            std::to_string(middle.z());
  const std::string probes =
      "\"probes\": [{\"name\": \"node\", \"node\": 5}, {\"name\": \"middle\", "
      "\"position\": [" +
      place + "]}], ";
  Counted all(body, kBall, probes + "\"deformation\": \"all\"");
  Counted none(body, kBall, probes + "\"deformation\": \"none\"");
  all.press(0.05, 1.2);
  none.press(0.05, 1.2);
  const double loaded = loadedCount(all);
  all.session.computeFrame(all.snapshot);
  none.session.computeFrame(none.snapshot);
  EXPECT_EQ(all.greens->counts().multiplyAdds, 9 * body.mesh->vertexCount() * loaded);
  EXPECT_EQ(none.greens->counts().multiplyAdds, 9 * 4 * loaded);
  const Eigen::Matrix3Xd& u = all.session.displacement(0);
  ASSERT_EQ(none.session.probeDisplacements().cols(), 2);
  EXPECT_GT(u.col(5).norm(), 0);
  EXPECT_LE((none.session.probeDisplacements().col(0) - u.col(5)).norm(), 1e-12 * u.norm());
  const Eigen::Vector3d mean = (u.col(corners[0]) + u.col(corners[1]) + u.col(corners[2])) / 3;
  // The place is written with six decimals.
  EXPECT_LE((none.session.probeDisplacements().col(1) - mean).norm(), 1e-4 * u.norm());
  EXPECT_LE((none.session.probeDisplacements() - all.session.probeDisplacements()).norm(),
            1e-12 * u.norm());
}

TEST(TouchSessions, AStiffnessScaleChangesForcesAndNotShapes) {
  const TouchedBody body = touchedSphere(2, true);
  for (const std::string& tool : {kPoint, kBall}) {
    const double height = tool == kPoint ? 0.9 : 1.25;
    Counted soft(body, tool, ""), stiff(body, tool, "\"stiffness_scale\": 3");
    soft.press(0.02, height);
    stiff.press(0.02, height);
    EXPECT_LE((stiff.wrench.force - 3 * soft.wrench.force).norm(),
              1e-6 * stiff.wrench.force.norm());
    soft.session.computeFrame(soft.snapshot);
    stiff.session.computeFrame(stiff.snapshot);
    const Eigen::Matrix3Xd& shape = soft.session.displacement(0);
    EXPECT_LE((stiff.session.displacement(0) - shape).norm(), 1e-6 * shape.norm());
  }
}

TEST(TouchSessions, ComputeTorquesOnRequestOnly) {
  const TouchedBody body = touchedSphere(2, true);
  Counted with(body, kBall, "\"torque\": true, \"friction\": {\"mu\": 0.5}");
  Counted without(body, kBall, "\"friction\": {\"mu\": 0.5}");
  with.press(0.2, 1.2);
  without.press(0.2, 1.2);
  EXPECT_GT(with.wrench.torque.norm(), 0);
  EXPECT_TRUE(without.wrench.torque.isZero(0));
  EXPECT_TRUE(without.snapshot.tools[0].wrench.torque.isZero(0));
  EXPECT_LE((with.wrench.force - without.wrench.force).norm(), 1e-12 * with.wrench.force.norm());
}

TEST(TouchSessions, PartnersMeetTheFirstAndDeform) {
  const TouchedBody body = touchedSphere(2, true);
  const Scene scene = parseScene(
      sceneText(kBall, "\"elastic_elastic\": true",
                "{\"file\": \"a\"}, {\"file\": \"b\", \"position\": [0, 0, 1.97], \"orientation\": "
                "{\"axis\": [1, 0, 0], \"angle\": 3}}"));
  TouchSession session(scene, {{body.greens, body.mesh}, {body.greens, body.mesh}});
  ToolPose pose;
  pose.position = {5, 5, 5};
  Wrench wrench;
  for (int tick = 0; tick < 5; ++tick) session.model()->step(&pose, &wrench);
  ContactSnapshot snapshot = session.model()->makeSnapshot();
  session.model()->fill(snapshot);
  session.computeFrame(snapshot);
  int pole;
  body.mesh->points().row(2).maxCoeff(&pole);
  EXPECT_LT(session.displacement(0)(2, pole), 0);
  EXPECT_GT(session.displacement(1)(2, pole), 0);
}

TEST(TouchSessions, TellOfBodiesThatOverlapBeforeTheyAreTouched) {
  const TouchedBody body = touchedSphere(2, true);
  const std::vector<SceneBody> bodies(2, {body.greens, body.mesh});
  const auto warnings = [&](const std::string& height) {
    return warningsOf(parseScene(sceneText(kBall, "\"elastic_elastic\": true",
                                           "{\"file\": \"a\"}, {\"file\": \"b\", \"position\": "
                                           "[0, 0, " +
                                               height + "]}")),
                      bodies);
  };
  EXPECT_TRUE(warnings("2.1").empty());
  for (const std::string height : {"1.9", "1.2", "0.1"}) {
    ASSERT_EQ(warnings(height).size(), 1u) << height;
    EXPECT_NE(warnings(height)[0].find("model 1 overlaps the first by"), std::string::npos);
  }
}

/// What is touched hangs under its weight: a ball finds the sagged surface, not the given one.
TEST(TouchSessions, TouchTheSurfaceAsItHangs) {
  const TouchedBody body = touchedSphere(2, true);
  SceneBody given{body.greens, body.mesh, Eigen::VectorXi::Zero(body.mesh->triangleCount())};
  const std::string model = "{\"file\": \"sphere\", \"density\": 0.1}";
  const auto session = [&](const std::string& effects) {
    return TouchSession(parseScene(sceneText(kBall, effects, model)), {given});
  };
  const TouchSession still = session("");
  EXPECT_EQ(still.mesh(0), body.mesh);
  const TouchSession hung = session("\"gravity\": [0, 0, -1]");
  int pole;
  body.mesh->points().row(2).maxCoeff(&pole);
  const double sag = body.mesh->points()(2, pole) - hung.mesh(0)->points()(2, pole);
  EXPECT_GT(sag, 0.01);
  ToolPose pose;
  Wrench wrench;
  pose.position = {0, 0, 1.3 - sag / 2};  // within the given surface, above the sagged one
  still.model()->step(&pose, &wrench);
  EXPECT_GT(wrench.force.z(), 0);
  hung.model()->step(&pose, &wrench);
  EXPECT_TRUE(wrench.force.isZero(0));
  pose.position.z() -= sag;
  hung.model()->step(&pose, &wrench);
  EXPECT_GT(wrench.force.z(), 0);
  // A partner that lies upside down hangs the other way in its own frame.
  const Scene two =
      parseScene(sceneText(kBall, "\"gravity\": [0, 0, -1], \"elastic_elastic\": true",
                           model + ", {\"file\": \"b\", \"density\": 0.1, \"position\": [0, 0, 5], "
                                   "\"orientation\": [0, 1, 0, 0]}"));
  const TouchSession both(two, {given, given});
  EXPECT_GT(both.mesh(1)->points()(2, pole), body.mesh->points()(2, pole) + sag / 2);
  given.smoothPatches = {};
  EXPECT_TRUE(isRefused([&] { session("\"gravity\": [0, 0, -1]"); }, "patch numbers"));
}

/// Of a session without deformation and probes, a frame costs nothing at all; and no session
/// starts a thread or loads a library.
TEST(TouchSessions, PayForNothingThatIsNotAskedFor) {
  ASSERT_TRUE(allocationsAreCounted());
  const TouchedBody body = touchedSphere(2, true);
  const int threads = threadCount();
  for (const std::string& tool : {kPoint, kBall}) {
    Counted none(body, tool, "\"deformation\": \"none\"");
    none.press(0.05, tool == kPoint ? 0.9 : 1.2);
    const long before = allocationCount();
    none.session.computeFrame(none.snapshot);
    EXPECT_EQ(allocationCount() - before, 0);
    EXPECT_EQ(none.greens->counts().calls, 0);
  }
  EXPECT_EQ(threadCount(), threads);
  EXPECT_FALSE(isLoaded("hidapi"));
  EXPECT_FALSE(isLoaded("libvtk"));
  EXPECT_FALSE(isLoaded("libGL"));
}

/// A point needs no contact solver, and a shape no table of stiffnesses.
TEST(TouchSessions, PrepareOnlyTheContactThatIsAskedFor) {
  const TouchedBody body = touchedSphere(2, true);
  const Counted ball(body, kBall, "");
  EXPECT_EQ(ball.greens->counts().calls, 0);
  const Counted point(body, kPoint, "");
  EXPECT_GT(point.greens->counts().gatheredBlocks, 0);
}

TEST(TouchSessions, RefuseToolsOfAnotherUnit) {
  const TouchedBody body = touchedSphere(1, true);
  for (const char* shape : {"\"shape\": \"sphere\", \"radius\": ",
                            "\"shape\": \"capsule\", \"length\": 1, \"radius\": ",
                            "\"shape\": \"hand\", \"length\": "}) {
    for (const char* size : {"1e-300", "1e-5", "40", "1e5"})
      EXPECT_TRUE(isRefused([&] { Counted(body, shape + std::string(size), ""); },
                            "does not fit a model of "))
          << shape << size;
    EXPECT_TRUE(isRefused(
        [&] { Counted(body, "\"shape\": \"capsule\", \"length\": 40, \"radius\": 0.1", ""); },
        "does not fit a model of "));
    for (const char* size : {"0.001", "30"})
      EXPECT_NO_THROW(Counted(body, shape + std::string(size), ""));
  }
}

/// The Green's functions of the nodes above a height alone.
TouchedBody withColumnsAbove(const TouchedBody& body, double height) {
  GreensFunctionsInfo info = body.greens->info();
  info.columnNodes.clear();
  for (int v = 0; v < body.mesh->vertexCount(); ++v)
    if (body.mesh->points()(2, v) > height) info.columnNodes.push_back(v);
  return {body.mesh, denseGreens(info, denseMatrix(*body.greens))};
}

/// Steps a tool from afar to a place.
ContactCertificate bring(TouchModel& model, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                         Wrench& wrench) {
  ContactCertificate certificate;
  ToolPose pose;
  for (int tick = 0; tick <= 40; ++tick) {
    pose.position = from + tick / 40. * (to - from);
    certificate = model.step(&pose, &wrench);
  }
  return certificate;
}

TEST(TouchSessions, ServeModelsOfSomeColumnsWhereTheseAreAndTellWhereTheyAreNot) {
  const TouchedBody whole = touchedSphere(3, true), part = withColumnsAbove(whole, 0.3);
  const Scene scene = parseScene(sceneText(kBall, "\"friction\": {\"mu\": 0.3}"));
  EXPECT_TRUE(warningsOf(scene, {{whole.greens, whole.mesh}}).empty());
  const auto warnings = warningsOf(scene, {{part.greens, part.mesh}});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("has no Green's functions of "), std::string::npos);
  EXPECT_NE(warnings[0].find("`palpate precompute` without --columns"), std::string::npos);

  TouchSession all(scene, {{whole.greens, whole.mesh}}), some(scene, {{part.greens, part.mesh}});
  Wrench expected, wrench;
  bring(*all.model(), {0, 0, 1.6}, {0.05, 0, 1.25}, expected);
  ContactCertificate certificate = bring(*some.model(), {0, 0, 1.6}, {0.05, 0, 1.25}, wrench);
  EXPECT_FALSE(certificate.failed || certificate.uncomputed || certificate.budgetCut);
  EXPECT_GT(wrench.force.z(), 0);
  EXPECT_LE((wrench.force - expected.force).norm(), 1e-12 * expected.force.norm());

  some.model()->reset();
  certificate = bring(*some.model(), {1.6, 0, 0}, {1.25, 0, 0}, wrench);
  EXPECT_TRUE(certificate.failed && certificate.uncomputed);
  EXPECT_EQ(wrench.force, Eigen::Vector3d::Zero());
  EXPECT_EQ(wrench.torque, Eigen::Vector3d::Zero());
  ContactSnapshot snapshot = some.model()->makeSnapshot();
  some.model()->fill(snapshot);
  EXPECT_EQ(snapshot.loadedCount, 0);
  EXPECT_FALSE(snapshot.tools[0].touching);
}

TEST(TouchSessions, RefuseBodiesThatNoToolCanTouch) {
  const Shape shape = jitteredSphere(1, 0.2);
  const std::vector<unsigned char> types(shape.mesh()->vertexCount(), 0);
  const TouchedBody cavity = touchedBody(shape, types, true, Domain::Exterior);
  const TouchedBody none = withColumnsAbove(touchedSphere(1, true), 2);
  for (const std::string& tool : {kPoint, kBall}) {
    EXPECT_TRUE(isRefused([&] { Counted(cavity, tool, ""); }, "material lies outside its surface"));
    EXPECT_TRUE(isRefused([&] { Counted(none, tool, ""); }, "no Green's functions of free vert"));
  }
}

TEST(TouchSessions, RefusePartnersOfSomeColumns) {
  const TouchedBody whole = touchedSphere(1, true), part = withColumnsAbove(whole, 0.3);
  const Scene scene =
      parseScene(sceneText(kBall, "\"elastic_elastic\": true",
                           "{\"file\": \"a\"}, {\"file\": \"b\", \"position\": [0, 0, 3]}"));
  const SceneBody all{whole.greens, whole.mesh}, some{part.greens, part.mesh};
  EXPECT_TRUE(isRefused([&] { TouchSession(scene, {all, some}); }, "model 1 meets the first"));
  EXPECT_NO_THROW(TouchSession(scene, {some, all}));
}

TEST(TouchSessions, WarnOfToolsAndMasksThatTheMeshIsTooCoarseFor) {
  const TouchedBody body = touchedSphere(2, true);
  const double edge = body.mesh->meanEdgeLength();
  const auto warnings = [&](const std::string& tool, const std::string& effects) {
    return warningsOf(parseScene(sceneText(tool, effects)), {{body.greens, body.mesh}});
  };
  const auto ball = [&](double edges) {
    return "\"shape\": \"sphere\", \"radius\": " + std::to_string(edges * edge);
  };
  EXPECT_TRUE(warnings(ball(0.3), "").empty());
  ASSERT_EQ(warnings(ball(0.1), "").size(), 1u);
  EXPECT_NE(warnings(ball(0.1), "")[0].find("much smaller than the model's edges"),
            std::string::npos);
  EXPECT_TRUE(warnings(kPoint, "").empty());
  EXPECT_TRUE(warnings(kPoint, "\"masks\": {\"radius_edges\": 2}").empty());
  EXPECT_EQ(warnings(kPoint, "\"masks\": {\"radius_edges\": 0.3}").size(), 1u);
}

TEST(TouchSessions, RefuseWhatTheyCannotHold) {
  const TouchedBody body = touchedSphere(1, true);
  const std::vector<SceneBody> bodies = {{body.greens, body.mesh}};
  const auto refused = [&](const std::string& tool, const std::string& effects,
                           const std::string& sentence) {
    return isRefused([&] { TouchSession(parseScene(sceneText(tool, effects)), bodies); }, sentence);
  };
  EXPECT_TRUE(refused(kPoint, "\"probes\": [{\"name\": \"tip\", \"node\": 42}]",
                      "the probe 'tip' is at node 42, but the model has 42 nodes"));
  EXPECT_TRUE(refused(kPoint, "\"probes\": [{\"name\": \"tip\", \"position\": [0, 0, 9]}]",
                      "the probe 'tip' lies"));
  EXPECT_TRUE(
      refused("\"shape\": \"mesh\", \"file\": \"spoon\"", "", "the tool 'spoon' has no surface"));
  const Scene scene = parseScene(sceneText(kPoint, ""));
  EXPECT_TRUE(
      isRefused([&] { TouchSession(scene, {}); }, "the scene has 1 models, but there are 0"));
  EXPECT_TRUE(isRefused([&] { TouchSession(scene, {{nullptr, body.mesh}}); }, "has no surface or"));
  Scene mixed = parseScene(sceneText(kPoint + ";" + kPoint, ""));
  mixed.tools[1].shape = ToolShape::Plane;
  EXPECT_TRUE(isRefused([&] { TouchSession(mixed, bodies); }, "do not touch a surface together"));
}

}  // namespace
}  // namespace palpate::test
