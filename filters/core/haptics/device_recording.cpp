// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/device_recording.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "whole_file.h"

namespace palpate {
namespace {

constexpr const char* kFirstLine = "palpate-device-recording 2";
constexpr const char* kFirstLineWithoutRate = "palpate-device-recording 1";
constexpr std::streamsize kLongestLine = 1 << 16;

/// The lines of a recording and the words of the line under way.
class LineReader {
 public:
  LineReader(std::istream& file, std::string path) : file_(file), path_(std::move(path)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::invalid_argument("line " + std::to_string(number_) + " of '" + path_ + "': " + what);
  }

  void next(const char* expected) {
    ++number_;
    line_.resize(kLongestLine);
    file_.getline(line_.data(), kLongestLine);
    const auto length = static_cast<std::size_t>(file_.gcount());
    if (length + 1 == kLongestLine && file_.fail()) refuse("the line is too long");
    if (!file_) refuse(std::string("the file ends before ") + expected);
    line_.resize(length - (file_.eof() ? 0 : 1));
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    at_ = 0;
  }

  const std::string& line() const { return line_; }

  /// Everything after a word that the line must begin with.
  std::string after(const std::string& word) {
    if (line_.compare(0, word.size() + 1, word + " ") != 0) refuse("'" + word + "' is missing");
    at_ = word.size() + 1;
    return line_.substr(at_);
  }

  template <class Number>
  Number number(const char* what) {
    while (at_ < line_.size() && line_[at_] == ' ') ++at_;
    Number value{};
    const char *begin = line_.data() + at_, *end = line_.data() + line_.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || (stop != end && *stop != ' '))
      refuse(std::string(what) + " is missing or not a number that fits");
    at_ = static_cast<std::size_t>(stop - line_.data());
    return value;
  }

  void requireEnd() const {
    if (line_.find_first_not_of(' ', at_) != std::string::npos)
      refuse("there is more than expected: '" + line_.substr(at_) + "'");
  }

  void requireEndOfFile() {
    ++number_;
    if (std::getline(file_, line_)) refuse("there are more lines than moments");
  }

 private:
  std::istream& file_;
  std::string path_, line_;
  std::size_t at_ = 0;
  long number_ = 0;
};

DeviceMoment readMoment(LineReader& reader) {
  reader.next("its last moment");
  DeviceMoment moment;
  if (reader.line() == "away") {
    moment.isThere = false;
    return moment;
  }
  ToolPose& pose = moment.state.pose;
  moment.state.sequence = reader.number<std::uint64_t>("the sequence number");
  for (double& x : pose.position) x = reader.number<double>("the position");
  double* const orientation[] = {&pose.orientation.w(), &pose.orientation.x(),
                                 &pose.orientation.y(), &pose.orientation.z()};
  for (double* x : orientation) *x = reader.number<double>("the orientation");
  pose.buttons = reader.number<std::uint32_t>("the buttons");
  pose.jointCount = reader.number<int>("the number of joints");
  if (pose.jointCount < 0 || pose.jointCount > ToolPose::kMostJoints)
    reader.refuse("there cannot be " + std::to_string(pose.jointCount) + " joints");
  for (int j = 0; j < pose.jointCount; ++j) pose.joints[j] = reader.number<double>("a joint angle");
  reader.requireEnd();
  return moment;
}

/// As few digits as tell a number apart from all others.
template <class Number>
void append(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  text += ' ';
}

std::string lineOf(const DeviceMoment& moment) {
  if (!moment.isThere) return "away\n";
  const ToolPose& pose = moment.state.pose;
  std::string line;
  append(line, moment.state.sequence);
  for (double x : pose.position) append(line, x);
  for (double x :
       {pose.orientation.w(), pose.orientation.x(), pose.orientation.y(), pose.orientation.z()})
    append(line, x);
  append(line, pose.buttons);
  append(line, pose.jointCount);
  for (int j = 0; j < pose.jointCount; ++j) append(line, pose.joints[j]);
  line.back() = '\n';
  return line;
}

void requireWritable(const DeviceRecording& recording) {
  if (recording.info.name.find_first_of("\r\n") != std::string::npos)
    throw std::invalid_argument("the name of a recorded device must be one line");
  if (!(recording.rate >= 0) || !std::isfinite(recording.rate))
    throw std::invalid_argument("the rate of a recording must not be negative, as " +
                                std::to_string(recording.rate) + " is");
  for (std::size_t i = 0; i < recording.moments.size(); ++i) {
    const int joints = recording.moments[i].state.pose.jointCount;
    if (joints < 0 || joints > ToolPose::kMostJoints)
      throw std::invalid_argument("moment " + std::to_string(i) + " of a recording cannot have " +
                                  std::to_string(joints) + " joints");
  }
}

void writeTo(std::ostream& file, const DeviceRecording& recording) {
  std::string limits = "limits ";
  append(limits, recording.info.largestForce);
  append(limits, recording.info.largestTorque);
  append(limits, recording.info.largestStiffness);
  limits.back() = '\n';
  file << (recording.rate > 0 ? kFirstLine : kFirstLineWithoutRate) << "\nname "
       << recording.info.name << "\n"
       << limits;
  if (recording.rate > 0) {
    std::string rate = "rate ";
    append(rate, recording.rate);
    rate.back() = '\n';
    file << rate;
  }
  file << "moments " << recording.moments.size() << "\n";
  for (const DeviceMoment& moment : recording.moments) file << lineOf(moment);
}

}  // namespace

DeviceRecording readDeviceRecording(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("the recording '" + path + "' cannot be opened");
  if (std::filesystem::is_directory(path))
    throw std::runtime_error("the recording '" + path + "' is a folder");
  LineReader reader(file, path);
  DeviceRecording recording;
  reader.next("its first line");
  const bool hasRate = reader.line() == kFirstLine;
  if (!hasRate && reader.line() != kFirstLineWithoutRate)
    reader.refuse(std::string("a recording begins with '") + kFirstLine + "'");
  reader.next("the device's name");
  recording.info.name = reader.after("name");
  reader.next("the device's limits");
  reader.after("limits");
  for (double* limit : {&recording.info.largestForce, &recording.info.largestTorque,
                        &recording.info.largestStiffness}) {
    *limit = reader.number<double>("a limit");
    if (!(*limit >= 0)) reader.refuse("a limit is negative or not a number");
  }
  reader.requireEnd();
  if (hasRate) {
    reader.next("the rate");
    reader.after("rate");
    recording.rate = reader.number<double>("the rate");
    if (!(recording.rate > 0) || !std::isfinite(recording.rate))
      reader.refuse("the rate must be positive");
    reader.requireEnd();
  }
  reader.next("the number of moments");
  reader.after("moments");
  const auto count = reader.number<std::size_t>("the number of moments");
  reader.requireEnd();
  for (std::size_t i = 0; i < count; ++i) recording.moments.push_back(readMoment(reader));
  reader.requireEndOfFile();
  return recording;
}

void writeDeviceRecording(const DeviceRecording& recording, const std::string& path) {
  requireWritable(recording);
  writeWholeFile(path, [&](std::ostream& file) { writeTo(file, recording); });
}

}  // namespace palpate
