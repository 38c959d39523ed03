// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/json_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

namespace palpate {
namespace {

constexpr int kDeepest = 32;
constexpr std::size_t kLongestShown = 40;
constexpr std::size_t kLongestText = std::size_t{16} << 20;

/// Letters to insert, drop or change to make one word of another (V. Levenshtein, 1966).
std::size_t wordDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Watches a text while it is parsed.
class Structure {
 public:
  bool operator()(int depth, Json::parse_event_t event, const Json& value) {
    if (depth > kDeepest)
      throw std::invalid_argument("objects and lists lie within more than " +
                                  std::to_string(kDeepest) + " others");
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key &&
        !keys_.back().insert(value.get_ref<const std::string&>()).second)
      throw std::invalid_argument("the key " + shown(value) + " is named twice in one object");
    return true;
  }

 private:
  std::vector<std::set<std::string>> keys_;
};

std::string limitOf(double largest) {
  std::ostringstream text;
  text << largest;
  return text.str();
}

}  // namespace

void refuseKey(const std::string& path, const std::string& what) {
  throw std::invalid_argument("\"" + path + "\" " + what);
}

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (!value.is_string()) return value.dump();
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > kLongestShown) return "a text of " + std::to_string(text.size()) + " letters";
  return value.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Json parseJson(const std::string& text, const std::string& subject) {
  Structure structure;
  try {
    return Json::parse(text, [&](int depth, Json::parse_event_t event, Json& value) {
      return structure(depth, event, value);
    });
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument(subject + " is not JSON from byte " + std::to_string(error.byte) +
                                " on");
  } catch (const Json::out_of_range&) {
    throw std::invalid_argument(subject + " holds a number beyond all that a double can hold");
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument(subject + " is not fit to read: " + wrong.what());
  }
}

std::string readTextFile(const std::string& path, const std::string& subject) {
  const std::string named = subject + " '" + path + "' ";
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(named + "cannot be opened");
  if (std::filesystem::is_directory(path)) throw std::runtime_error(named + "is a folder");
  std::string text(kLongestText + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw std::runtime_error(named + "cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.empty()) throw std::runtime_error(named + "is empty");
  if (text.size() > kLongestText) throw std::runtime_error(named + "is longer than 16 MiB");
  return text;
}

JsonSection::JsonSection(const Json& value, std::string name, const std::string& subject)
    : value_(value), name_(std::move(name)) {
  if (value.is_object()) return;
  if (name_.empty()) throw std::invalid_argument(subject + " is an object in braces");
  refuseKey(name_, "must be an object in braces");
}

const Json* JsonSection::find(const std::string& key) {
  known_.push_back(key);
  const auto found = value_.find(key);
  return found == value_.end() ? nullptr : &*found;
}

const Json& JsonSection::need(const std::string& key) {
  const Json* found = find(key);
  if (!found) refuseKey(path(key), "is missing");
  return *found;
}

std::string JsonSection::path(const std::string& key) const {
  return name_.empty() ? key : name_ + "." + key;
}

void JsonSection::requireNothingElse() const {
  for (const auto& item : value_.items()) {
    if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
    const auto nearest =
        std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
          return wordDistance(item.key(), a) < wordDistance(item.key(), b);
        });
    const std::string key = item.key().size() > kLongestShown
                                ? item.key().substr(0, kLongestShown) + "..."
                                : item.key();
    refuseKey(path(key), "is not a key that is known here: the nearest is \"" + *nearest + "\"");
  }
}

int readInteger(const Json& value, const std::string& path, int least, int most) {
  if (value.is_number_integer() && value >= least && value <= most) return value.get<int>();
  refuseKey(path, "must be a whole number from " + std::to_string(least) + " to " +
                      std::to_string(most) + ", not " + shown(value));
}

double readNumber(const Json& value, const std::string& path, double largest) {
  if (value.is_number() && std::abs(value.get<double>()) <= largest) return value.get<double>();
  refuseKey(path, "must be a number of at most " + limitOf(largest) + ", not " + shown(value));
}

double readPositive(const Json& value, const std::string& path, double largest) {
  if (value.is_number() && value.get<double>() > 0 && value.get<double>() <= largest)
    return value.get<double>();
  refuseKey(path,
            "must be a positive number of at most " + limitOf(largest) + ", not " + shown(value));
}

double readNotNegative(const Json& value, const std::string& path, double largest) {
  if (value.is_number() && value.get<double>() >= 0 && value.get<double>() <= largest)
    return value.get<double>();
  refuseKey(path, "must be a number from 0 to " + limitOf(largest) + ", not " + shown(value));
}

bool readFlag(const Json& value, const std::string& path) {
  if (value.is_boolean()) return value.get<bool>();
  refuseKey(path, "must be true or false, not " + shown(value));
}

std::string readText(const Json& value, const std::string& path) {
  if (!value.is_string()) refuseKey(path, "must be a text");
  const auto& text = value.get_ref<const std::string&>();
  if (text.empty()) refuseKey(path, "must not be empty");
  if (text.find('\0') != std::string::npos) refuseKey(path, "must not hold a zero byte");
  return text;
}

Eigen::VectorXd readNumberList(const Json& value, const std::string& path, int count,
                               double largest) {
  if (!value.is_array() || value.size() != static_cast<std::size_t>(count))
    refuseKey(path, "must be a list of " + std::to_string(count) + " numbers, not " + shown(value));
  Eigen::VectorXd numbers(count);
  for (int i = 0; i < count; ++i) numbers[i] = readNumber(value[i], entryPath(path, i), largest);
  return numbers;
}

std::uint16_t readUsbId(const Json& value, const std::string& path) {
  if (!value.is_string()) return static_cast<std::uint16_t>(readInteger(value, path, 0, 0xffff));
  const auto& text = value.get_ref<const std::string&>();
  const bool isHex = text.size() > 2 && text.size() <= 6 && text.compare(0, 2, "0x") == 0 &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string::npos;
  if (!isHex) refuseKey(path, "must be a number like \"0x1209\"");
  return static_cast<std::uint16_t>(std::stoul(text, nullptr, 16));
}

const Json& readList(const Json& value, const std::string& path, std::size_t most) {
  if (!value.is_array()) refuseKey(path, "must be a list in brackets, not " + shown(value));
  if (value.size() > most)
    refuseKey(path, "must have at most " + std::to_string(most) + " entries, not " +
                        std::to_string(value.size()));
  return value;
}

std::string entryPath(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

}  // namespace palpate
