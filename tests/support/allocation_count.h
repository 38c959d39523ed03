// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::test {

/// Blocks of heap memory that the calling thread has asked for so far, by whatever route (new,
/// malloc, Eigen, LAPACK). Compile allocation_count.cpp into the test program itself.
long allocationCount();

/// False where the C library or a sanitizer does not let the counter in.
bool allocationsAreCounted();

}  // namespace palpate::test
