// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>

namespace palpate::bench {

/// Reads memory once, as fast as the widest vector registers can: the yardstick of whatever
/// streams.
/// @param memory  aligned to 8 bytes.
/// @return a number that depends on every byte.
double readInOneStream(const void* memory, std::size_t bytes);
/// The same as eight streams, an eighth of the memory each, which keeps more of the prefetchers
/// busy.
double readInEightStreams(const void* memory, std::size_t bytes);

}  // namespace palpate::bench
