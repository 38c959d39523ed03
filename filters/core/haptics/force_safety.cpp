// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/force_safety.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

namespace {

// A device's quaternion of 8 bits a component is still that of a rotation.
constexpr double kQuaternionError = 0.02;
// Seconds are sums of periods: a millionth of one more or less is rounding.
constexpr double kRounding = 1e-6;

void require(bool good, const char* name, double value) {
  if (!good)
    throw std::invalid_argument("the safety setting " + std::string(name) +
                                " is out of range: " + std::to_string(value));
}

bool isPositive(double value) {
  return value > 0 && std::isfinite(value);
}

/// No longer than `largest`, in the same direction; finite, however long it was.
/// @return whether it had to be shortened.
bool shorten(Eigen::Vector3d& vector, double largest) noexcept {
  const double length = vector.stableNorm();
  if (length <= largest) return false;
  vector *= largest / length;
  return true;
}

/// From `from` towards `to`, by `largest` at most.
bool approach(Eigen::Vector3d& to, const Eigen::Vector3d& from, double largest) noexcept {
  Eigen::Vector3d change = to - from;
  if (!shorten(change, largest)) return false;
  to = from + change;
  return true;
}

bool isFinite(const Wrench& wrench) noexcept {
  return wrench.force.allFinite() && wrench.torque.allFinite();
}

}  // namespace

const char* describe(Fault fault) noexcept {
  switch (fault) {
    case Fault::None:
      return "no fault";
    case Fault::InvalidPose:
      return "a pose that is not finite, out of reach or no rotation";
    case Fault::Jump:
      return "a pose that jumped";
    case Fault::Silent:
      return "no report from the device";
    case Fault::Unplugged:
      return "the device is not there";
    case Fault::Undelivered:
      return "the device takes no force";
    case Fault::FailedSolves:
      return "no usable force from the model";
    case Fault::LateSolves:
      return "forces computed too late";
    case Fault::RoughSolves:
      return "contact forces that did not settle";
    case Fault::HeldBack:
      return "a contact point that could not follow its tool";
    case Fault::Uncomputed:
      return "touched where the model's Green's functions were not computed";
    case Fault::StartedInside:
      return "a tool that was inside the body when its touch began";
    case Fault::Ended:
      return "the end of the recording";
  }
  return "";
}

ForceSafety::ForceSafety(const SafetySettings& settings, double period, double reportRate)
    : settings_(settings),
      period_(period),
      interval_(reportRate > 0 ? 1 / reportRate : 0, period, settings.longestInterval),
      sound_(kNoWrench),
      rendered_(kNoWrench) {
  const SafetySettings& s = settings;
  admitted_.isThere = false;
  require(reportRate >= 0 && std::isfinite(reportRate), "reportRate", reportRate);
  require(isPositive(period), "period", period);
  require(s.largestForce == 0 || isPositive(s.largestForce), "largestForce", s.largestForce);
  require(s.largestTorque == 0 || isPositive(s.largestTorque), "largestTorque", s.largestTorque);
  require(isPositive(s.forceSlew), "forceSlew", s.forceSlew);
  require(isPositive(s.torqueSlew), "torqueSlew", s.torqueSlew);
  require(isPositive(s.fadeSeconds), "fadeSeconds", s.fadeSeconds);
  require(isPositive(s.settleSeconds), "settleSeconds", s.settleSeconds);
  require(isPositive(s.rampSeconds), "rampSeconds", s.rampSeconds);
  require(isPositive(s.largestSpeed), "largestSpeed", s.largestSpeed);
  require(isPositive(s.largestTurning), "largestTurning", s.largestTurning);
  require(isPositive(s.largestReach), "largestReach", s.largestReach);
  require(s.toleratedSilence >= 0, "toleratedSilence", s.toleratedSilence);
  require(s.largestSilence > s.toleratedSilence, "largestSilence", s.largestSilence);
  require(isPositive(s.longestInterval), "longestInterval", s.longestInterval);
  require(s.undeliveredTicks >= 1, "undeliveredTicks", s.undeliveredTicks);
  require(s.failedSolves >= 1, "failedSolves", s.failedSolves);
  require(s.lateSolves >= 1, "lateSolves", s.lateSolves);
  require(isPositive(s.roughResidual), "roughResidual", s.roughResidual);
}

