// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace palpate {

/// Numbers in a cache line; the leading dimension of a matrix that is filled by streamStore is a
/// multiple of it.
template <class Scalar>
constexpr int kLine = 64 / sizeof(Scalar);

/// Copies past the caches, which need not read what will be overwritten whole.
/// @param target  aligned to 16 bytes; whole cache lines are written fastest.
/// @param count   a multiple of 4.
inline void streamStore(const double* source, int count, double* target) {
#if defined(__SSE2__)
  for (int i = 0; i < count; i += 2) _mm_stream_pd(target + i, _mm_loadu_pd(source + i));
#else
  for (int i = 0; i < count; ++i) target[i] = source[i];
#endif
}
inline void streamStore(const double* source, int count, float* target) {
#if defined(__SSE2__)
  for (int i = 0; i < count; i += 4)
    _mm_stream_ps(target + i, _mm_movelh_ps(_mm_cvtpd_ps(_mm_loadu_pd(source + i)),
                                            _mm_cvtpd_ps(_mm_loadu_pd(source + i + 2))));
#else
  for (int i = 0; i < count; ++i) target[i] = static_cast<float>(source[i]);
#endif
}

/// Makes streamed data visible to other threads.
inline void finishStreaming() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

}  // namespace palpate
