// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_description.h"

#include <cmath>
#include <stdexcept>

#include "haptics/json_reader.h"

namespace palpate {
namespace {

// hidraw's own limit on a report.
constexpr int kLongestReport = 4096;

struct TypeName {
  const char* name;
  HidNumber::Type type;
  int bytes;
};
constexpr TypeName kTypes[] = {
    {"int8", HidNumber::Type::Int8, 1},       {"uint8", HidNumber::Type::Uint8, 1},
    {"int16", HidNumber::Type::Int16, 2},     {"uint16", HidNumber::Type::Uint16, 2},
    {"int32", HidNumber::Type::Int32, 4},     {"uint32", HidNumber::Type::Uint32, 4},
    {"float32", HidNumber::Type::Float32, 4},
};

const TypeName& readType(const Json& value, const std::string& path) {
  std::string names;
  for (const TypeName& type : kTypes) {
    if (value == type.name) return type;
    names += (names.empty() ? "" : ", ") + std::string(type.name);
  }
  refuseKey(path, "must be one of " + names);
}

struct ReportShape {
  int report, length;
};

HidNumber readHidNumber(const Json& value, const std::string& path, const ReportShape& shape,
                        bool isCounter) {
  JsonSection section(value, path);
  HidNumber number;
  const TypeName& type = readType(section.need("type"), section.path("type"));
  number.type = type.type;
  if (isCounter && type.name[0] != 'u')
    refuseKey(section.path("type"), "must be an unsigned integer");
  const int first = shape.report == 0 ? 0 : 1;
  number.offset =
      readInteger(section.need("offset"), section.path("offset"), first, shape.length - type.bytes);
  if (!isCounter) {
    if (const Json* scale = section.find("scale"))
      number.scale = readNumber(*scale, section.path("scale"), 1e6);
    if (!(std::abs(number.scale) >= 1e-12))
      refuseKey(section.path("scale"), "must not be zero, nor below 1e-12");
    if (const Json* bias = section.find("bias"))
      number.bias = readNumber(*bias, section.path("bias"), 1e6);
  }
  section.requireNothingElse();
  return number;
}

std::vector<HidDescription::Component> readNumbers(const Json& value, const std::string& path,
                                                   const ReportShape& shape, int least, int most) {
  if (!value.is_array() || static_cast<int>(value.size()) < least ||
      static_cast<int>(value.size()) > most)
    refuseKey(path, "must be a list of " + std::to_string(least) +
                        (most > least ? " to " + std::to_string(most) : "") + " numbers");
  std::vector<HidDescription::Component> numbers;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string at = entryPath(path, i);
    numbers.emplace_back();
    if (!value[i].is_null()) numbers.back() = readHidNumber(value[i], at, shape, false);
  }
  return numbers;
}

ReportShape readShape(JsonSection& section) {
  const int report = readInteger(section.need("report"), section.path("report"), 0, 255);
  return {report, readInteger(section.need("length"), section.path("length"), 1, kLongestReport)};
}

HidDescription::Input readInput(const Json& value) {
  JsonSection section(value, "input");
  const ReportShape shape = readShape(section);
  HidDescription::Input input;
  input.report = shape.report;
  input.length = shape.length;
  input.position = readNumbers(section.need("position"), section.path("position"), shape, 3, 3);
  if (const Json* found = section.find("orientation"))
    input.orientation = readNumbers(*found, section.path("orientation"), shape, 4, 4);
  if (const Json* found = section.find("joints"))
    input.joints = readNumbers(*found, section.path("joints"), shape, 1, ToolPose::kMostJoints);
  if (const Json* found = section.find("sequence"))
    input.sequence = readHidNumber(*found, section.path("sequence"), shape, true);
  if (const Json* found = section.find("buttons"))
    input.buttons = readHidNumber(*found, section.path("buttons"), shape, true);
  section.requireNothingElse();
  return input;
}

HidDescription::Output readOutput(const Json& value) {
  JsonSection section(value, "output");
  const ReportShape shape = readShape(section);
  HidDescription::Output output;
  output.report = shape.report;
  output.length = shape.length;
  output.force = readNumbers(section.need("force"), section.path("force"), shape, 3, 3);
  if (const Json* found = section.find("torque"))
    output.torque = readNumbers(*found, section.path("torque"), shape, 3, 3);
  if (const Json* found = section.find("sequence"))
    output.sequence = readHidNumber(*found, section.path("sequence"), shape, true);
  section.requireNothingElse();
  return output;
}

void readLimits(const Json& value, DeviceInfo& info) {
  JsonSection section(value, "limits");
  const auto read = [&](const char* key, double& limit) {
    const Json* found = section.find(key);
    if (!found) return;
    limit = readNumber(*found, section.path(key), 1e9);
    if (limit < 0) refuseKey(section.path(key), "must not be negative");
  };
  read("force", info.largestForce);
  read("torque", info.largestTorque);
  read("stiffness", info.largestStiffness);
  section.requireNothingElse();
}

}  // namespace

HidDescription parseHidDescription(const std::string& text) {
  const Json value = parseJson(text, "the description");
  JsonSection section(value, "", "a description");
  HidDescription description;
  const Json& name = section.need("name");
  description.info.name = readText(name, "name");
  description.vendor = readUsbId(section.need("vendor"), "vendor");
  description.product = readUsbId(section.need("product"), "product");
  description.input = readInput(section.need("input"));
  if (const Json* output = section.find("output")) description.output = readOutput(*output);
  if (const Json* limits = section.find("limits")) readLimits(*limits, description.info);
  section.requireNothingElse();
  if (description.output && description.info.largestForce == 0)
    refuseKey("limits.force", "is missing: with an output, the largest force must be known");
  return description;
}

HidDescription readHidDescription(const std::string& path) {
  const std::string text = readTextFile(path, "the description");
  try {
    return parseHidDescription(text);
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument("'" + path + "': " + wrong.what());
  }
}

}  // namespace palpate
