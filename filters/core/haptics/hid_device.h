// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include "haptics/hid_protocol.h"
#include "haptics/latest_value.h"

namespace palpate {

/// A HID device behind a thread of its own, which alone opens, reads, writes and closes it: reports
/// are drained to the newest, the newest wrench is sent once, and a device that was unplugged is
/// opened again when it is back. The servo loop's side only swaps slots.
///
/// A device that reports only changes counts every read as a report: its silence says that nothing
/// moved. Any other that falls silent repeats its last sequence number. After an unplugging it is
/// there again from its first new state on.
class HidDevice final : public HapticDevice {
 public:
  struct Timing {
    /// Between attempts to open a device that is not there.
    std::chrono::microseconds reconnect = std::chrono::milliseconds(250);
    /// Without a new wrench for so long, the device is told to rest.
    std::chrono::microseconds silence = std::chrono::milliseconds(50);
  };

  /// What has happened so far.
  struct Counts {
    std::uint64_t connections = 0;     ///< times that the device was opened and prepared
    std::uint64_t statesTaken = 0;     ///< reports that were a new state
    std::uint64_t reportsIgnored = 0;  ///< wrong, late or repeated ones
    std::uint64_t wrenchesSent = 0;    ///< that arrived
    std::uint64_t wrenchesFailed = 0;  ///< that did not
    std::uint64_t rests = 0;           ///< times that it was told to rest
  };

  /// Opens the device, which must be there.
  /// @param name  for people.
  /// @throws std::invalid_argument without `open` or protocol; std::runtime_error if it is not
  ///         there or does not do what the protocol needs; whatever `open` throws.
  HidDevice(const std::string& name, HidOpener open, std::unique_ptr<HidProtocol> protocol,
            const Timing& timing);
  HidDevice(const std::string& name, HidOpener open, std::unique_ptr<HidProtocol> protocol)
      : HidDevice(name, std::move(open), std::move(protocol), Timing()) {}
  /// Tells the device to rest, and closes it.
  ~HidDevice() override;
  HidDevice(const HidDevice&) = delete;
  HidDevice& operator=(const HidDevice&) = delete;

  const DeviceInfo& info() const override { return info_; }
  bool read(DeviceState& state) noexcept override;
  /// @return false while the device is away, or if the wrench before did not arrive.
  bool write(const Wrench& wrench) noexcept override;

  Counts counts() const noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    std::uint64_t connection = 0;
    DeviceState state;
  };
  struct AtomicCounts {
    std::atomic<std::uint64_t> connections{0}, statesTaken{0}, reportsIgnored{0}, wrenchesSent{0},
        wrenchesFailed{0}, rests{0};
  };

  // The device's thread:
  void run(std::promise<DeviceInfo> opened) noexcept;
  DeviceInfo connect();
  bool exchange() noexcept;
  void renderNewest() noexcept;
  void publish() noexcept;
  void rest() noexcept;
  void disconnect() noexcept;
  void waitToReconnect();

  const std::string name_;
  DeviceInfo info_;
  const HidOpener open_;
  const std::unique_ptr<HidProtocol> protocol_;
  const Timing timing_;

  // The device's thread's own.
  std::unique_ptr<HidTransport> transport_;
  Clock::time_point lastWrench_;
  bool isResting_ = true;

  // Between the two.
  LatestValue<Entry> states_{Entry()};
  LatestValue<Wrench> wrenches_{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}};
  std::atomic<std::uint64_t> connection_{0};  ///< 0 while the device is away
  std::atomic<bool> hasArrived_{true}, stopping_{false};
  AtomicCounts counts_;
  std::mutex stopMutex_;
  std::condition_variable stopped_;

  // The servo loop's own.
  Entry newest_;
  std::uint64_t reads_ = 0;

  std::thread thread_;
};

}  // namespace palpate
