// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "haptics/hid_transport.h"

namespace palpate::test {

/// A HID device within the program, which the test plugs and unplugs, and whose reports it sends
/// and looks at. May be used from any thread.
class FakeHid {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// What it answers to feature requests; called from the thread that asks.
  std::function<bool(const Bytes&)> onSetFeature = [](const Bytes&) { return false; };
  std::function<Bytes(std::uint8_t)> onGetFeature = [](std::uint8_t) { return Bytes(); };
  /// Takes output reports; false says that one did not arrive.
  std::function<bool(const Bytes&)> onOutput = [](const Bytes&) { return true; };

  HidOpener opener() {
    return [this]() -> std::unique_ptr<HidTransport> {
      const std::lock_guard<std::mutex> lock(mutex_);
      note();
      if (!isPlugged_) return nullptr;
      waiting_.clear();
      return std::make_unique<Transport>(*this, generation_);
    };
  }

  void plug() {
    const std::lock_guard<std::mutex> lock(mutex_);
    isPlugged_ = true;
  }

  void unplug() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      isPlugged_ = false;
      ++generation_;
    }
    changed_.notify_all();
  }

  /// All at once: a reader finds them waiting together.
  void send(const std::vector<Bytes>& reports) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.insert(waiting_.end(), reports.begin(), reports.end());
    }
    changed_.notify_all();
  }

  std::vector<Bytes> outputs() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return outputs_;
  }

  /// Threads that have opened, used or closed it.
  std::set<std::thread::id> threads() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return threads_;
  }

 private:
  class Transport final : public HidTransport {
   public:
    Transport(FakeHid& hid, int generation) : hid_(hid), generation_(generation) {}
    ~Transport() override {
      const std::lock_guard<std::mutex> lock(hid_.mutex_);
      hid_.note();
    }

    int read(std::uint8_t* bytes, std::size_t room, int milliseconds) noexcept override {
      std::unique_lock<std::mutex> lock(hid_.mutex_);
      hid_.note();
      hid_.changed_.wait_for(lock, std::chrono::milliseconds(milliseconds),
                             [this] { return isGone() || !hid_.waiting_.empty(); });
      if (isGone()) return -1;
      if (hid_.waiting_.empty()) return 0;
      const Bytes report = hid_.waiting_.front();
      hid_.waiting_.pop_front();
      const std::size_t count = std::min(room, report.size());
      std::copy_n(report.begin(), count, bytes);
      return static_cast<int>(count);
    }

    bool write(const std::uint8_t* bytes, std::size_t count) noexcept override {
      const std::lock_guard<std::mutex> lock(hid_.mutex_);
      hid_.note();
      if (isGone() || !hid_.onOutput(Bytes(bytes, bytes + count))) return false;
      hid_.outputs_.emplace_back(bytes, bytes + count);
      return true;
    }

    bool setFeature(const std::uint8_t* bytes, std::size_t count) noexcept override {
      const std::lock_guard<std::mutex> lock(hid_.mutex_);
      hid_.note();
      return !isGone() && hid_.onSetFeature(Bytes(bytes, bytes + count));
    }

    int getFeature(std::uint8_t* bytes, std::size_t room) noexcept override {
      const std::lock_guard<std::mutex> lock(hid_.mutex_);
      hid_.note();
      const Bytes report = isGone() ? Bytes() : hid_.onGetFeature(bytes[0]);
      if (report.empty()) return -1;
      const std::size_t count = std::min(room, report.size());
      std::copy_n(report.begin(), count, bytes);
      return static_cast<int>(count);
    }

   private:
    bool isGone() const { return generation_ != hid_.generation_; }

    FakeHid& hid_;
    const int generation_;
  };

  void note() { threads_.insert(std::this_thread::get_id()); }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool isPlugged_ = true;
  int generation_ = 0;
  std::deque<Bytes> waiting_;
  std::vector<Bytes> outputs_;
  std::set<std::thread::id> threads_;
};

}  // namespace palpate::test
