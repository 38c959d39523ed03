// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>

namespace palpate {

/// The process's resident memory now, in bytes; forgets the peak so far. 0 where the system does
/// not tell (other than Linux).
std::size_t startPeakMemory();

/// Its largest resident memory since startPeakMemory(), in bytes.
std::size_t peakMemory();

}  // namespace palpate
