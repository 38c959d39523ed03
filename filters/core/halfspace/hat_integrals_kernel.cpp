// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled once per instruction set; see hat_integrals_kernel.h.

#include "halfspace/hat_integrals_kernel.h"

#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {
namespace {

constexpr int kWidth = static_cast<int>(Batch::size);
static_assert(kHatGroup % kWidth == 0);

/// Sums in the order of HatMoments.
struct Moments {
  Batch inverse = Batch(0), xx = Batch(0), xy = Batch(0), x = Batch(0), y = Batch(0);

  void addTo(double* out) const {
    const Batch* const sums[] = {&inverse, &xx, &xy, &x, &y};
    for (int i = 0; i < 5; ++i) out[i] += xsimd::hadd(*sums[i]);
  }
};

/// Integrals along an edge, rho^2 = h^2 + s^2 from s1 to s2. What diverges where x is on the edge
/// is bounded; it is multiplied with h = 0.
struct EdgeIntegrals {
  Batch ux, uy;  ///< the edge's direction
  Batch length, inverseLength;
  Batch h;  ///< distance of x from its line, positive on the left
  Batch s1;
  Batch inverse;    ///< of 1 / rho
  Batch rise;       ///< of s / rho
  Batch towards;    ///< of h^2 / rho^3
  Batch aside;      ///< of h s / rho^3
  Batch angle;      ///< of h / rho^2
  Batch logarithm;  ///< of s / rho^2
  Batch square;     ///< of s^2 / rho
  Batch middle;     ///< of s

  EdgeIntegrals(const Batch& ax, const Batch& ay, const Batch& bx, const Batch& by, const Batch& ex,
                const Batch& ey) {
    // Lengths are in units of the hat's radius, of which vertices are never so small a part apart.
    const Batch tiny(1e-30), zero(0);
    const Batch length2 = ex * ex + ey * ey;
    inverseLength = inverseSquareRoot(length2);
    length = length2 * inverseLength;
    ux = ex * inverseLength;
    uy = ey * inverseLength;
    const Batch ra2 = ax * ax + ay * ay, rb2 = bx * bx + by * by;
    // From the nearer end: exactly zero where x is at an end, and at most as far as that.
    const auto nearerA = ra2 < rb2;
    h = xsimd::select(nearerA, ax, bx) * uy - xsimd::select(nearerA, ay, by) * ux;
    s1 = ax * ux + ay * uy;
    const Batch s2 = bx * ux + by * uy;
    const Batch ia = inverseSquareRoot(xsimd::max(ra2, tiny)),
                ib = inverseSquareRoot(xsimd::max(rb2, tiny));
    const Batch ra = ra2 * ia, rb = rb2 * ib;
    const auto sameSide = s1 * s2 > zero;
    const Batch size1 = xsimd::abs(s1), size2 = xsimd::abs(s2), h2 = h * h;
    const Batch a = ra + size1, b = rb + size2;
    const Batch spread = length * (s1 + s2);  // s2^2 - s1^2

    // ln((ra + rb + length) / (ra + rb - length)), the difference as sums of positive numbers:
    // a + h^2 / b on one side of x's foot, h^2 / a + h^2 / b on both.
    const auto firstNearer = size1 < size2;
    const Batch nearer = xsimd::select(firstNearer, a, b),
                farther = xsimd::select(firstNearer, b, a);
    const Batch over = xsimd::select(sameSide, nearer * farther + h2, h2 * (a + b));
    const Batch under = xsimd::select(sameSide, farther, a * b);
    inverse = xsimd::log1p(2.0 * length * under / xsimd::max(over, tiny * tiny));
    rise = spread / (ra + rb);
    aside = h * rise * ia * ib;
    towards =
        xsimd::select(sameSide, spread * h2 * ia * ib / (s2 * ra + s1 * rb), s2 * ib - s1 * ia);
    const Batch dot = ax * bx + ay * by;
    angle = xsimd::atan2(h * length, xsimd::select(dot == zero, tiny, dot));
    const Batch largest = xsimd::max(ia, ib);
    const Batch size = 0.5 * xsimd::log1p(xsimd::abs(spread) * largest * largest);
    logarithm = xsimd::select(spread < zero, -size, size);
    square = 0.5 * (s2 * rb - s1 * ra - h2 * inverse);
    middle = 0.5 * spread;
  }
};

/// Adds integrals of which those of d d^T / r^3 and d / r^2 are given along the edge, u, and along
/// its normal p = (uy, -ux), which points away from x.
void add(const EdgeIntegrals& e, const Batch& inverse, const Batch& pp, const Batch& pu,
         const Batch& p, const Batch& u, Moments& sum) {
  const Batch uu = inverse - pp;
  sum.inverse += inverse;
  sum.xx += pp * e.uy * e.uy + 2.0 * pu * e.uy * e.ux + uu * e.ux * e.ux;
  sum.xy += (uu - pp) * e.ux * e.uy + pu * (e.uy * e.uy - e.ux * e.ux);
  sum.x -= p * e.uy + u * e.ux;
  sum.y -= u * e.uy - p * e.ux;
}

/// Adds factor times the integral of (base + tilt s) times the kernels along an edge.
void addAlong(const EdgeIntegrals& e, const Batch& factor, const Batch& base, const Batch& tilt,
              Moments& sum) {
  const Batch inverse = factor * (base * e.inverse + tilt * e.rise);
  const Batch pp = factor * (base * e.towards + tilt * e.h * e.aside);
  const Batch pu = factor * (base * e.aside + tilt * e.h * (e.inverse - e.towards));
  const Batch p = factor * (base * e.angle + tilt * e.h * e.logarithm);
  const Batch u = factor * (base * e.logarithm + tilt * (e.length - e.h * e.angle));
  add(e, inverse, pp, pu, p, u, sum);
}

/// Adds factor times the integral of s^2 times the kernels along an edge.
void addSquareAlong(const EdgeIntegrals& e, const Batch& factor, Moments& sum) {
  const Batch inverse = factor * e.square, h2 = e.h * e.h;
  const Batch pp = factor * h2 * (e.inverse - e.towards);
  const Batch pu = factor * (e.h * e.rise - h2 * e.aside);
  const Batch p = factor * e.h * (e.length - e.h * e.angle);
  const Batch u = factor * (e.middle - h2 * e.logarithm);
  add(e, inverse, pp, pu, p, u, sum);
}

/// Calls visit(integrals, number) for each batch of edges; number(which) gives those of HatEdge.
template <class Visit>
void forEachEdge(const double* edges, int groupCount, double x, double y, const Visit& visit) {
  for (int group = 0; group < groupCount; ++group, edges += kHatEdgeSize * kHatGroup)
    for (int lane = 0; lane < kHatGroup; lane += kWidth) {
      const auto number = [&](int which) {
        return Batch::load_unaligned(edges + which * kHatGroup + lane);
      };
      const Batch startX = number(kStartX), startY = number(kStartY), endX = number(kEndX),
                  endY = number(kEndY);
      visit(EdgeIntegrals(startX - x, startY - y, endX - x, endY - y, endX - startX, endY - startY),
            number);
    }
}

}  // namespace