/// A new report. What is valid but far from the last becomes what the next is measured from.
Fault ForceSafety::judge(const ToolPose& pose) noexcept {
  // Not stableNorm, which passes over what is not a number.
  if (!(pose.position.norm() <= settings_.largestReach)) return Fault::InvalidPose;
  if (!(std::abs(pose.orientation.norm() - 1) <= kQuaternionError)) return Fault::InvalidPose;
  if (pose.jointCount < 0 || pose.jointCount > ToolPose::kMostJoints) return Fault::InvalidPose;
  for (int j = 0; j < pose.jointCount; ++j)
    if (!std::isfinite(pose.joints[j])) return Fault::InvalidPose;

  const ToolPose last = reported_;
  const bool first = !everReported_;
  reported_ = pose;
  reported_.orientation.normalize();
  everReported_ = true;
  const double elapsed = sinceReport_;
  sinceReport_ = 0;
  const double turned = last.orientation.angularDistance(reported_.orientation);
  const bool jumped =
      !first && ((pose.position - last.position).norm() > settings_.largestSpeed * elapsed ||
                 turned > settings_.largestTurning * elapsed);
  return jumped ? Fault::Jump : Fault::None;
}

const ToolPose& ForceSafety::admit(bool present, const DeviceState& state,
                                   double elapsed) noexcept {
  startsAnew_ = false;
  sinceReport_ += elapsed;
  if (!present) {
    poseFault_ = Fault::Unplugged;
    everReported_ = false;
    interrupted_ = true;
    return admitted_;
  }
  // A late tick is the loop's fault: of the device it tells no more than one report that is
  // missing.
  silence_ += std::min(elapsed, interval_.seconds());
  if (everReported_ && state.sequence == sequence_) {
    const bool isSilent = silentShare() < kRounding || interval_.isTooLong();
    poseFault_ = !isSilent ? Fault::None : state.isOver ? Fault::Ended : Fault::Silent;
    return admitted_;
  }
  if (everReported_)
    interval_.add(silence_);
  else
    interval_.restart();
  poseFault_ = judge(state.pose);
  sequence_ = state.sequence;
  silence_ = 0;
  if (poseFault_ != Fault::None) {
    interrupted_ = true;
    return admitted_;
  }
  if (interval_.isTooLong()) poseFault_ = Fault::Silent;
  startsAnew_ = interrupted_;
  interrupted_ = false;
  admitted_ = reported_;
  return admitted_;
}

/// @param held  s, the last force has been rendered for.
Fault ForceSafety::judgeSolve(const Request& request, double held) noexcept {
  const bool failed = request.certificate.failed || !isFinite(request.wanted);
  failed_ = failed ? std::min(failed_ + 1, settings_.failedSolves) : 0;
  const bool rough =
      request.certificate.budgetCut && !(request.certificate.residual <= settings_.roughResidual);
  const double periods = held / period_ + kRounding;
  const bool stood = periods >= settings_.lateSolves;
  const Fault doubt = request.late || stood          ? Fault::LateSolves
                      : rough                        ? Fault::RoughSolves
                      : request.certificate.heldBack ? Fault::HeldBack
                                                     : Fault::None;
  const double most = settings_.lateSolves - late_;
  const double ticks = doubt == Fault::LateSolves ? std::max(1.0, std::floor(periods)) : 1;
  late_ = doubt != Fault::None ? late_ + static_cast<int>(std::min(ticks, most)) : 0;
  if (request.certificate.uncomputed) return Fault::Uncomputed;
  if (request.certificate.startedInside) return Fault::StartedInside;
  if (failed_ >= settings_.failedSolves) return Fault::FailedSolves;
  return late_ >= settings_.lateSolves ? doubt : Fault::None;
}

