// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_description.h"

#include <gtest/gtest.h>

#include "support/refusals.h"
#include "support/temporary_path.h"

namespace palpate::test {
namespace {

const std::string kPaddle = R"({
  "name": "Two-axis paddle", "vendor": "0x1209", "product": 1,
  "input": {
    "report": 1, "length": 16,
    "position": [{"offset": 4, "type": "int16", "scale": 1e-5},
                 {"offset": 6, "type": "int16", "scale": 1e-5, "bias": -0.1}, null],
    "sequence": {"offset": 1, "type": "uint16"},
    "buttons": {"offset": 3, "type": "uint8"},
    "joints": [{"offset": 8, "type": "float32"}]
  },
  "output": {
    "report": 2, "length": 7,
    "force": [{"offset": 1, "type": "int16", "scale": 1e-3},
              {"offset": 3, "type": "int16", "scale": 1e-3}, null]
  },
  "limits": {"force": 3, "stiffness": 600}
})";

/// The paddle with one piece of text in place of another.
std::string with(const std::string& before, const std::string& after) {
  std::string text = kPaddle;
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(HidDescriptions, SayWhereNumbersStandAndWhatTheyMean) {
  const HidDescription d = parseHidDescription(kPaddle);
  EXPECT_EQ(d.info.name, "Two-axis paddle");
  EXPECT_EQ(d.vendor, 0x1209);
  EXPECT_EQ(d.product, 1);
  EXPECT_EQ(d.info.largestForce, 3);
  EXPECT_EQ(d.info.largestTorque, 0);
  EXPECT_EQ(d.info.largestStiffness, 600);
  EXPECT_EQ(d.input.length, 16);
  ASSERT_EQ(d.input.position.size(), 3u);
  EXPECT_EQ(d.input.position[1]->offset, 6);
  EXPECT_EQ(d.input.position[1]->bias, -0.1);
  EXPECT_FALSE(d.input.position[2]);
  EXPECT_TRUE(d.input.orientation.empty());
  EXPECT_EQ(d.input.joints[0]->type, HidNumber::Type::Float32);
  EXPECT_EQ(d.input.joints[0]->scale, 1);
  ASSERT_TRUE(d.output);
  EXPECT_EQ(d.output->force[0]->scale, 1e-3);
  EXPECT_FALSE(d.output->sequence);
}

TEST(HidDescriptions, EveryMistakeNamesItsKey) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"\"name\": \"Two-axis paddle\", ", "", "\"name\" is missing"},
      {"\"Two-axis paddle\"", "7", "\"name\" must be a text"},
      {"\"0x1209\"", "\"1209\"", "\"vendor\" must be a number like \"0x1209\""},
      {"\"0x1209\"", "65536", "\"vendor\" must be a whole number from 0 to 65535"},
      {"\"product\": 1", "\"product\": 1.5", "\"product\" must be a whole number"},
      {"\"limits\"", "\"limit\"", "\"limit\" is not a key that is known here"},
      {"\"stiffness\"", "\"stifness\"", "\"limits.stifness\" is not a key"},
      {"600", "-600", "\"limits.stiffness\" must not be negative"},
      {"\"force\": 3", "\"torque\": 3", "\"limits.force\" is missing: with an output"},
      {"\"report\": 1", "\"report\": 256", "\"input.report\" must be a whole number from 0 to 255"},
      {"\"length\": 16", "\"length\": 0", "\"input.length\" must be a whole number from 1 to 4096"},
      {"\"length\": 16", "\"length\": 11",
       "\"input.joints[0].offset\" must be a whole number from 1 to 7"},
      {"\"offset\": 4", "\"offset\": 0",
       "\"input.position[0].offset\" must be a whole number from 1"},
      {"\"offset\": 4", "\"offset\": 18446744073709551615", "\"input.position[0].offset\" must be"},
      {"\"offset\": 4,", "", "\"input.position[0].offset\" is missing"},
      {"\"int16\", \"scale\": 1e-5}", "\"int12\"}",
       "\"input.position[0].type\" must be one of int8, uint8"},
      {"\"int16\", \"scale\": 1e-5}", "\"int16\", \"scale\": 0}",
       "\"input.position[0].scale\" must not be zero"},
      {"\"int16\", \"scale\": 1e-5}", "\"int16\", \"scale\": 1e7}",
       "\"input.position[0].scale\" must be a number of at most"},
      {"\"int16\", \"scale\": 1e-5}", "\"int16\", \"sacle\": 1}",
       "\"input.position[0].sacle\" is not a key"},
      {"-0.1}, null]", "-0.1}]", "\"input.position\" must be a list of 3 numbers"},
      {"\"bias\": -0.1}, null", "\"bias\": -0.1}, 5",
       "\"input.position[2]\" must be an object in braces"},
      {"\"type\": \"uint16\"", "\"type\": \"float32\"",
       "\"input.sequence.type\" must be an unsigned integer"},
      {"\"type\": \"uint8\"", "\"type\": \"uint8\", \"scale\": 2",
       "\"input.buttons.scale\" is not a key"},
      {"\"force\": [", "\"forces\": [", "\"output.force\" is missing"},
      {"-0.1", "1e999", "beyond all that a double can hold"},
  };
  for (const auto& [before, after, sentence] : cases)
    EXPECT_TRUE(
        isRefused([&, b = before, a = after] { parseHidDescription(with(b, a)); }, sentence));
  EXPECT_TRUE(isRefused([] { parseHidDescription("[]"); }, "a description is an object in braces"));
}

TEST(HidDescriptions, CutShortAnywhereAreRefused) {
  for (std::size_t length = 0; length < kPaddle.size(); ++length)
    EXPECT_TRUE(isRefused([&] { parseHidDescription(kPaddle.substr(0, length)); },
                          "the description is not JSON from byte"));
}

TEST(HidDescriptions, MistakesInAFileNameTheFile) {
  const TemporaryPath good(kPaddle);
  EXPECT_EQ(readHidDescription(good.path()).product, 1);
  const TemporaryPath bad("{}");
  EXPECT_TRUE(isRefused([&] { readHidDescription(bad.path()); },
                        "'" + bad.path() + "': \"name\" is missing"));
  EXPECT_TRUE(isRefused<std::runtime_error>([] { readHidDescription("no/such"); },
                                            "'no/such' cannot be opened"));
}

}  // namespace
}  // namespace palpate::test
