// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/refusals.h"
#include "support/temporary_path.h"

namespace palpate::test {
namespace {

const std::string kShapes = R"({
  "models": [{"file": "kidney.vtp", "density": 1050},
             {"file": "../nodule.vtp", "position": [0, 0, 0.05], "density": 1000,
              "orientation": {"axis": [0, 0, 2], "angle": 1.5}, "friction": 0.7}],
  "tools": [{"shape": "sphere", "radius": 0.008, "device": "ball"},
            {"shape": "capsule", "radius": 0.002, "length": 0.1, "device": "rod"},
            {"shape": "mesh", "file": "spoon.vtp", "device": "stick"},
            {"shape": "hand", "side": "left", "device": "glove"},
            {"shape": "plane", "device": "table"}],
  "devices": [{"name": "ball", "type": "mouse"},
              {"name": "rod", "type": "hid", "vendor_id": "0x046d", "product_id": 50726,
               "mapping": {"scale": 0.5, "origin": [0, 0, 0.08], "rotation": [2, 0, 0, 0],
                           "force_scale": 3}},
              {"name": "stick", "type": "hid", "description": "board.json"},
              {"name": "glove", "type": "scripted", "file": "trace.txt"},
              {"name": "table", "type": "simulated"}],
  "effects": {"deformation": "visible", "friction": {"mu": 0.3}, "unilateral": true,
              "torque": true, "gravity": [0, 0, -9.81], "stiffness_limit": 2000,
              "stiffness_scale": 1.5, "elastic_elastic": true,
              "probes": [{"name": "top", "node": 7}, {"name": "side", "position": [0, 1, 0]},
                         {"name": "tumour", "inside": [0, 0, 0.5], "von_mises_limit": 4e3,
                          "gradient_limit": 0.1}]},
  "servo": {"rate": 500, "budget": 0.5, "snapshot_ticks": 2, "passivity_damping": 1.5,
            "real_time": false, "processor": 1},
  "safety": {"largest_force": 8, "largest_torque": 0.2, "force_slew": 2000, "torque_slew": 50,
             "ramp_seconds": 0.25},
  "solver": {"capacity": 64, "margin": 0.001, "linearisations": 2, "tolerance": 1e-6,
             "largest_iterations": 20, "largest_updates": 8,
             "largest_work": 1e6}
})";

const std::string kPoint = R"({
  "models": [{"file": "kidney.vtp"}],
  "tools": [{"shape": "point", "device": "mouse"}],
  "devices": [{"name": "mouse", "type": "mouse"}],
  "effects": {"masks": {"shape": "gaussian", "radius_edges": 2}}
})";

