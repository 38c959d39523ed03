// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "simd/dispatch.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace palpate::simd {
namespace {

InstructionSet detect() {
  InstructionSet best = InstructionSet::Baseline;
#if defined(PALPATE_HAVE_X86_KERNELS)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) best = InstructionSet::Avx2;
  if (best == InstructionSet::Avx2 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512bw"))
    best = InstructionSet::Avx512;
#endif
  const char* wish = std::getenv("PALPATE_SIMD");
  if (wish && std::string(wish) == "baseline") return InstructionSet::Baseline;
  if (wish && std::string(wish) == "avx2") return std::min(best, InstructionSet::Avx2);
  return best;
}

}  // namespace

InstructionSet instructionSet() {
  static const InstructionSet chosen = detect();
  return chosen;
}

const char* instructionSetName() {
  static const char* const names[] = {"baseline", "avx2", "avx512"};
  return names[static_cast<int>(instructionSet())];
}

}  // namespace palpate::simd
