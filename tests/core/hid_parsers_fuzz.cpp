// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ten million pseudo-random reports over every parser of reports, in a program that is compiled
// with the sanitizers of addresses and of undefined behaviour: whatever a device sends, nothing is
// read beyond it, and no pose of it is anything but finite. Descriptors and descriptions, which are
// read once per device, get fewer.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "haptics/described_reports.h"
#include "haptics/hid_descriptor.h"
#include "haptics/joystick_reports.h"
#include "haptics/palpate_report.h"
#include "haptics/pid_reports.h"
#include "haptics/spacemouse_reports.h"
#include "support/pid_joystick.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Marsaglia's xorshift: a report costs a few of them.
class Random {
 public:
  std::uint64_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    return state_ ^= state_ << 17;
  }
  std::size_t below(std::size_t bound) { return next() % bound; }

 private:
  std::uint64_t state_ = 88172645463325252u;
};

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::exit(1);
}

void requireFinite(const ToolPose& pose) {
  bool isFinite = pose.position.allFinite() && std::abs(pose.orientation.norm() - 1) < 1e-9;
  require(pose.jointCount >= 0 && pose.jointCount <= ToolPose::kMostJoints, "joints out of range");
  for (int j = 0; j < pose.jointCount; ++j) isFinite = isFinite && std::isfinite(pose.joints[j]);
  require(isFinite, "a pose is not finite");
}

/// Buffers of every length, each a block of its own, so that a read beyond is seen.
class Reports {
 public:
  static constexpr std::size_t kLongest = 72;

  Reports() {
    for (std::size_t i = 0; i <= kLongest; ++i) blocks_.emplace_back(new std::uint8_t[i]);
  }

  /// Half of the reports are random from the first byte to the last, half are good ones with a few
  /// bytes changed; most have a length that some parser takes.
  std::uint8_t* make(Random& random, const std::vector<Bytes>& good, std::size_t& count) {
    const Bytes& model = good[random.below(good.size())];
    count = random.below(4) == 0 ? random.below(kLongest + 1) : model.size();
    std::uint8_t* bytes = blocks_[count].get();
    if (random.below(2) == 0) {
      for (std::size_t i = 0; i < count; i += 8) {
        const std::uint64_t word = random.next();
        for (std::size_t j = i; j < std::min(i + 8, count); ++j)
          bytes[j] = static_cast<std::uint8_t>(word >> (8 * (j - i)));
      }
      if (count > 0 && random.below(2) == 0) bytes[0] = model[0];
      return bytes;
    }
    for (std::size_t i = 0; i < count; ++i) bytes[i] = i < model.size() ? model[i] : 0;
    for (std::size_t changes = random.below(4); count > 0 && changes > 0; --changes)
      bytes[random.below(count)] = static_cast<std::uint8_t>(random.next());
    return bytes;
  }

 private:
  std::vector<std::unique_ptr<std::uint8_t[]>> blocks_;
};

HidDescription::Input describedInput() {
  using Type = HidNumber::Type;
  HidDescription::Input input;
  input.report = 4;
  input.length = 32;
  input.position = {HidNumber{1, Type::Int16, 1e-4, 0.5}, HidNumber{3, Type::Float32, 1e6, 0},
                    HidNumber{28, Type::Uint32, 1, 0}};
  input.orientation = {HidNumber{7, Type::Float32, 1, 0}, HidNumber{11, Type::Int32, 1e-9, 0},
                       HidNumber{15, Type::Int8, 1e-2, 0}, HidNumber{16, Type::Uint8, 1e-2, 0}};
  input.joints = {HidNumber{17, Type::Float32, 1, 0}, {}};
  input.sequence = HidNumber{21, Type::Uint16, 1, 0};
  input.buttons = HidNumber{23, Type::Uint32, 1, 0};
  return input;
}

std::vector<Bytes> goodReports() {
  const PalpateReport state = encodePalpateState({}), wrench = encodePalpateWrench({}),
                      capability = encodePalpateCapability({});
  Bytes described(32);
  described[0] = 4;
  described[10] = 0x3f;  // 0.5 as a float's last byte
  return {Bytes(state.begin(), state.end()),
          Bytes(wrench.begin(), wrench.end()),
          Bytes(capability.begin(), capability.end()),
          {1, 1, 0, 2, 0, 3, 0},
          {2, 1, 0, 2, 0, 3, 0},
          {1, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0},
          {3, 1, 0, 0, 0},
          {1, 0xff, 0x7f, 0, 0, 1},
          {0x12, 1, 1, 0, 0},
          described};
}

/// @return how many reports were taken, so that the program cannot pass by taking none.
long fuzzReports(long count, Random& random) {
  const HidDescriptor descriptor(PidJoystick::descriptor());
  const JoystickInput joystick(descriptor);
  const PidOutput pid(descriptor);
  const HidDescription::Input described = describedInput();
  const AxisScale scale;
  const std::vector<Bytes> good = goodReports();
  Reports reports;
  SpaceMouseState mouse;
  PalpateState state;
  PalpateWrench wrench;
  PalpateCapability capability;
  ReportNumbering numbering;
  long taken = 0;
  for (long i = 0; i < count; ++i) {
    std::size_t size;
    const std::uint8_t* bytes = reports.make(random, good, size);
    if (parseSpaceMouseReport(bytes, size, mouse)) {
      requireFinite(spaceMousePose(mouse, scale));
      ++taken;
    }
    if (parsePalpateState(bytes, size, state)) {
      requireFinite(state.pose);
      taken += numbering.isNew(state.sequence);
    }
    if (parsePalpateWrench(bytes, size, wrench)) {
      require(wrench.wrench.force.allFinite() && wrench.wrench.torque.allFinite(), "no force");
      ++taken;
    }
    taken += parsePalpateCapability(bytes, size, capability);
    ToolPose pose;
    std::uint32_t sequence;
    if (joystick.parse(bytes, size, scale, pose)) {
      requireFinite(pose);
      ++taken;
    }
    if (parseDescribedInput(described, bytes, size, pose, sequence)) {
      requireFinite(pose);
      ++taken;
    }
    taken += pid.loadedBlock(bytes, size).has_value();
  }
  return taken;
}

/// @return how many of the descriptors were descriptors.
long fuzzDescriptors(long count, Random& random) {
  long valid = 0;
  for (long i = 0; i < count; ++i) {
    Bytes bytes = PidJoystick::descriptor();
    if (random.below(4) == 0) bytes.resize(random.below(bytes.size()));
    for (std::size_t changes = 1 + random.below(4); !bytes.empty() && changes > 0; --changes)
      bytes[random.below(bytes.size())] = static_cast<std::uint8_t>(random.next());
    try {
      const HidDescriptor descriptor(bytes);
      ++valid;
      const PidOutput output(descriptor);
      Bytes report(output.constantForceBytes());
      output.constantForce(static_cast<int>(random.below(256)), 0.5, report.data());
      output.setEffect(1, 0);
      output.largestGain();
    } catch (const std::invalid_argument&) {
    }
  }
  return valid;
}

}  // namespace
}  // namespace palpate::test

int main() {
  using namespace palpate::test;
  Random random;
  const long taken = fuzzReports(10'000'000, random);
  const long valid = fuzzDescriptors(20'000, random);
  std::printf("%ld reports taken of 10000000, %ld descriptors valid of 20000\n", taken, valid);
  require(taken > 1'000'000 && valid > 1000, "hardly anything got as far as the parsers' ends");
  return 0;
}
