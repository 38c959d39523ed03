// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

/// How this room's sources read what users write in JSON. Each mistake is a std::invalid_argument
/// of one sentence that begins with the way to its key: "tools[0].radius" must be ....
namespace palpate {

using Json = nlohmann::json;

/// @throws std::invalid_argument always.
[[noreturn]] void refuseKey(const std::string& path, const std::string& what);

/// A value as a sentence shows it: a number or a short text as it is, all else by its kind.
std::string shown(const Json& value);

/// @param subject  for people: "the description".
/// @throws std::invalid_argument for what is not JSON, for a key that is named twice in an object,
///         and for objects or lists within more than 32 others.
Json parseJson(const std::string& text, const std::string& subject);

/// @throws std::runtime_error if the file cannot be read, is empty or is longer than 16 MiB.
std::string readTextFile(const std::string& path, const std::string& subject);

/// An object whose keys are all asked for in the end.
class JsonSection {
 public:
  /// @param name  the way to it; empty for the whole text.
  JsonSection(const Json& value, std::string name, const std::string& subject = "");

  const Json* find(const std::string& key);
  const Json& need(const std::string& key);
  std::string path(const std::string& key) const;
  /// @throws naming the first key that was never asked for, and the nearest of those that were.
  void requireNothingElse() const;

 private:
  const Json& value_;
  std::string name_;
  std::vector<std::string> known_;
};

int readInteger(const Json& value, const std::string& path, int least, int most);
/// Finite, of at most this magnitude.
double readNumber(const Json& value, const std::string& path, double largest);
double readPositive(const Json& value, const std::string& path, double largest);
double readNotNegative(const Json& value, const std::string& path, double largest);
bool readFlag(const Json& value, const std::string& path);
/// Not empty and without zero bytes.
std::string readText(const Json& value, const std::string& path);
/// A list of so many numbers.
Eigen::VectorXd readNumberList(const Json& value, const std::string& path, int count,
                               double largest);
/// "0x1209", as tools print them, or a plain number.
std::uint16_t readUsbId(const Json& value, const std::string& path);
/// A list. @throws if it is none, or longer.
const Json& readList(const Json& value, const std::string& path, std::size_t most);
/// The way to an entry of a list.
std::string entryPath(const std::string& list, std::size_t index);

/// One of several names.
template <class Value>
Value readNamed(const Json& value, const std::string& path,
                std::initializer_list<std::pair<const char*, Value>> choices) {
  std::string names;
  for (const auto& [name, meaning] : choices) {
    if (value == name) return meaning;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  refuseKey(path, "must be one of " + names + ", not " + shown(value));
}

/// A key that may be left out: what reads it is given its value and path.
template <class Read>
void readIf(JsonSection& section, const char* key, const Read& read) {
  if (const Json* found = section.find(key)) read(*found, section.path(key));
}
template <class Value, class Read, class... Limits>
void readIf(JsonSection& section, const char* key, Value& value, const Read& read,
            Limits... limits) {
  if (const Json* found = section.find(key)) value = read(*found, section.path(key), limits...);
}

}  // namespace palpate
