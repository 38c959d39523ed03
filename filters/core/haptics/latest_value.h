// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <atomic>

namespace palpate {

/// The newest of the values that one thread makes, for one other thread that looks now and then.
///
/// Three slots (triple buffering): the writer owns one, the reader one, the third changes hands by
/// one atomic exchange. Neither side ever waits, allocates or sees half a value; what the reader
/// does not fetch in time is overwritten.
template <class Value>
class LatestValue {
 public:
  /// Every slot starts as a copy of this, with all the room that later values need.
  explicit LatestValue(const Value& initial) : slots_{{{initial}, {initial}, {initial}}} {}

  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// The writer's slot. It holds an older value, not the last one published.
  Value& writable() noexcept { return slots_[writing_].value; }

  /// The writer's slot becomes the newest value.
  void publish() noexcept {
    writing_ = between_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Both in one, for values that are cheap to copy.
  void put(const Value& value) noexcept {
    writable() = value;
    publish();
  }

  /// Lets the reader's slot be the newest value.
  /// @return whether there was a newer one.
  bool update() noexcept {
    if (!(between_.load(std::memory_order_relaxed) & kFresh)) return false;
    reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Copies it, for the reader.
  /// @return false, with `value` untouched, if nothing was published since the last call.
  bool take(Value& value) noexcept {
    if (!update()) return false;
    value = latest();
    return true;
  }

  /// The reader's slot: unchanged until its next update.
  const Value& latest() const noexcept { return slots_[reading_].value; }

 private:
  static constexpr unsigned kFresh = 4, kIndex = 3;
  // A slot starts on a cache line of its own, so that filling one does not slow the other's reader.
  struct alignas(64) Slot {
    Value value;
  };

  std::array<Slot, 3> slots_;
  alignas(64) unsigned writing_ = 0;
  alignas(64) unsigned reading_ = 1;
  alignas(64) std::atomic<unsigned> between_{2};
  static_assert(std::atomic<unsigned>::is_always_lock_free);
};

}  // namespace palpate
