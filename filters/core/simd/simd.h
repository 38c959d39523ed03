// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// For sources that are compiled once per instruction set (palpate_add_simd_sources in CMake), and
// for nothing else: they include no header whose inline functions another source could share.

#include <xsimd/xsimd.hpp>

#if !defined(PALPATE_SIMD_NAMESPACE)
#error "compile this source with palpate_add_simd_sources"
#endif

namespace palpate::PALPATE_SIMD_NAMESPACE {

using Batch = xsimd::batch<double>;

inline Batch loadAsDouble(const double* source) {
  return Batch::load_unaligned(source);
}

/// Batch::size floats, widened.
inline Batch loadAsDouble(const float* source) {
#if defined(__AVX512F__)
  return Batch(_mm512_cvtps_pd(_mm256_loadu_ps(source)));
#elif defined(__AVX2__)
  return Batch(_mm256_cvtps_pd(_mm_loadu_ps(source)));
#else
  return Batch(_mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i*)source))));
#endif
}

/// Asks for a cache line ahead of its use; any address will do.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

/// 1/sqrt(x) to double precision for normal floats' range of x (1e-37 .. 1e37).
inline Batch inverseSquareRoot(const Batch& x) {
#if defined(__AVX512F__)
  Batch y = _mm512_rsqrt14_pd(x);
  constexpr int newtonSteps = 2;
#elif defined(__AVX2__)
  Batch y = _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(x)));
  constexpr int newtonSteps = 3;
#else
  Batch y = 1.0 / xsimd::sqrt(x);
  constexpr int newtonSteps = 0;
#endif
  const Batch half = 0.5 * x;
  for (int step = 0; step < newtonSteps; ++step) y = y * xsimd::fnma(half * y, y, Batch(1.5));
  return y;
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
