// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_protocol.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "haptics/described_reports.h"
#include "haptics/joystick_reports.h"
#include "haptics/palpate_report.h"
#include "haptics/pid_reports.h"
#include "haptics/spacemouse_reports.h"

namespace palpate {
namespace {

class SpaceMouseProtocol final : public HidProtocol {
 public:
  explicit SpaceMouseProtocol(const AxisScale& scale) : scale_(scale) {}

  bool reportsOnlyChanges() const noexcept override { return true; }
  void start(HidTransport&, DeviceInfo&) override {
    state_ = {};
    pose_ = {};
  }
  bool take(const std::uint8_t* bytes, std::size_t count) noexcept override {
    if (!parseSpaceMouseReport(bytes, count, state_)) return false;
    pose_ = spaceMousePose(state_, scale_);
    return true;
  }
  const ToolPose* pose() const noexcept override { return &pose_; }

 private:
  AxisScale scale_;
  SpaceMouseState state_;
  ToolPose pose_;
};

class JoystickProtocol final : public HidProtocol {
 public:
  JoystickProtocol(const HidDescriptor& descriptor, const AxisScale& scale)
      : scale_(scale), input_(descriptor) {
    if (!PidOutput::isComplete(descriptor)) return;
    output_.emplace(descriptor);
    force_.resize(output_->constantForceBytes());
  }

  bool rendersWrenches() const noexcept override { return output_.has_value(); }
  bool reportsOnlyChanges() const noexcept override { return true; }

  void start(HidTransport& transport, DeviceInfo& info) override {
    pose_ = {};
    blocks_.clear();
    if (!output_) return;
    info.largestForce = std::abs(scale_.force);
    send(transport, output_->resetDevice());
    send(transport, output_->enableActuators());
    const PidOutput::Report gain = output_->largestGain();
    if (!gain.empty()) send(transport, gain);
    for (int axis : output_->axes()) {
      blocks_.push_back(createEffect(transport));
      send(transport, output_->setEffect(blocks_.back(), axis));
      renderAxis(transport, blocks_.back(), 0);
      send(transport, output_->startEffect(blocks_.back()));
    }
  }

  bool take(const std::uint8_t* bytes, std::size_t count) noexcept override {
    return input_.parse(bytes, count, scale_, pose_);
  }
  const ToolPose* pose() const noexcept override { return &pose_; }

  bool render(HidTransport& transport, const Wrench& wrench) noexcept override {
    const Eigen::Vector3d force = toHidAxes(wrench.force);
    bool hasArrived = true;
    for (std::size_t i = 0; i < blocks_.size(); ++i)
      hasArrived &= renderAxis(transport, blocks_[i], force[output_->axes()[i]] / scale_.force);
    return hasArrived;
  }
  void rest(HidTransport& transport) noexcept override { render(transport, kNoWrench); }

 private:
  static void send(HidTransport& transport, const PidOutput::Report& report) {
    if (!transport.write(report.data(), report.size()))
      throw std::runtime_error("the device does not take reports of force feedback");
  }

  int createEffect(HidTransport& transport) const {
    const PidOutput::Report create = output_->createEffect();
    PidOutput::Report load = output_->blockLoad();
    if (!transport.setFeature(create.data(), create.size()))
      throw std::runtime_error("the device creates no effect of force feedback");
    const int count = transport.getFeature(load.data(), load.size());
    const auto block = output_->loadedBlock(load.data(), count < 0 ? 0 : count);
    if (!block) throw std::runtime_error("the device has no room for an effect of force feedback");
    return *block;
  }

  bool renderAxis(HidTransport& transport, int block, double fraction) noexcept {
    output_->constantForce(block, fraction, force_.data());
    return transport.write(force_.data(), force_.size());
  }

  AxisScale scale_;
  JoystickInput input_;
  std::optional<PidOutput> output_;
  std::vector<int> blocks_;  // an effect per axis of the output
  std::vector<std::uint8_t> force_;
  ToolPose pose_;
};

class PalpateProtocol final : public HidProtocol {
 public:
  bool rendersWrenches() const noexcept override { return true; }

  void start(HidTransport& transport, DeviceInfo& info) override {
    PalpateReport report{};
    report[0] = kCapabilityReport;
    const int count = transport.getFeature(report.data(), report.size());
    PalpateCapability capability;
    if (!parsePalpateCapability(report.data(), count < 0 ? 0 : count, capability))
      throw std::runtime_error("the device does not tell what it can do");
    info.largestForce = capability.largestForce;
    info.largestTorque = capability.largestTorque;
    info.largestStiffness = capability.largestStiffness;
    info.reportRate = capability.reportsPerSecond;
    numbering_ = {};
    state_ = {};
    hasState_ = false;
  }

