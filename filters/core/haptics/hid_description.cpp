// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_description.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace palpate {
namespace {

using nlohmann::json;

// hidraw's own limit on a report.
constexpr int kLongestReport = 4096;

[[noreturn]] void refuse(const std::string& key, const std::string& what) {
  throw std::invalid_argument("\"" + key + "\" " + what);
}

std::string under(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

/// An object whose keys are all asked for in the end.
class Section {
 public:
  Section(const json& value, std::string name) : value_(value), name_(std::move(name)) {
    if (!value.is_object())
      throw std::invalid_argument(name_.empty() ? "a description is an object in braces"
                                                : "\"" + name_ + "\" must be an object in braces");
  }

  const json* find(const std::string& key) {
    known_.push_back(key);
    const auto found = value_.find(key);
    return found == value_.end() ? nullptr : &*found;
  }

  const json& need(const std::string& key) {
    const json* found = find(key);
    if (!found) refuse(path(key), "is missing");
    return *found;
  }

  std::string path(const std::string& key) const { return under(name_, key); }

  void requireNothingElse() const {
    for (const auto& item : value_.items())
      if (std::find(known_.begin(), known_.end(), item.key()) == known_.end())
        refuse(path(item.key()), "is not a key that is known here");
  }

 private:
  const json& value_;
  std::string name_;
  std::vector<std::string> known_;
};

int readInteger(const json& value, const std::string& path, int least, int most) {
  if (value.is_number_integer() && value >= least && value <= most) return value.get<int>();
  refuse(path,
         "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

double readNumber(const json& value, const std::string& path, double largest) {
  if (value.is_number() && std::abs(value.get<double>()) <= largest) return value.get<double>();
  std::ostringstream limit;
  limit << largest;
  refuse(path, "must be a number of at most " + limit.str());
}

/// "0x1209", as tools print them, or a plain number.
std::uint16_t readId(const json& value, const std::string& path) {
  if (!value.is_string()) return static_cast<std::uint16_t>(readInteger(value, path, 0, 0xffff));
  const auto& text = value.get_ref<const std::string&>();
  const bool isHex = text.size() > 2 && text.size() <= 6 && text.compare(0, 2, "0x") == 0 &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string::npos;
  if (!isHex) refuse(path, "must be a number like \"0x1209\"");
  return static_cast<std::uint16_t>(std::stoul(text, nullptr, 16));
}

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

const TypeName& readType(const json& value, const std::string& path) {
  std::string names;
  for (const TypeName& type : kTypes) {
    if (value == type.name) return type;
    names += (names.empty() ? "" : ", ") + std::string(type.name);
  }
  refuse(path, "must be one of " + names);
}

struct ReportShape {
  int report, length;
};

HidNumber readHidNumber(const json& value, const std::string& path, const ReportShape& shape,
                        bool isCounter) {
  Section section(value, path);
  HidNumber number;
  const TypeName& type = readType(section.need("type"), section.path("type"));
  number.type = type.type;
  if (isCounter && type.name[0] != 'u') refuse(section.path("type"), "must be an unsigned integer");
  const int first = shape.report == 0 ? 0 : 1;
  number.offset =
      readInteger(section.need("offset"), section.path("offset"), first, shape.length - type.bytes);
  if (!isCounter) {
    if (const json* scale = section.find("scale"))
      number.scale = readNumber(*scale, section.path("scale"), 1e6);
    if (!(std::abs(number.scale) >= 1e-12))
      refuse(section.path("scale"), "must not be zero, nor below 1e-12");
    if (const json* bias = section.find("bias"))
      number.bias = readNumber(*bias, section.path("bias"), 1e6);
  }
  section.requireNothingElse();
  return number;
}

std::vector<HidDescription::Component> readNumbers(const json& value, const std::string& path,
                                                   const ReportShape& shape, int least, int most) {
  if (!value.is_array() || static_cast<int>(value.size()) < least ||
      static_cast<int>(value.size()) > most)
    refuse(path, "must be a list of " + std::to_string(least) +
                     (most > least ? " to " + std::to_string(most) : "") + " numbers");
  std::vector<HidDescription::Component> numbers;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string at = path + "[" + std::to_string(i) + "]";
    numbers.emplace_back();
    if (!value[i].is_null()) numbers.back() = readHidNumber(value[i], at, shape, false);
  }
  return numbers;
}

ReportShape readShape(Section& section) {
  const int report = readInteger(section.need("report"), section.path("report"), 0, 255);
  return {report, readInteger(section.need("length"), section.path("length"), 1, kLongestReport)};
}

HidDescription::Input readInput(const json& value) {
  Section section(value, "input");
  const ReportShape shape = readShape(section);
  HidDescription::Input input;
  input.report = shape.report;
  input.length = shape.length;
  input.position = readNumbers(section.need("position"), section.path("position"), shape, 3, 3);
  if (const json* found = section.find("orientation"))
    input.orientation = readNumbers(*found, section.path("orientation"), shape, 4, 4);
  if (const json* found = section.find("joints"))
    input.joints = readNumbers(*found, section.path("joints"), shape, 1, ToolPose::kMostJoints);
  if (const json* found = section.find("sequence"))
    input.sequence = readHidNumber(*found, section.path("sequence"), shape, true);
  if (const json* found = section.find("buttons"))
    input.buttons = readHidNumber(*found, section.path("buttons"), shape, true);
  section.requireNothingElse();
  return input;
}

HidDescription::Output readOutput(const json& value) {
  Section section(value, "output");
  const ReportShape shape = readShape(section);
  HidDescription::Output output;
  output.report = shape.report;
  output.length = shape.length;
  output.force = readNumbers(section.need("force"), section.path("force"), shape, 3, 3);
  if (const json* found = section.find("torque"))
    output.torque = readNumbers(*found, section.path("torque"), shape, 3, 3);
  if (const json* found = section.find("sequence"))
    output.sequence = readHidNumber(*found, section.path("sequence"), shape, true);
  section.requireNothingElse();
  return output;
}

void readLimits(const json& value, DeviceInfo& info) {
  Section section(value, "limits");
  const auto read = [&](const char* key, double& limit) {
    const json* found = section.find(key);
    if (!found) return;
    limit = readNumber(*found, section.path(key), 1e9);
    if (limit < 0) refuse(section.path(key), "must not be negative");
  };
  read("force", info.largestForce);
  read("torque", info.largestTorque);
  read("stiffness", info.largestStiffness);
  section.requireNothingElse();
}

}  // namespace

HidDescription parseHidDescription(const std::string& text) {
  json value;
  try {
    value = json::parse(text);
  } catch (const json::parse_error& error) {
    throw std::invalid_argument("the description is not JSON from byte " +
                                std::to_string(error.byte) + " on");
  } catch (const json::out_of_range&) {
    throw std::invalid_argument("the description holds a number beyond all that a double can hold");
  }
  Section section(value, "");
  HidDescription description;
  const json& name = section.need("name");
  if (!name.is_string()) refuse("name", "must be a text");
  description.info.name = name.get<std::string>();
  description.vendor = readId(section.need("vendor"), "vendor");
  description.product = readId(section.need("product"), "product");
  description.input = readInput(section.need("input"));
  if (const json* output = section.find("output")) description.output = readOutput(*output);
  if (const json* limits = section.find("limits")) readLimits(*limits, description.info);
  section.requireNothingElse();
  if (description.output && description.info.largestForce == 0)
    refuse("limits.force", "is missing: with an output, the largest force must be known");
  return description;
}

HidDescription readHidDescription(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("the description '" + path + "' cannot be opened");
  std::ostringstream text;
  text << file.rdbuf();
  try {
    return parseHidDescription(text.str());
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument("'" + path + "': " + wrong.what());
  }
}

}  // namespace palpate
