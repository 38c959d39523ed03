// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::bench {

/// Blocks of heap memory asked for since the program began, by any library and thread (glibc). Only
/// for programs that link allocation_count.cpp, which stands before the C library's functions.
long allocationCount();

}  // namespace palpate::bench
