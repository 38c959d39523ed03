// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "haptics/haptic_device.h"
#include "haptics/latest_value.h"
#include "support/stand_in_sdk.h"

namespace palpate::test {

/// An example of a device with a vendor's library; filters/core/haptics/adding_a_device.md tells
/// why each part is there.
class VendorDevice final : public HapticDevice {
 public:
  /// @throws std::runtime_error if no arm is plugged in.
  VendorDevice() : handle_(stand_in_sdk::armOpen()) {
    if (handle_ < 0) throw std::runtime_error("no arm answers: is it plugged in and switched on?");
    info_ = {"stand-in arm", 3.3, 0, 800, 1000};
    thread_ = std::thread(&VendorDevice::run, this);
  }

  ~VendorDevice() override {
    isStopping_ = true;
    thread_.join();
  }

  const DeviceInfo& info() const override { return info_; }

  bool read(DeviceState& state) noexcept override {
    if (!isThere_) return false;
    states_.take(newest_);
    state = newest_;
    return newest_.sequence > 0;
  }

  bool write(const Wrench& wrench) noexcept override {
    wrenches_.put(wrench);
    return isThere_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kPeriod = std::chrono::milliseconds(1);
  static constexpr auto kSilence = std::chrono::milliseconds(50);

  /// All calls of the vendor's library but the first are made here.
  void run() noexcept {
    DeviceState state;
    Clock::time_point tick = Clock::now(), lastWrench = tick;
    while (!isStopping_) {
      isThere_ = takePose(state.pose);
      if (isThere_) {
        ++state.sequence;
        states_.put(state);
      }
      Wrench wrench;
      if (wrenches_.take(wrench)) {
        lastWrench = Clock::now();
        setForce(wrench.force);
      } else if (Clock::now() - lastWrench > kSilence) {
        setForce(Eigen::Vector3d::Zero());
      }
      tick = std::max(tick + kPeriod, Clock::now());  // missed ticks are skipped
      std::this_thread::sleep_until(tick);
    }
    setForce(Eigen::Vector3d::Zero());
    stand_in_sdk::armClose(handle_);
  }

  bool takePose(ToolPose& pose) const noexcept {
    Eigen::Vector3d millimetres;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> matrix;
    if (stand_in_sdk::armGetPose(handle_, millimetres.data(), matrix.data(), &pose.buttons) != 0)
      return false;
    pose.position = 1e-3 * millimetres;
    pose.orientation = Eigen::Quaterniond(Eigen::Matrix3d(matrix));
    return true;
  }

  void setForce(const Eigen::Vector3d& force) const noexcept {
    const Eigen::Vector3d newtons = force.allFinite() ? force : Eigen::Vector3d(0, 0, 0);
    stand_in_sdk::armSetForce(handle_, newtons.data());
  }

  const int handle_;
  DeviceInfo info_;
  LatestValue<DeviceState> states_{DeviceState()};
  LatestValue<Wrench> wrenches_{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}};
  std::atomic<bool> isThere_{true}, isStopping_{false};
  DeviceState newest_;
  std::thread thread_;
};

}  // namespace palpate::test
