// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/glove_device.h"

#include <stdexcept>
#include <string>

namespace palpate {
namespace {

DeviceRecording withAllJoints(DeviceRecording trace) {
  requireHandJoints(trace);
  return trace;
}

/// Angles of a grasp, rad.
void setGrasp(double fraction, ToolPose& pose) {
  pose.jointCount = HandJointCount;
  for (int finger : {IndexProximal, MiddleProximal, RingProximal, LittleProximal}) {
    pose.joints[static_cast<std::size_t>(finger)] = 1.2 * fraction;
    pose.joints[static_cast<std::size_t>(finger) + 1] = 1.4 * fraction;
    pose.joints[static_cast<std::size_t>(finger) + 2] = 0.8 * fraction;
  }
  for (int spread : {MiddleIndexAbduction, RingMiddleAbduction, LittleRingAbduction})
    pose.joints[static_cast<std::size_t>(spread)] = 0.15 * (1 - fraction);
  pose.joints[ThumbAbduction] = 0.8;
  pose.joints[ThumbRotation] = 1.0 * fraction;
  pose.joints[ThumbProximal] = 0.6 * fraction;
  pose.joints[ThumbDistal] = 0.7 * fraction;
  pose.joints[PalmArch] = 0.2 * fraction;
}

}  // namespace

void requireHandJoints(const DeviceRecording& trace) {
  for (std::size_t i = 0; i < trace.moments.size(); ++i) {
    const DeviceMoment& moment = trace.moments[i];
    if (moment.isThere && moment.state.pose.jointCount != HandJointCount)
      throw std::invalid_argument("moment " + std::to_string(i) + " of a glove's trace has " +
                                  std::to_string(moment.state.pose.jointCount) +
                                  " joints, not the 22 of a hand");
  }
}

GloveDevice::GloveDevice(DeviceRecording trace, const HandModel& hand)
    : script_(withAllJoints(std::move(trace))), hand_(hand) {}

DeviceRecording closingHand(int moments, const ToolPose& pose) {
  if (moments < 2)
    throw std::invalid_argument("a hand closes in 2 moments at least, not " +
                                std::to_string(moments));
  DeviceRecording trace;
  trace.info.name = "closing hand";
  trace.moments.resize(static_cast<std::size_t>(moments));
  for (int i = 0; i < moments; ++i) {
    DeviceState& state = trace.moments[static_cast<std::size_t>(i)].state;
    state.sequence = static_cast<std::uint64_t>(i) + 1;
    state.pose = pose;
    const double t = static_cast<double>(i) / (moments - 1);
    setGrasp(t * t * (3 - 2 * t), state.pose);
  }
  return trace;
}

}  // namespace palpate
