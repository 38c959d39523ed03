// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <cstdint>
#include <Eigen/Geometry>
#include <string>

#include "contact/wrench.h"

namespace palpate {

/// Where a hand or tool is and what it does there, in a stated frame.
struct ToolPose {
  static constexpr int kMostJoints = 32;

  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::uint32_t buttons = 0;  ///< a bit each
  int jointCount = 0;
  std::array<double, kMostJoints> joints{};  ///< rad, of exoskeletons and gloves
  bool isThere = true;                       ///< false: nobody knows where, and it touches nothing
};

/// What a device reports at one moment.
struct DeviceState {
  /// Counts the reports taken so far: the same number again means that nothing new has come.
  std::uint64_t sequence = 0;
  ToolPose pose;        ///< in the device's own frame
  bool isOver = false;  ///< whether this was the last: a recording has come to its end
};

/// What a device can do. A limit of zero means that it renders none.
struct DeviceInfo {
  std::string name;
  double largestForce = 0;      ///< N
  double largestTorque = 0;     ///< N m
  double largestStiffness = 0;  ///< N/m, rendered stably; 0 if not known
  double reportRate = 0;        ///< new states a second, 0 if not known
};

/// A hand's way into the scene: pose in, wrench out, in metres, newtons and newton metres.
///
/// One thread, the servo loop's, calls read and write; neither blocks, allocates nor throws.
/// Opening is the constructor's work, and it throws what a user can mend.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  virtual const DeviceInfo& info() const = 0;

  /// Takes the newest state there is. One that has fallen silent repeats its last sequence number.
  /// @return false, with `state` untouched, while the device is not there (unplugged).
  virtual bool read(DeviceState& state) noexcept = 0;

  /// Renders a wrench on the hand until the next one.
  /// @param wrench  in the device's frame, torque about its reported position.
  /// @return false if it did not arrive.
  virtual bool write(const Wrench& wrench) noexcept = 0;
};

}  // namespace palpate