/// A text with one piece of it in place of another.
std::string with(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(Scenes, SayWhatIsTouchedWithWhatAndWhatOfItIsSimulated) {
  const Scene scene = parseScene(kShapes);
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.models[0].file, "kidney.vtp");
  EXPECT_EQ(scene.models[0].density, 1050);
  EXPECT_EQ(scene.models[1].pose.position.z(), 0.05);
  EXPECT_NEAR(scene.models[1].pose.orientation.z(), std::sin(0.75), 1e-15);
  EXPECT_EQ(scene.models[1].friction, 0.7);
  ASSERT_EQ(scene.tools.size(), 5u);
  EXPECT_EQ(scene.tools[0].radius, 0.008);
  EXPECT_EQ(scene.tools[1].length, 0.1);
  EXPECT_EQ(scene.tools[2].file, "spoon.vtp");
  EXPECT_EQ(scene.tools[3].side, HandSide::Left);
  EXPECT_EQ(scene.tools[3].length, 0.19);
  EXPECT_EQ(scene.tools[4].device, 4);
  EXPECT_FALSE(scene.isOfPoints());
  EXPECT_EQ(scene.devices[1].vendor, 0x046d);
  EXPECT_EQ(scene.devices[1].product, 0xc626);
  EXPECT_EQ(scene.devices[1].mapping.scale, 0.5);
  EXPECT_EQ(scene.devices[1].mapping.origin.z(), 0.08);
  EXPECT_EQ(scene.devices[1].mapping.rotation.w(), 1);
  EXPECT_EQ(scene.devices[1].mapping.forceScale, 3);
  EXPECT_EQ(scene.devices[2].description, "board.json");
  EXPECT_EQ(scene.devices[3].file, "trace.txt");
  EXPECT_EQ(scene.effects.deformation, DeformationRows::Visible);
  EXPECT_EQ(scene.effects.friction, 0.3);
  EXPECT_TRUE(scene.effects.unilateral);
  EXPECT_TRUE(scene.effects.torque);
  EXPECT_EQ(scene.effects.gravity.z(), -9.81);
  EXPECT_EQ(scene.effects.stiffnessScale, 1.5);
  ASSERT_EQ(scene.effects.probes.size(), 3u);
  EXPECT_EQ(scene.effects.probes[0].node, 7);
  EXPECT_EQ(scene.effects.probes[1].position.y(), 1);
  EXPECT_FALSE(scene.effects.probes[1].isInside);
  EXPECT_TRUE(scene.effects.probes[2].isInside);
  EXPECT_EQ(scene.effects.probes[2].position.z(), 0.5);
  EXPECT_EQ(scene.effects.probes[2].limits.vonMises, 4e3);
  EXPECT_EQ(scene.effects.probes[2].limits.gradient, 0.1);
  EXPECT_EQ(scene.servo.rate, 500);
  EXPECT_EQ(scene.servo.snapshotTicks, 2);
  EXPECT_EQ(scene.servo.passivityDamping, 1.5);
  EXPECT_FALSE(scene.servo.realTime);
  EXPECT_EQ(scene.servo.processor, 1);
  EXPECT_EQ(scene.safety.largestForce, 8);
  EXPECT_EQ(scene.safety.largestTorque, 0.2);
  EXPECT_EQ(scene.safety.forceSlew, 2000);
  EXPECT_EQ(scene.safety.torqueSlew, 50);
  EXPECT_EQ(scene.safety.rampSeconds, 0.25);
  EXPECT_EQ(scene.solver.capacity, 64);
  EXPECT_EQ(scene.solver.margin, 0.001);
  EXPECT_EQ(scene.solver.solver.largestUpdates, 8);
  EXPECT_EQ(scene.solver.solver.largestWork, 1e6);
}

TEST(Scenes, OfOnePointNeedFourLines) {
  const Scene scene = parseScene(kPoint);
  EXPECT_TRUE(scene.isOfPoints());
  EXPECT_EQ(scene.effects.maskShape, MaskShape::Gaussian);
  EXPECT_EQ(scene.effects.maskRadiusEdges, 2);
  EXPECT_EQ(scene.effects.maskRadius, 0);
  EXPECT_EQ(scene.effects.deformation, DeformationRows::All);
  EXPECT_EQ(scene.effects.friction, 0);
  EXPECT_FALSE(scene.effects.unilateral);
  EXPECT_FALSE(scene.effects.torque);
  EXPECT_TRUE(scene.effects.gravity.isZero(0));
  EXPECT_EQ(scene.effects.stiffnessScale, 1);
  EXPECT_EQ(scene.servo.rate, 1000);
}

TEST(Scenes, LetToolsHoldWhatTheyTouch) {
  EXPECT_FALSE(parseScene(with(kShapes, "\"unilateral\": true", "\"unilateral\": false"))
                   .effects.unilateral);
  EXPECT_TRUE(parseScene(with(kShapes, "\"unilateral\": true,", "")).effects.unilateral);
  EXPECT_FALSE(
      parseScene(with(kPoint, "\"masks\"", "\"unilateral\": false, \"masks\"")).effects.unilateral);
}

