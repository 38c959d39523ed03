// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace palpate {

/// Hands the newest of one thread's values to one other thread: three slots, one with the writer,
/// one with the reader, one between them that either swaps for its own. Neither ever waits, and
/// values that the reader was too slow for are lost.
template <class Value>
class NewestValue {
 public:
  /// The writer's.
  void put(const Value& value) noexcept {
    slots_[writers_] = value;
    writers_ = between_.exchange(writers_ | kFresh, std::memory_order_acq_rel) & kSlot;
  }

  /// The reader's.
  /// @return false, with `value` untouched, if nothing was put since the last call.
  bool take(Value& value) noexcept {
    if (!(between_.load(std::memory_order_relaxed) & kFresh)) return false;
    readers_ = between_.exchange(readers_, std::memory_order_acq_rel) & kSlot;
    value = slots_[readers_];
    return true;
  }

 private:
  static constexpr std::uint8_t kSlot = 3, kFresh = 4;
  std::array<Value, 3> slots_{};
  std::uint8_t writers_ = 0, readers_ = 1;
  std::atomic<std::uint8_t> between_{2};
};

}  // namespace palpate
