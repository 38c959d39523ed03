// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <cstdint>

#include "contact/contact_certificate.h"
#include "haptics/haptic_device.h"
#include "haptics/report_interval.h"

namespace palpate {

/// What may be done to a hand. Each is positive and finite, a limit of force or torque may be zero.
struct SafetySettings {
  double largestForce = 3;     ///< N
  double largestTorque = 0.1;  ///< N m
  double forceSlew = 1000;     ///< N/s, of the force's magnitude of change
  double torqueSlew = 30;      ///< N m/s
  double fadeSeconds = 0.01;   ///< from any force to zero after a fault
  double settleSeconds = 0.1;  ///< without a fault, before a force is rendered
  double rampSeconds = 0.5;    ///< from nothing to the whole force

  double largestSpeed = 50;     ///< m/s; more is a jump (5 cm in a millisecond)
  double largestTurning = 500;  ///< rad/s
  double largestReach = 10;     ///< m from the device's origin

  int toleratedSilence = 1;       ///< reports missed in a row, while the force stays
  int largestSilence = 3;         ///< ReportIntervals after the last report it is zero; a fault
  double longestInterval = 0.02;  ///< s; a device that reports less often gets no force; a fault
  int undeliveredTicks = 3;       ///< in a row are a fault
  int failedSolves = 3;           ///< in a row are a fault; the force fades from the first on
  /// Ticks late, rough or held back, in a row, are a fault, and so is one that takes as many
  /// periods.
  int lateSolves = 20;
  /// Residual above which a solve that was cut is rough. Up to a thousandth of the largest
  /// contact's force, what a hand feels is right to about as much of the whole.
  double roughResidual = 1e-3;
};

enum class Fault : std::uint8_t {
  None,
  InvalidPose,  ///< not finite, out of reach, no rotation
  Jump,
  Silent,         ///< no new report, or too few
  Unplugged,      ///< the device is not there
  Undelivered,    ///< the device takes no wrench
  FailedSolves,   ///< or forces that are not finite
  LateSolves,     ///< over the budget of time
  RoughSolves,    ///< cut before their tolerance was met, with a residual to be felt
  HeldBack,       ///< points that should slide and have gone nowhere
  Uncomputed,     ///< the model has no Green's functions where it is touched
  StartedInside,  ///< a tool was inside the body when its touch began; the force ramps from there
  Ended,          ///< no new report because a recording has come to its end
};
inline constexpr int kFaultCount = 13;

/// In words, e.g. "no report from the device".
const char* describe(Fault fault) noexcept;

enum class SafetyPhase : std::uint8_t {
  Settling,  ///< zero force, until there has been no fault for a while
  Ramping,
  Rendering,
  Fading,  ///< after a fault or a pause
};

/// What became of a hand's force, for those who show it.
struct SafetyReport {
  SafetyPhase phase = SafetyPhase::Settling;
  Fault fault = Fault::None;  ///< the last one that ended rendering, until it renders again
  double gain = 0;            ///< share of the wanted force, 0 to 1
  std::array<std::int64_t, kFaultCount> faults{};  ///< ticks with each fault, so far
  std::array<double, kFaultCount> firstFaults{};   ///< s from the start to its first tick, if any
  std::int64_t limitedTicks = 0;                   ///< with a force or torque above its limit
  std::int64_t slewedTicks = 0;                    ///< with a change above the slew limit
};

/// Decides what force one hand gets. Threads and clocks are no part of it: the same calls give the
/// same forces.
///
/// A tick that is late counts as as many as the periods it takes. Of one that is not, by its own
/// computing time, but ends after lateSolves periods, or begins as long after the last, the force
/// has been held all the while: that is the same fault, and the force is zero at once.
///
/// After a fault the force is f0 (1 - t/fadeSeconds), f0 the last one without fault, and so exactly
/// zero in time from any force, also where the fault is a pose that is not valid; a device that is
/// gone makes it zero in the same tick. Silence is counted in the device's own ReportInterval, a
/// late tick as no more than one: the force stays while toleratedSilence reports are missing, and
/// fades from then on to zero at largestSilence intervals, no later than that many
/// longestIntervals. Then it stays zero until settleSeconds have passed without a fault, and
/// returns over rampSeconds.
class ForceSafety {
 public:
  /// @param period      s, of a tick.
  /// @param reportRate  as DeviceInfo's.
  /// @throws std::invalid_argument naming the setting that is out of range.
  ForceSafety(const SafetySettings& settings, double period, double reportRate = 0);

  /// Judges what the device reports; the first half of a tick.
  /// @param present  whether the device is there; if not, `state` is not looked at.
  /// @param elapsed  s since the last tick: the period, or more if ticks were missed.
  /// @return the pose to go on with: the reported one, or else the last one that was valid, with a
  ///         unit quaternion. The origin, and not there, before there was any.
  const ToolPose& admit(bool present, const DeviceState& state, double elapsed) noexcept;

  /// Whether the last pose admitted is the first one, or the first after invalid ones or a jump:
  /// contact found before has no meaning any more.
  bool startsAnew() const noexcept { return startsAnew_; }

  struct Request {
    /// In the device's frame.
    Wrench wanted = kNoWrench;
    ContactCertificate certificate;
    bool late = false;    ///< whether the tick is over its budget
    double taken = 0;     ///< s since the tick began, by the clock: the last force is as old
    bool paused = false;  ///< fade and stay at zero, without a fault
  };

  /// The wrench to render; the second half of a tick.
  /// @param elapsed  as above. The force changes no further in a longer tick but when it fades.
  const Wrench& limit(const Request& request, double elapsed) noexcept;

  /// Tells whether the device took it.
  void delivered(bool arrived) noexcept;

  const SafetyReport& report() const noexcept { return report_; }

 private:
  Fault judge(const ToolPose& pose) noexcept;
  Fault judgeSolve(const Request& request, double held) noexcept;
  double silentShare() const noexcept;
  void fade(bool latch, double elapsed) noexcept;
  void render(const Wrench& wanted) noexcept;
  Wrench bounded(const Wrench& wanted) noexcept;
  void endWith(Fault fault) noexcept;

  SafetySettings settings_;
  double period_;
  ReportInterval interval_;
  SafetyReport report_;

  ToolPose admitted_, reported_;  ///< reported_: what a jump is measured from
  bool everReported_ = false, startsAnew_ = false, interrupted_ = true;
  std::uint64_t sequence_ = 0;
  double sinceReport_ = 0;  ///< s
  double silence_ = 0;      ///< s, the same with late ticks cut to an interval
  Fault poseFault_ = Fault::None;
  int undelivered_ = 0, failed_ = 0, late_ = 0;

  double settled_ = 0, faded_ = 0;  ///< s
  double time_ = 0;                 ///< s, from the start to the tick before
  double share_ = 1;                ///< of sound_, while it fades
  Wrench sound_, rendered_;         ///< sound_: the last one without a fault
};

}  // namespace palpate
