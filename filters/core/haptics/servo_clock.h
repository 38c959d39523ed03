// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>

namespace palpate {

/// Monotonic time, ns.
std::int64_t nowNanoseconds() noexcept;

/// Time that the calling thread has computed, ns: what others take of the processor is not in it.
std::int64_t threadNanoseconds() noexcept;

/// Returns at or after a moment of nowNanoseconds, or at once if it has passed.
void sleepUntil(std::int64_t nanoseconds) noexcept;

/// Asks for what makes the calling thread wake on time, as far as the system permits: first in,
/// first out scheduling, the process's memory locked where it is (what is allocated later is not),
/// 1 ns of timer slack. What is denied is left as it is. Locking a large process takes a while
/// (0.16 s for the libraries of a small one).
/// @param processor  to stay on; any if negative.
/// @return whether the scheduling was granted.
bool preferRealTime(int processor) noexcept;

}  // namespace palpate
