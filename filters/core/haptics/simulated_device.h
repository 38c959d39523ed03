// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <vector>

#include "haptics/haptic_device.h"

namespace palpate {

/// A hand that holds a device as a spring and damper hold it to a path, and pushes besides.
struct SimulatedHand {
  double stiffness = 0;  ///< N/m
  double damping = 0;    ///< N s/m
  /// Where the hand wants to be at a time (s); the origin if empty. Called once a tick; it must
  /// neither allocate nor throw.
  std::function<Eigen::Vector3d(double)> path;
  /// What it pushes with besides, N; nothing if empty. As path.
  std::function<Eigen::Vector3d(double)> push;
};

struct SimulatedDeviceSettings {
  double mass = 0.075;      ///< kg
  double damping = 0.5;     ///< b, N s/m
  double period = 1e-3;     ///< T, s, between two reads
  int delay = 0;            ///< d: a force written after read n acts from read n + d to n + d + 1
  double quantum = 0;       ///< m; positions reported are its multiples, 0: as they are
  double largestForce = 0;  ///< N, by which each force is cut; 0: none
  SimulatedHand hand;
};

/// A device without hardware: three axes of mass and damping in a hand,
///
///     m x'' = f - b x' - k_h (x - x_h) - b_h (x' - x_h') + f_h
///
/// Its own time advances by one period with every read, so that a loop on virtual time repeats bit
/// for bit. Forces are held over a period, and the hand moves on straight lines between its places
/// at the ticks; for such input each step is exact (matrix exponential), at any stiffness of the
/// hand. Orientation stays the identity and torques are not felt.
class SimulatedDevice : public HapticDevice {
 public:
  /// At rest at the origin.
  /// @throws std::invalid_argument naming the setting that is out of range.
  explicit SimulatedDevice(const SimulatedDeviceSettings& settings);

  const DeviceInfo& info() const override { return info_; }
  bool read(DeviceState& state) noexcept override;
  bool write(const Wrench& wrench) noexcept override;

  /// As they are, not as reported; for the thread that reads and writes.
  const Eigen::Vector3d& position() const noexcept { return position_; }
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// s, of the last read.
  double time() const noexcept { return tick_ ? (tick_ - 1.0) * settings_.period : 0; }

  void place(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) noexcept;

 private:
  void advance() noexcept;

  SimulatedDeviceSettings settings_;
  DeviceInfo info_;
  /// Of (distance from the hand, velocity), and per newton, over a period.
  Eigen::Matrix2d transition_;
  Eigen::Vector2d response_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> forces_;  ///< ring of delay + 1, by tick
  std::uint64_t tick_ = 0;               ///< reads so far
};

}  // namespace palpate
