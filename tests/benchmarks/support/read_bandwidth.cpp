// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/read_bandwidth.h"

#include <cstdint>

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
#define PALPATE_BEST_CLONE __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define PALPATE_BEST_CLONE
#endif

namespace palpate::bench {
namespace {

/// A cache line.
using Line = std::uint64_t __attribute__((vector_size(64), aligned(8)));
constexpr std::size_t kRegisters = 8;

double fold(const Line* sums) {
  std::uint64_t all = 0;
  for (std::size_t k = 0; k < kRegisters; ++k)
    for (int i = 0; i < 8; ++i) all ^= sums[k][i];
  return static_cast<double>(all);
}

}  // namespace

PALPATE_BEST_CLONE double readInOneStream(const void* memory, std::size_t bytes) {
  const auto* lines = static_cast<const Line*>(memory);
  const std::size_t count = bytes / sizeof(Line);
  Line sums[kRegisters] = {};
  for (std::size_t i = 0; i + kRegisters <= count; i += kRegisters)
    for (std::size_t k = 0; k < kRegisters; ++k) sums[k] ^= lines[i + k];
  return fold(sums);
}

PALPATE_BEST_CLONE double readInEightStreams(const void* memory, std::size_t bytes) {
  const auto* lines = static_cast<const Line*>(memory);
  const std::size_t count = bytes / sizeof(Line) / kRegisters;
  Line sums[kRegisters] = {};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < kRegisters; ++k) sums[k] ^= lines[k * count + i];
  return fold(sums);
}

}  // namespace palpate::bench