void addHatEdges(const double* edges, int groupCount, double x, double y, double* moments) {
  Moments sum;
  forEachEdge(edges, groupCount, x, y, [&](const EdgeIntegrals& e, const auto& number) {
    const Batch atStart = number(kAtStart), tilt = (number(kAtEnd) - atStart) * e.inverseLength;
    // psi(x) + psi(s) = slope h + psi(0) + psi(0) + tilt s
    const Batch base = number(kSlope) * e.h + 2.0 * (atStart - tilt * e.s1);
    addAlong(e, 0.5 * e.h, base, tilt, sum);
  });
  sum.addTo(moments);
}

void addLineLoads(const double* lines, int groupCount, double x, double y, double* moments) {
  Moments sum;
  forEachEdge(lines, groupCount, x, y, [&](const EdgeIntegrals& e, const auto& number) {
    const Batch atStart = number(kAtStart), curve = (number(kAtEnd) - atStart) * e.inverseLength;
    const Batch breadth = number(kSlope);
    // (atStart + curve (s - s1)) (s - s1)
    addAlong(e, breadth, e.s1 * (curve * e.s1 - atStart), atStart - 2.0 * curve * e.s1, sum);
    addSquareAlong(e, breadth * curve, sum);
  });
  sum.addTo(moments);
}

void addPointLoads(const double* places, const double* loads, int groupCount, double x, double y,
                   double* moments) {
  Moments sum;
  for (int group = 0; group < groupCount; ++group, places += 2 * kHatGroup, loads += kHatGroup)
    for (int lane = 0; lane < kHatGroup; lane += kWidth) {
      const Batch dx = x - Batch::load_unaligned(places + lane),
                  dy = y - Batch::load_unaligned(places + kHatGroup + lane);
      const Batch inverse = inverseSquareRoot(dx * dx + dy * dy);
      const Batch first = Batch::load_unaligned(loads + lane) * inverse;
      const Batch second = first * inverse, third = second * inverse;
      sum.inverse += first;
      sum.xx += third * dx * dx;
      sum.xy += third * dx * dy;
      sum.x += second * dx;
      sum.y += second * dy;
    }
  sum.addTo(moments);
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
