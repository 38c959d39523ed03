// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "haptics/haptic_device.h"

namespace palpate {

/// What one call of `HapticDevice::read` gave.
struct DeviceMoment {
  bool isThere = true;  ///< what read returned; if false, the state means nothing
  DeviceState state;
};

/// A device's moments in the order in which they were read.
struct DeviceRecording {
  DeviceInfo info;
  double rate = 0;  ///< moments a second, 0 if that is not known
  std::vector<DeviceMoment> moments;
};

/// Recordings as text, a moment a line; numbers keep all their digits, and what is no number stays
/// none:
///
///     palpate-device-recording 2
///     name a hand's press
///     limits 3.3 0 0                  largest force, torque, stiffness: N, N m, N/m
///     rate 1000                       moments a second
///     moments 2
///     7 0 0 0.01 1 0 0 0 0 0          sequence, position, orientation (w x y z), buttons,
///     away                            number of joints, their angles; or that it was not there
///
/// Lines may end as on Windows. In the first version there was no line of the rate: such files are
/// read as of a rate that is not known, and recordings of none are written so.
/// @throws std::runtime_error if the file cannot be opened, std::invalid_argument with the line's
///         number if it holds anything else.
DeviceRecording readDeviceRecording(const std::string& path);

/// Written whole or not at all.
/// @throws std::invalid_argument if the name has more than one line, the rate is negative or not
///         finite or a state has more than `ToolPose::kMostJoints` joints; std::runtime_error if
///         the file cannot be written.
void writeDeviceRecording(const DeviceRecording& recording, const std::string& path);

}  // namespace palpate