TEST(Scenes, EveryMistakeNamesItsKey) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"0.008", "-1",
       "scene: \"tools[0].radius\" must be a positive number of at most 1e+06, not -1"},
      {"0.008", "\"8 mm\"",
       "\"tools[0].radius\" must be a positive number of at most 1e+06, not \"8 mm\""},
      {"0.008", "0", "\"tools[0].radius\" must be a positive number"},
      {"0.008", "1e300", "\"tools[0].radius\" must be a positive number"},
      {"0.008", "1e999", "beyond all that a double can hold"},
      {"0.008", "NaN", "is not JSON from byte"},
      {"\"radius\": 0.008, ", "", "\"tools[0].radius\" is missing"},
      {"\"radius\": 0.008", "\"raduis\": 0.008", "\"tools[0].radius\" is missing"},
      {"\"length\": 0.1", "\"length\": null",
       "\"tools[1].length\" must be a positive number of at most 1e+06, not null"},
      {"\"file\": \"spoon.vtp\"", "\"file\": 7", "\"tools[2].file\" must be a text"},
      {"\"file\": \"spoon.vtp\"", "\"file\": \"\"", "\"tools[2].file\" must not be empty"},
      {"spoon.vtp", "spoon\\u0000.vtp", "\"tools[2].file\" must not hold a zero byte"},
      {"\"left\"", "\"both\"", "\"tools[3].side\" must be one of left, right, not \"both\""},
      {"\"sphere\"", "\"ball\"",
       "\"tools[0].shape\" must be one of point, sphere, capsule, plane, mesh, hand, not \"ball\""},
      {"\"plane\"", "\"point\"", "\"tools[4].shape\" must be a point as the other tools are"},
      {"\"plane\"", "\"plane\", \"radius\": 1",
       "\"tools[4].radius\" is not a key that is known here"},
      {"\"device\": \"table\"", "\"device\": \"desk\"",
       "\"tools[4].device\" names no device of the scene: there are \"ball\", \"rod\""},
      {"\"device\": \"table\"", "\"device\": \"ball\"",
       "\"tools[4].device\" moves another tool already"},
      {"{\"shape\": \"plane\", \"device\": \"table\"}", "5",
       "\"tools[4]\" must be an object in braces"},
      {",\n            {\"shape\": \"plane\", \"device\": \"table\"}", "",
       "\"devices[4]\" moves no tool"},
      {"\"name\": \"table\"", "\"name\": \"ball\"",
       "\"devices[4].name\" must be its own: there is another \"ball\""},
      {"\"name\": \"table\", ", "", "\"devices[4].name\" is missing"},
      {"\"simulated\"", "\"simulation\"",
       "\"devices[4].type\" must be one of mouse, scripted, simulated, hid, not \"simulation\""},
      {", \"file\": \"trace.txt\"", "", "\"devices[3].file\" is missing"},
      {"\"mouse\"}", "\"mouse\", \"file\": \"x\"}",
       "\"devices[0].file\" is not a key that is known here"},
      {", \"product_id\": 50726", "",
       "\"devices[1].product_id\" is missing: a hid device is found by"},
      {"50726", "65536",
       "\"devices[1].product_id\" must be a whole number from 0 to 65535, not 65536"},
      {"0x046d", "046d", "\"devices[1].vendor_id\" must be a number like"},
      {"\"description\": \"board.json\"", "\"description\": \"board.json\", \"vendor_id\": 1",
       "\"devices[2].vendor_id\" is in the device's description already"},
      {"\"scale\": 0.5", "\"scale\": 0", "\"devices[1].mapping.scale\" must be a positive number"},
      {"\"origin\": [0, 0, 0.08]", "\"origin\": [0, 0]",
       "\"devices[1].mapping.origin\" must be a list of 3 numbers, not a list of 2"},
      {"\"origin\": [0, 0, 0.08]", "\"origin\": [0, {}, 0]",
       "\"devices[1].mapping.origin[1]\" must be a number of at most 1e+06, not an object"},
      {"[2, 0, 0, 0]", "[0, 0, 0, 0]", "\"devices[1].mapping.rotation\" must not be zero"},
      {"[2, 0, 0, 0]", "\"up\"",
       "\"devices[1].mapping.rotation\" must be a quaternion [w, x, y, z] or"},
      {"\"force_scale\": 3", "\"force_scale\": -3",
       "\"devices[1].mapping.force_scale\" must be a number from 0"},
      {"\"force_scale\"", "\"forcescale\"",
       "\"devices[1].mapping.forcescale\" is not a key that is known here: the nearest is "
       "\"force_scale\""},
      {"\"density\": 1050", "\"density\": -1", "\"models[0].density\" must be a positive number"},
      {", \"density\": 1050", "",
       "\"models[0].density\" is missing: with gravity, each model has one"},
      {"\"density\": 1050", "\"position\": [0, 0, 1]", "\"models[0].position\" must be zero"},
      {"\"density\": 1050", "\"orientation\": [0, 1, 0, 0]",
       "\"models[0].orientation\" must be none"},
      {"\"density\": 1050", "\"friction\": 1",
       "\"models[0].friction\" is between a further model and the first"},
      {"\"axis\": [0, 0, 2]", "\"axis\": [0, 0, 0]",
       "\"models[1].orientation.axis\" must not be zero"},
      {", \"angle\": 1.5", "", "\"models[1].orientation.angle\" is missing"},
      {"\"friction\": 0.7", "\"friction\": \"some\"",
       "\"models[1].friction\" must be a number from 0 to 100, not \"some\""},
      {"\"visible\"", "\"some\"",
       "\"effects.deformation\" must be one of all, visible, contact, none, not \"some\""},
      {"{\"mu\": 0.3}", "0.3", "\"effects.friction\" must be an object in braces"},
      {"{\"mu\": 0.3}", "{}", "\"effects.friction.mu\" is missing"},
      {"\"mu\": 0.3", "\"mu\": -0.3", "\"effects.friction.mu\" must be a number from 0"},
      {"\"unilateral\": true", "\"unilateral\": 1",
       "\"effects.unilateral\" must be true or false, not 1"},
      {"\"torque\": true", "\"torque\": \"yes\"", "\"effects.torque\" must be true or false"},
      {"\"gravity\": [0, 0, -9.81]", "\"gravity\": -9.81",
       "\"effects.gravity\" must be a list of 3 numbers, not -9.81"},
      {"\"stiffness_limit\": 2000", "\"stiffness_limit\": -1",
       "\"effects.stiffness_limit\" must be a number from 0"},
      {"\"stiffness_scale\": 1.5", "\"stiffness_scale\": 0",
       "\"effects.stiffness_scale\" must be a positive number"},
      {"\"elastic_elastic\": true", "\"elastic_elastic\": false",
       "\"models[1]\" meets the first only if effects.elastic_elastic is true"},
      {"{\"name\": \"glove\", \"type\": \"scripted\", \"file\": \"trace.txt\"}",
       "{\"name\": \"glove\", \"type\": \"mouse\"}", "\"tools[3].device\" must have joints"},
      {"\"torque\": true", "\"masks\": {}", "\"effects.masks\" are of points"},
      {"\"torque\": true", "\"wind\": 5",
       "\"effects.wind\" is not a key that is known here: the nearest is"},
      {"\"node\": 7", "\"node\": 7.5", "\"effects.probes[0].node\" must be a whole number"},
      {"\"node\": 7", "\"node\": -7", "\"effects.probes[0].node\" must be a whole number"},
      {", \"node\": 7", "", "\"effects.probes[0]\" must have one of node, position and inside"},
      {"\"name\": \"side\"", "\"name\": \"top\"", "\"effects.probes[1].name\" must be its own"},
      {"\"inside\": [0, 0, 0.5]", "\"node\": 3",
       "\"effects.probes[2].gradient_limit\" is not a key that is known here"},
      {"\"gradient_limit\": 0.1", "\"gradient_limit\": 0",
       "\"effects.probes[2].gradient_limit\" must be a positive number"},
      {"\"rate\": 500", "\"rate\": 100",
       "\"servo.rate\" must be a number from 250 to 10000, not 100"},
      {"\"rate\": 500", "\"rate\": 1e5",
       "\"servo.rate\" must be a positive number of at most 10000"},
      {"\"budget\": 0.5", "\"budget\": 2",
       "\"servo.budget\" must be a positive number of at most 1, not 2"},
      {"\"snapshot_ticks\": 2", "\"snapshot_ticks\": 0",
       "\"servo.snapshot_ticks\" must be a whole number from 1"},
      {"\"passivity_damping\": 1.5", "\"passivity_damping\": -1",
       "\"servo.passivity_damping\" must be"},
      {"\"real_time\": false", "\"real_time\": []",
       "\"servo.real_time\" must be true or false, not a list of 0"},
      {"\"processor\": 1", "\"processor\": -1",
       "\"servo.processor\" must be a whole number from 0"},
      {"\"rate\"", "\"hertz\"", "\"servo.hertz\" is not a key"},
      {"\"capacity\": 64", "\"capacity\": 99999999999999999999",
       "\"solver.capacity\" must be a whole number"},
      {"\"margin\": 0.001", "\"margin\": -1", "\"solver.margin\" must be"},
      {"\"linearisations\": 2", "\"linearisations\": 0", "\"solver.linearisations\" must be"},
      {"\"linearisations\": 2", "\"linearisations\": 21", "\"solver.linearisations\" must be"},
      {"\"tolerance\": 1e-6", "\"tolerance\": 0", "\"solver.tolerance\" must be"},
      {"\"largest_iterations\": 20", "\"largest_iterations\": 0",
       "\"solver.largest_iterations\" must"},
      {"\"largest_force\": 8", "\"largest_force\": -8", "\"safety.largest_force\" must"},
      {"\"force_slew\": 2000", "\"force_slew\": 0", "\"safety.force_slew\" must"},
      {"\"ramp_seconds\": 0.25", "\"ramp_seconds\": 0", "\"safety.ramp_seconds\" must"},
      {"\"largest_torque\": 0.2", "\"fade\": 0.2", "\"safety.fade\""},
      {"\"largest_updates\": 8", "\"largest_updates\": -8", "\"solver.largest_updates\" must"},
      {"\"largest_updates\": 8", "\"largest_updates\": 0",
       "\"solver.largest_updates\" must be at least 1: without a limit the servo loop would wait"},
      {"\"largest_work\": 1e6", "\"largest_work\": 0", "\"solver.largest_work\" must"},
      {"\"largest_updates\": 8", "\"capacity\": 8",
       "the key \"capacity\" is named twice in one object"},
      {"\"models\"", "\"model\"", "\"models\" is missing"},
      {"\"servo\"", "\"sevro\"",
       "\"sevro\" is not a key that is known here: the nearest is \"servo\""},
  };
  for (const auto& [before, after, sentence] : cases) {
    const std::string said =
        refusal([&, b = before, a = after] { parseScene(with(kShapes, b, a)); });
    EXPECT_TRUE(contains(said, sentence));
    EXPECT_EQ(said.find("scene: "), 0u) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(Scenes, OfPointsRefuseWhatIsOfShapes) {
  const std::pair<const char*, const char*> cases[] = {
      {"\"unilateral\": true", "\"effects.unilateral\" must be false for points"},
      {"\"torque\": true", "\"effects.torque\" must be false for points"},
      {"\"elastic_elastic\": true", "\"effects.elastic_elastic\" must be false with points"},
      {"\"masks\": {\"radius\": 1, \"radius_edges\": 1}", "a radius or radius_edges, and not both"},
      {"\"masks\": {\"radius\": -1}", "\"effects.masks.radius\" must be a number from 0"},
      {"\"masks\": {\"radius_edges\": -1}",
       "\"effects.masks.radius_edges\" must be a number from 0"},
      {"\"masks\": {\"shape\": \"square\"}", "\"effects.masks.shape\" must be one of linear"},
      {"\"masks\": {\"size\": 1}", "\"effects.masks.size\" is not a key that is known here"},
  };
  const std::string masks = "\"masks\": {\"shape\": \"gaussian\", \"radius_edges\": 2}";
  for (const auto& [effect, sentence] : cases)
    EXPECT_TRUE(isRefused([&, e = effect] { parseScene(with(kPoint, masks, e)); }, sentence));
  EXPECT_TRUE(
      isRefused([&] { parseScene(with(kPoint, "\"effects\"", "\"solver\": {}, \"effects\"")); },
                "\"solver\" is of tools with a shape"));
  EXPECT_TRUE(isRefused(
      [&] { parseScene(with(kPoint, "[{\"shape\": \"point\", \"device\": \"mouse\"}]", "[]")); },
      "\"tools\" must have an entry"));
  EXPECT_TRUE(isRefused([&] { parseScene(with(kPoint, "[{\"file\": \"kidney.vtp\"}]", "[]")); },
                        "\"models\" must have an entry"));
  EXPECT_TRUE(isRefused(
      [&] { parseScene(with(kPoint, "[{\"name\": \"mouse\", \"type\": \"mouse\"}]", "[]")); },
      "\"tools[0].device\" names no device of the scene: there is none"));
}

TEST(Scenes, CutShortAnywhereAreRefused) {
  for (std::size_t length = 0; length < kShapes.size(); ++length)
    EXPECT_TRUE(isRefused([&] { parseScene(kShapes.substr(0, length)); },
                          "scene: the text is not JSON from byte"));
}

/// Every byte in turn replaced by another: a scene or a sentence, nothing else.
TEST(Scenes, WithAnyByteChangedAreReadOrRefused) {
  for (const char byte : {'"', '{', ']', '-', '9', '\\', '\0', '\xff'})
    for (std::size_t at = 0; at < kShapes.size(); ++at) {
      std::string text = kShapes;
      text[at] = byte;
      try {
        parseScene(text);
      } catch (const std::invalid_argument& refused) {
        EXPECT_TRUE(contains(refused.what(), "scene: "));
      }
    }
}

TEST(Scenes, HostileTextsAreRefused) {
  const std::string deep(100000, '[');
  EXPECT_TRUE(isRefused([&] { parseScene(deep); }, "within more than 32 others"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"models\":";
  EXPECT_TRUE(isRefused([&] { parseScene(objects); }, "within more than 32 others"));
  EXPECT_TRUE(isRefused([] { parseScene("[]"); }, "scene: it is an object in braces"));
  EXPECT_TRUE(isRefused([] { parseScene("7"); }, "scene: it is an object in braces"));
  std::string many = "{\"tools\": [], \"devices\": [0";
  for (int i = 0; i < 2000; ++i) many += ",0";
  EXPECT_TRUE(isRefused([&] { parseScene(many + "]}"); }, "at most 1000 entries, not 2001"));
  const std::string longKey(100000, 'x');
  const std::string said = refusal([&] {
    parseScene(with(kPoint, "\"effects\": {", "\"effects\": {\"" + longKey + "\": 1, "));
  });
  EXPECT_LT(said.size(), 300u);
  EXPECT_LT(refusal([&] { parseScene(with(kPoint, "\"point\"", "\"" + longKey + "\"")); }).size(),
            300u);
}

TEST(Scenes, FilesAreFoundFromTheScenesFolder) {
  const TemporaryPath file(kShapes);
  const std::string folder = file.path().substr(0, file.path().rfind('/') + 1);
  const Scene scene = readScene(file.path());
  EXPECT_EQ(scene.models[0].file, folder + "kidney.vtp");
  EXPECT_EQ(scene.models[1].file.find(".."), std::string::npos);
  EXPECT_EQ(scene.tools[2].file, folder + "spoon.vtp");
  EXPECT_EQ(scene.tools[0].file, "");
  EXPECT_EQ(scene.devices[2].description, folder + "board.json");
  EXPECT_EQ(scene.devices[3].file, folder + "trace.txt");
  EXPECT_TRUE(isRefused<std::runtime_error>([] { readScene("no/such"); },
                                            "the scene 'no/such' cannot be opened"));
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { readScene(folder); }, "is a folder"));
  const TemporaryPath empty("");
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { readScene(empty.path()); }, "is empty"));
}

TEST(Scenes, OfTheDataFolderAreRead) {
  const std::string folder = PALPATE_DATA_DIRECTORY "/scenes/";
  const Scene ball = readScene(folder + "kidney_ball.json");
  EXPECT_EQ(ball.tools[0].radius, 0.008);
  EXPECT_EQ(ball.models[0].file, folder + "kidney.vtp");
  EXPECT_TRUE(readScene(folder + "nodule_point.json").isOfPoints());
  EXPECT_TRUE(readScene(folder + "two_kidneys_hand.json").effects.elasticElastic);
}

TEST(Scenes, MistakesInAFileNameTheFile) {
  const TemporaryPath file("{}");
  EXPECT_TRUE(isRefused([&] { readScene(file.path()); },
                        "'" + file.path() + "': scene: \"tools\" is missing"));
}

}  // namespace
}  // namespace palpate::test
