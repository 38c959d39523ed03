// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/scripted_device.h"

#include <stdexcept>

namespace palpate {

ScriptedDevice::ScriptedDevice(DeviceRecording recording) : recording_(std::move(recording)) {
  if (recording_.moments.empty())
    throw std::invalid_argument("a scripted device needs a moment to replay");
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  wrenches_.assign(recording_.moments.size(), Wrench{zero, zero});
}

bool ScriptedDevice::read(DeviceState& state) noexcept {
  const bool isOver = isFinished();
  if (!isOver) ++next_;
  const DeviceMoment& moment = recording_.moments[next_ - 1];
  if (moment.isThere) {
    state = moment.state;
    state.isOver = isOver;
  }
  return moment.isThere;
}

bool ScriptedDevice::write(const Wrench& wrench) noexcept {
  if (next_ == 0 || !recording_.moments[next_ - 1].isThere) return false;
  wrenches_[next_ - 1] = wrench;
  return true;
}

RecordingDevice::RecordingDevice(std::shared_ptr<HapticDevice> device, std::size_t mostMoments,
                                 double rate)
    : device_(std::move(device)), mostMoments_(mostMoments) {
  if (!device_) throw std::invalid_argument("there is no device to record");
  recording_.info = device_->info();
  recording_.rate = rate;
  recording_.moments.reserve(mostMoments);
}

bool RecordingDevice::read(DeviceState& state) noexcept {
  const bool isThere = device_->read(state);
  if (recording_.moments.size() < mostMoments_)
    recording_.moments.push_back({isThere, isThere ? state : DeviceState()});
  else
    ++leftOut_;
  return isThere;
}

}  // namespace palpate
