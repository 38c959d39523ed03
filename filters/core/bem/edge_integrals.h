// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// For sources that are compiled once per instruction set, see closed_form_moments.h.

#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {

/// The integrals along one edge, s from s1 to s2 with r^2 = s^2 + R^2.
struct EdgeIntegrals {
  Batch h;           ///< in-plane distance of the edge's line from the origin, outwards positive
  Batch j0, j1, j2;  ///< integrals of 1, s, s^2 over r
  Batch k0, k1, k2;  ///< integrals of 1, s, s^2 over r^3
  Batch length;      ///< integral of r

  EdgeIntegrals(const Batch& distance, const Batch& d, const Batch& s1, const Batch& s2,
                const Batch& r1, const Batch& r2, double edgeLength)
      : h(distance) {
    // Where x is on the edge, the integrals that diverge are left out (zero): on x's own
    // triangles what they are multiplied with vanishes.
    const double tiny = 1e-13 * edgeLength;
    const auto sameSide = s1 * s2 > Batch(0);
    const Batch square = xsimd::fma(h, h, d * d);
    const auto onEdge =
        r1 <= Batch(tiny) || r2 <= Batch(tiny) || (!sameSide && square <= Batch(tiny * tiny));
    const Batch safeSquare = xsimd::select(sameSide || onEdge, Batch(1), square);

    // L = ln((r2 + s2)/(r1 + s1)) without cancellation: sums of positive numbers only.
    const Batch a1 = r1 + xsimd::abs(s1), a2 = r2 + xsimd::abs(s2);
    const Batch ratio = xsimd::select(
        sameSide, xsimd::select(s1 + s2 >= Batch(0), a2 / a1, a1 / a2), a1 * a2 / safeSquare);
    j0 = xsimd::select(onEdge, Batch(0), xsimd::log(xsimd::select(onEdge, Batch(1), ratio)));
    j1 = r2 - r1;
    const Batch ends = xsimd::fms(s2, r2, s1 * r1);
    j2 = 0.5 * (ends - square * j0);
    length = 0.5 * (ends + square * j0);

    const Batch i1 = 1.0 / xsimd::select(onEdge, Batch(1), r1);
    const Batch i2 = 1.0 / xsimd::select(onEdge, Batch(1), r2);
    const Batch cross = xsimd::select(sameSide, xsimd::fma(s2, r1, s1 * r2), Batch(1));
    // s2/r2 - s1/r1, over R^2 where it would cancel.
    const Batch stable = (s2 - s1) * (s2 + s1) * i1 * i2 / cross;
    const Batch difference = xsimd::select(sameSide, square * stable, xsimd::fms(s2, i2, s1 * i1));
    k0 = xsimd::select(onEdge, Batch(0), xsimd::select(sameSide, stable, difference / safeSquare));
    k1 = xsimd::select(onEdge, Batch(0), i1 - i2);
    k2 = xsimd::select(onEdge, Batch(0), j0 - difference);
  }
};

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
