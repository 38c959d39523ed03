// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::test {

/// Times that the calling thread has asked so far for a lock that it might have to wait for, or has
/// waited for a condition. Compile lock_count.cpp into the test program itself.
long lockCount();

/// Exceptions that the calling thread has thrown so far, caught or not.
long exceptionCount();

/// False where the C library or a sanitizer does not let the counters in.
bool locksAreCounted();

}  // namespace palpate::test