void ForceSafety::delivered(bool arrived) noexcept {
  // What is not there takes nothing: that is no fault of its own.
  const bool lost = !arrived && poseFault_ != Fault::Unplugged;
  undelivered_ = lost ? std::min(undelivered_ + 1, settings_.undeliveredTicks) : 0;
}

/// 1 up to the last tick before a report beyond those tolerated is missing, then linearly down to 0
/// at the largest silence.
double ForceSafety::silentShare() const noexcept {
  const double interval = interval_.seconds(), zero = settings_.largestSilence * interval;
  const double held = (settings_.toleratedSilence + 1) * interval - period_;
  return std::clamp((zero - silence_) / (zero - held), 0.0, 1.0);
}

Wrench ForceSafety::bounded(const Wrench& wanted) noexcept {
  Wrench wrench = wanted;
  const bool force = shorten(wrench.force, settings_.largestForce);
  const bool torque = shorten(wrench.torque, settings_.largestTorque);
  report_.limitedTicks += force || torque;
  return wrench;
}

/// One tick of fading from the last sound wrench. Once latched it goes on to zero.
void ForceSafety::fade(bool latch, double elapsed) noexcept {
  // Never up again, whatever fault follows another.
  share_ = std::min(share_, silentShare());
  if (latch || failed_ > 0) {
    faded_ += elapsed;
    share_ = std::min(share_, 1 - faded_ / settings_.fadeSeconds);
  }
  if (share_ < kRounding) share_ = 0;
  rendered_ = {share_ * sound_.force, share_ * sound_.torque};
  if (latch) report_.phase = share_ > 0 ? SafetyPhase::Fading : SafetyPhase::Settling;
}

void ForceSafety::render(const Wrench& wanted) noexcept {
  faded_ = 0;
  share_ = 1;
  if (report_.phase == SafetyPhase::Settling) {
    settled_ += period_;
    if (settled_ + kRounding * period_ >= settings_.settleSeconds)
      report_.phase = SafetyPhase::Ramping;
  } else if (report_.phase == SafetyPhase::Ramping) {
    report_.gain = std::min(1.0, report_.gain + period_ / settings_.rampSeconds);
    if (report_.gain > 1 - kRounding) {
      report_.gain = 1;
      report_.phase = SafetyPhase::Rendering;
      report_.fault = Fault::None;
    }
  }
  Wrench target = bounded(wanted);
  target.force *= report_.gain;
  target.torque *= report_.gain;
  const bool force = approach(target.force, rendered_.force, settings_.forceSlew * period_);
  const bool torque = approach(target.torque, rendered_.torque, settings_.torqueSlew * period_);
  report_.slewedTicks += force || torque;
  rendered_ = sound_ = target;
}

void ForceSafety::endWith(Fault fault) noexcept {
  if (fault != Fault::None) {
    const auto number = static_cast<std::size_t>(fault);
    if (report_.faults[number]++ == 0) report_.firstFaults[number] = time_;
    report_.fault = fault;
  }
  settled_ = 0;
  report_.gain = 0;
}

const Wrench& ForceSafety::limit(const Request& request, double elapsed) noexcept {
  const double held = std::max(elapsed, request.taken);
  const Fault solveFault = judgeSolve(request, held);
  Fault fault = poseFault_;
  if (fault == Fault::None) fault = solveFault;
  if (fault == Fault::None && undelivered_ >= settings_.undeliveredTicks)
    fault = Fault::Undelivered;

  if (fault == Fault::Unplugged) {
    endWith(fault);
    rendered_ = sound_ = kNoWrench;
    report_.phase = SafetyPhase::Settling;
  } else if (fault != Fault::None || request.paused || report_.phase == SafetyPhase::Fading) {
    endWith(fault);
    fade(true, held);
  } else if (failed_ > 0 || silentShare() < 1 - kRounding) {
    fade(false, held);
  } else {
    render(request.wanted);
  }
  time_ += elapsed;
  return rendered_;
}

}  // namespace palpate
