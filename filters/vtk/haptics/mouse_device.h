// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_mouse_device_h
#define palpate_mouse_device_h

#include "haptics/haptic_device.h"
#include "haptics/latest_value.h"

namespace palpate
{
/// The mouse as a device: the window's thread puts the probe where the pointer is, the servo thread reads
/// it there. It follows on a straight line, no faster than a hand would, and feels nothing: wrenches
/// arrive and are kept for nobody.
class MouseDevice final : public HapticDevice
{
public:
  /// @param period  s, between two reads.
  /// @param speed   the fastest that the probe follows, scene units a second.
  MouseDevice(double period, double speed);

  /// The window's: where the pointer has taken the probe, in the scene's frame.
  void Put(const ToolPose& pose) noexcept;
  /// The window's: the same, without a way there; before the first touch or after a jump. Read there once
  /// even if the pointer has gone on since.
  void PutAtOnce(const ToolPose& pose) noexcept;

  const DeviceInfo& info() const override { return this->Info; }
  bool read(DeviceState& state) noexcept override;
  bool write(const Wrench&) noexcept override { return true; }

private:
  struct Goal
  {
    ToolPose Pose;
    Eigen::Vector3d Start = Eigen::Vector3d::Zero(); ///< where the last jump led
    unsigned long Jumps = 0;
  };
  DeviceInfo Info;
  double Step; ///< most in a read
  LatestValue<Goal> Goals{ Goal() };
  Eigen::Vector3d Start = Eigen::Vector3d::Zero(); ///< the window's
  unsigned long Jumps = 0;     ///< the window's
  unsigned long JumpsSeen = 0; ///< the servo thread's
  DeviceState Now;             ///< the servo thread's
};
} // namespace palpate

#endif
