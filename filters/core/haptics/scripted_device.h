// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "haptics/device_recording.h"

namespace palpate {

/// Replays a recording, a moment per read, and remembers the wrenches that it was to render. After
/// its last moment it stays as that one was, silent, which it says is the end, or away.
class ScriptedDevice final : public HapticDevice {
 public:
  /// @throws std::invalid_argument if there is no moment to replay.
  explicit ScriptedDevice(DeviceRecording recording);

  const DeviceInfo& info() const override { return recording_.info; }
  bool read(DeviceState& state) noexcept override;
  /// Arrives unless the device was away at the last read.
  bool write(const Wrench& wrench) noexcept override;

  /// Reads so far that gave a moment of their own.
  std::size_t momentsRead() const noexcept { return next_; }
  bool isFinished() const noexcept { return next_ == recording_.moments.size(); }
  /// Of the wrenches that arrived after each moment's read, the last; zero where none did.
  /// As many as moments.
  const std::vector<Wrench>& wrenches() const noexcept { return wrenches_; }

 private:
  DeviceRecording recording_;
  std::vector<Wrench> wrenches_;
  std::size_t next_ = 0;
};

/// Passes another device's states and wrenches on and keeps the states, without allocating while
/// it does.
class RecordingDevice final : public HapticDevice {
 public:
  /// @param mostMoments  after which it only passes on.
  /// @param rate         at which it is read, moments a second; 0 if that is not known.
  /// @throws std::invalid_argument without a device.
  RecordingDevice(std::shared_ptr<HapticDevice> device, std::size_t mostMoments, double rate = 0);

  const DeviceInfo& info() const override { return device_->info(); }
  bool read(DeviceState& state) noexcept override;
  bool write(const Wrench& wrench) noexcept override { return device_->write(wrench); }

  /// Not while another thread reads.
  const DeviceRecording& recording() const noexcept { return recording_; }
  /// Moments that it had no room for. Not while another thread reads.
  std::size_t leftOut() const noexcept { return leftOut_; }

 private:
  std::shared_ptr<HapticDevice> device_;
  DeviceRecording recording_;
  std::size_t mostMoments_, leftOut_ = 0;
};

}  // namespace palpate
