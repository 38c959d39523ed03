// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <new>
#include <type_traits>

namespace palpate {

/// Small functions that one thread hands to another, which calls them in their order when it suits
/// it. Room for kCapacity of them is there from the start; neither side waits or allocates.
template <class Target>
class CommandRing {
 public:
  static constexpr std::size_t kCapacity = 64, kBytes = 128, kAlignment = 64;

  /// @param command  copied, which must not throw; called as command(target), which must not throw.
  /// @return false if the ring is full; nothing is posted then.
  template <class Command>
  bool post(const Command& command) noexcept {
    static_assert(sizeof(Command) <= kBytes && alignof(Command) <= kAlignment,
                  "a command is small: hand over a pointer to more");
    static_assert(std::is_trivially_destructible_v<Command>, "a command owns nothing");
    static_assert(std::is_nothrow_invocable_v<const Command&, Target&>, "a command is noexcept");
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == kCapacity) return false;
    Slot& slot = slots_[end % kCapacity];
    new (slot.bytes) Command(command);
    slot.call = [](const void* bytes, Target& target) noexcept {
      (*static_cast<const Command*>(bytes))(target);
    };
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// Calls what has been posted.
  void takeAll(Target& target) noexcept {
    std::size_t begin = begin_.load(std::memory_order_relaxed);
    for (const std::size_t end = end_.load(std::memory_order_acquire); begin != end; ++begin) {
      const Slot& slot = slots_[begin % kCapacity];
      slot.call(slot.bytes, target);
      begin_.store(begin + 1, std::memory_order_release);
    }
  }

 private:
  struct Slot {
    alignas(kAlignment) std::byte bytes[kBytes];
    void (*call)(const void*, Target&) noexcept = nullptr;
  };

  std::array<Slot, kCapacity> slots_;
  alignas(64) std::atomic<std::size_t> begin_{0};
  alignas(64) std::atomic<std::size_t> end_{0};
};

}  // namespace palpate
