// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_device.h"

#include <array>
#include <stdexcept>

namespace palpate {
namespace {

// hidraw's own limit on a report.
constexpr std::size_t kLongestReport = 4096;
// Reports taken in a row before wrenches get their turn.
constexpr int kMostDrained = 256;
// How long the thread waits for a report: with wrenches to send, and without.
constexpr int kWaitToRender = 1, kWaitToRead = 20;

}  // namespace

HidDevice::HidDevice(const std::string& name, HidOpener open, std::unique_ptr<HidProtocol> protocol,
                     const Timing& timing)
    : name_(name), open_(std::move(open)), protocol_(std::move(protocol)), timing_(timing) {
  if (!open_ || !protocol_)
    throw std::invalid_argument("a HID device needs a way to open it and a protocol");
  std::promise<DeviceInfo> opened;
  std::future<DeviceInfo> info = opened.get_future();
  thread_ = std::thread(&HidDevice::run, this, std::move(opened));
  try {
    info_ = info.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

HidDevice::~HidDevice() {
  {
    const std::lock_guard<std::mutex> lock(stopMutex_);
    stopping_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

bool HidDevice::read(DeviceState& state) noexcept {
  const std::uint64_t connection = connection_.load(std::memory_order_acquire);
  states_.take(newest_);
  if (connection == 0 || newest_.connection != connection) return false;
  state = newest_.state;
  if (protocol_->reportsOnlyChanges()) state.sequence = ++reads_;
  return true;
}

bool HidDevice::write(const Wrench& wrench) noexcept {
  if (connection_.load(std::memory_order_acquire) == 0) return false;
  wrenches_.put(wrench);
  return hasArrived_.load(std::memory_order_relaxed);
}

HidDevice::Counts HidDevice::counts() const noexcept {
  return {counts_.connections,  counts_.statesTaken,    counts_.reportsIgnored,
          counts_.wrenchesSent, counts_.wrenchesFailed, counts_.rests};
}

void HidDevice::run(std::promise<DeviceInfo> opened) noexcept {
  try {
    DeviceInfo info = connect();
    if (!transport_) throw std::runtime_error("the device '" + name_ + "' is not there");
    opened.set_value(std::move(info));
  } catch (...) {
    transport_.reset();
    opened.set_exception(std::current_exception());
    return;
  }
  while (!stopping_) {
    if (!transport_) {
      waitToReconnect();
      try {
        if (!stopping_) connect();
      } catch (const std::exception&) {  // not ready yet: tried again
        transport_.reset();
      }
    } else if (!exchange()) {
      disconnect();
    }
  }
  if (transport_) rest();
  transport_.reset();
}

/// Leaves no transport if the device is not there.
DeviceInfo HidDevice::connect() {
  DeviceInfo info;
  info.name = name_;
  transport_ = open_();
  if (!transport_) return info;
  protocol_->start(*transport_, info);
  // A wrench from before says nothing about what the device touches now.
  Wrench old;
  wrenches_.take(old);
  isResting_ = true;
  hasArrived_ = true;
  connection_.store(++counts_.connections, std::memory_order_release);
  publish();
  return info;
}

void HidDevice::disconnect() noexcept {
  connection_.store(0, std::memory_order_release);
  transport_.reset();
}

void HidDevice::waitToReconnect() {
  std::unique_lock<std::mutex> lock(stopMutex_);
  stopped_.wait_for(lock, timing_.reconnect, [this] { return stopping_.load(); });
}

/// @return false if the device is gone.
bool HidDevice::exchange() noexcept {
  std::array<std::uint8_t, kLongestReport> bytes;
  const int wait = protocol_->rendersWrenches() ? kWaitToRender : kWaitToRead;
  int count = transport_->read(bytes.data(), bytes.size(), wait);
  bool isNew = false;
  for (int drained = 0; count > 0; ++drained) {
    const bool isTaken = protocol_->take(bytes.data(), static_cast<std::size_t>(count));
    ++(isTaken ? counts_.statesTaken : counts_.reportsIgnored);
    isNew = isNew || isTaken;
    if (drained == kMostDrained) break;
    count = transport_->read(bytes.data(), bytes.size(), 0);
  }
  if (isNew) publish();
  if (count < 0) return false;
  renderNewest();
  return true;
}

void HidDevice::publish() noexcept {
  const ToolPose* pose = protocol_->pose();
  if (!pose) return;
  Entry entry;
  entry.connection = counts_.connections;
  entry.state.sequence = counts_.statesTaken;
  entry.state.pose = *pose;
  states_.put(entry);
}

void HidDevice::renderNewest() noexcept {
  if (!protocol_->rendersWrenches()) return;
  const Clock::time_point now = Clock::now();
  Wrench wrench;
  if (wrenches_.take(wrench)) {
    const bool hasArrived = protocol_->render(*transport_, wrench);
    ++(hasArrived ? counts_.wrenchesSent : counts_.wrenchesFailed);
    hasArrived_ = hasArrived;
    lastWrench_ = now;
    isResting_ = false;
  } else if (!isResting_ && now - lastWrench_ > timing_.silence) {
    rest();
  }
}

void HidDevice::rest() noexcept {
  if (isResting_) return;
  protocol_->rest(*transport_);
  isResting_ = true;
  ++counts_.rests;
}

}  // namespace palpate