  bool take(const std::uint8_t* bytes, std::size_t count) noexcept override {
    PalpateState state;
    if (!parsePalpateState(bytes, count, state) || !numbering_.isNew(state.sequence) ||
        !(state.flags & PalpateState::kCalibrated))
      return false;
    state_ = state;
    hasState_ = true;
    return true;
  }
  const ToolPose* pose() const noexcept override { return hasState_ ? &state_.pose : nullptr; }

  bool render(HidTransport& transport, const Wrench& wrench) noexcept override {
    return send(transport, wrench, PalpateWrench::kEnable);
  }
  void rest(HidTransport& transport) noexcept override { send(transport, kNoWrench, 0); }

 private:
  bool send(HidTransport& transport, const Wrench& wrench, std::uint16_t flags) noexcept {
    const PalpateReport report = encodePalpateWrench({flags, ++sequence_, state_.sequence, wrench});
    return transport.write(report.data(), report.size());
  }

  ReportNumbering numbering_;
  PalpateState state_;
  bool hasState_ = false;
  std::uint32_t sequence_ = 0;  // goes on over reconnections: what is late stays late
};

class DescribedProtocol final : public HidProtocol {
 public:
  explicit DescribedProtocol(const HidDescription& description)
      : input_(description.input), output_(description.output), info_(description.info) {
    if (output_) bytes_.resize(describedOutputBytes(*output_));
    if (!input_.sequence) return;
    if (input_.sequence->type == HidNumber::Type::Uint8) sequenceShift_ = 24;
    if (input_.sequence->type == HidNumber::Type::Uint16) sequenceShift_ = 16;
  }

  bool rendersWrenches() const noexcept override { return output_.has_value(); }

  void start(HidTransport&, DeviceInfo& info) override {
    info.largestForce = info_.largestForce;
    info.largestTorque = info_.largestTorque;
    info.largestStiffness = info_.largestStiffness;
    numbering_ = {};
    hasPose_ = false;
  }

  bool take(const std::uint8_t* bytes, std::size_t count) noexcept override {
    ToolPose pose;
    std::uint32_t sequence = 0;
    if (!parseDescribedInput(input_, bytes, count, pose, sequence)) return false;
    // Shifted to the top, numbers of any width wrap around as those of 32 bits do.
    if (input_.sequence && !numbering_.isNew(sequence << sequenceShift_)) return false;
    pose_ = pose;
    hasPose_ = true;
    return true;
  }
  const ToolPose* pose() const noexcept override { return hasPose_ ? &pose_ : nullptr; }

  bool render(HidTransport& transport, const Wrench& wrench) noexcept override {
    if (!output_) return true;
    encodeDescribedOutput(*output_, wrench, ++sequence_, bytes_.data());
    return transport.write(bytes_.data(), bytes_.size());
  }
  void rest(HidTransport& transport) noexcept override { render(transport, kNoWrench); }

 private:
  HidDescription::Input input_;
  std::optional<HidDescription::Output> output_;
  DeviceInfo info_;
  int sequenceShift_ = 0;
  ReportNumbering numbering_;
  ToolPose pose_;
  bool hasPose_ = false;
  std::uint32_t sequence_ = 0;
  std::vector<std::uint8_t> bytes_;
};

void requireSensible(const AxisScale& scale) {
  if (!(scale.reach > 0) || !std::isfinite(scale.reach) || !(scale.turn >= 0) ||
      !std::isfinite(scale.turn) || !(std::abs(scale.force) > 0) || !std::isfinite(scale.force))
    throw std::invalid_argument(
        "the reach of a deflected device must be a positive number, its turn not a negative one "
        "and its force not zero");
}

}  // namespace

std::unique_ptr<HidProtocol> makeSpaceMouseProtocol(const AxisScale& scale) {
  requireSensible(scale);
  return std::make_unique<SpaceMouseProtocol>(scale);
}

std::unique_ptr<HidProtocol> makeJoystickProtocol(const HidDescriptor& descriptor,
                                                  const AxisScale& scale) {
  requireSensible(scale);
  return std::make_unique<JoystickProtocol>(descriptor, scale);
}

std::unique_ptr<HidProtocol> makePalpateProtocol() {
  return std::make_unique<PalpateProtocol>();
}

std::unique_ptr<HidProtocol> makeDescribedProtocol(const HidDescription& description) {
  return std::make_unique<DescribedProtocol>(description);
}

}  // namespace palpate
