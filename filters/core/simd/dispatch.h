// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::simd {

enum class InstructionSet { Baseline, Avx2, Avx512 };

/// The best instruction set that this processor has and the library was built for. The environment
/// variable PALPATE_SIMD (baseline, avx2 or avx512) can lower it, for tests and comparisons.
InstructionSet instructionSet();

/// "baseline", "avx2" or "avx512".
const char* instructionSetName();

}  // namespace palpate::simd

// Kernel sources (palpate_add_simd_sources in CMake) are compiled once per instruction set, each
// into a namespace of that name. PALPATE_DECLARE_KERNEL declares a function in all of them;
// PALPATE_DISPATCH returns the result of the processor's best version.
#if defined(PALPATE_HAVE_X86_KERNELS)
#define PALPATE_DECLARE_KERNEL(declaration) \
  namespace simd_baseline {                 \
  declaration;                              \
  }                                         \
  namespace simd_avx2 {                     \
  declaration;                              \
  }                                         \
  namespace simd_avx512 {                   \
  declaration;                              \
  }
#define PALPATE_DISPATCH(call)                    \
  switch (::palpate::simd::instructionSet()) {    \
    case ::palpate::simd::InstructionSet::Avx512: \
      return ::palpate::simd_avx512::call;        \
    case ::palpate::simd::InstructionSet::Avx2:   \
      return ::palpate::simd_avx2::call;          \
    default:                                      \
      return ::palpate::simd_baseline::call;      \
  }
#else
#define PALPATE_DECLARE_KERNEL(declaration) \
  namespace simd_baseline {                 \
  declaration;                              \
  }
#define PALPATE_DISPATCH(call) return ::palpate::simd_baseline::call;
#endif
