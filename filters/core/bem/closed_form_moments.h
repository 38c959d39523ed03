// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

// Closed forms of the near-singular and singular integrals over a flat triangle, for sources that
// are compiled once per instruction set.
//
// With the point x, its projection as the origin of the triangle's plane, d = n.(y - x) and rho the
// in-plane part of r = y - x, every integral of a linear function times a Kelvin kernel is a
// combination of in-plane moments  I_p[f] = integral of f(rho) / r^p dA,  f of degree 0..3. Since
//   rho_i / r^(p+2) = -grad_i(r^-p) / p,
// the divergence theorem lowers the degree until only line integrals along the edges remain and
//   d I_3[1] = solid angle,   I_1[1] = sum over edges of h L - d * solid angle,
// where h is the edge's signed in-plane distance from the origin and L = integral of ds / r.

#include "bem/edge_integrals.h"
#include "bem/panel_integration.h"
#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {

constexpr double kPi = 3.14159265358979323846;

/// Moments of one hat function phi over a triangle, in global coordinates.
struct Moments {
  Batch one[6];    ///< integral of phi r_a r_b / r^3: xx, xy, xz, yy, yz, zz; its trace is phi / r
  Batch three[3];  ///< integral of phi r_a / r^3
  Batch five[6];   ///< d times integral of phi r_a r_b / r^5
};

class ClosedFormMoments {
 public:
  /// @param own   lanes whose point lies on the triangle, or null.
  /// @param lane  first lane of the panel to compute.
  ClosedFormMoments(const bem::PanelTask& task, const bem::PanelTriangle& t,
                    const bem::OwnTriangle* own, int lane)
      : t_(t), frame_(*t.frame), own_(own), lane_(lane) {
    project(task);
    integrate();
  }

  Moments ofHat(int k) const {
    const double gx = frame_.gradient[k][0], gy = frame_.gradient[k][1];
    const Batch a = hatAtOrigin_[k];
    // r r / r^3 in the local frame: 11, 12, 1n, 22, 2n, nn.
    const Batch one[6] = {combine(a, three2_[0], gx, three3_[0], gy, three3_[1]),
                          combine(a, three2_[1], gx, three3_[1], gy, three3_[2]),
                          d_ * combine(a, three1_[0], gx, three2_[0], gy, three2_[1]),
                          combine(a, three2_[2], gx, three3_[2], gy, three3_[3]),
                          d_ * combine(a, three1_[1], gx, three2_[1], gy, three2_[2]),
                          d_ * combine(a, angle_, gx, d_ * three1_[0], gy, d_ * three1_[1])};

    const Batch b = own_ ? a - Batch::load_unaligned(own_->barycentric[k] + lane_) : a;
    const Batch three[3] = {combine(b, three1_[0], gx, three2_[0], gy, three2_[1]),
                            combine(b, three1_[1], gx, three2_[1], gy, three2_[2]),
                            combine(b, angle_, gx, d_ * three1_[0], gy, d_ * three1_[1])};
    const Batch dd = d_ * d_;
    const Batch five[6] = {combine(b, five2_[0], gx, five3_[0], gy, five3_[1]),
                           combine(b, five2_[1], gx, five3_[1], gy, five3_[2]),
                           d_ * combine(b, d_ * five1_[0], gx, five2_[0], gy, five2_[1]),
                           combine(b, five2_[2], gx, five3_[2], gy, five3_[3]),
                           d_ * combine(b, d_ * five1_[1], gx, five2_[1], gy, five2_[2]),
                           combine(b, five0_, gx, dd * d_ * five1_[0], gy, dd * d_ * five1_[1])};
    Moments m;
    rotate(one, m.one);
    rotate(five, m.five);
    for (int c = 0; c < 3; ++c)
      m.three[c] =
          frame_.axis1[c] * three[0] + frame_.axis2[c] * three[1] + t_.normal[c] * three[2];
    return m;
  }

 private:
  static Batch combine(const Batch& a, const Batch& x, double gx, const Batch& y, double gy,
                       const Batch& z) {
    return xsimd::fma(a, x, xsimd::fma(Batch(gx), y, gy * z));
  }

  /// Puts the origin of the plane below x: exactly so where x lies on the triangle.
  void project(const bem::PanelTask& task) {
    Batch offset[3];
    for (int c = 0; c < 3; ++c)
      offset[c] = Batch::load_unaligned(task.x[c] + lane_) - t_.vertex[0][c];
    Batch x1 = dot(frame_.axis1, offset), x2 = dot(frame_.axis2, offset);
    d_ = -dot(t_.normal, offset);
    if (own_) {
      const auto isOwn = Batch::load_unaligned(own_->mask + lane_) > Batch(0.5);
      Batch own1(0), own2(0);
      for (int k = 1; k < 3; ++k) {
        const Batch weight = Batch::load_unaligned(own_->barycentric[k] + lane_);
        own1 = xsimd::fma(weight, Batch(frame_.planar[k][0]), own1);
        own2 = xsimd::fma(weight, Batch(frame_.planar[k][1]), own2);
      }
      x1 = xsimd::select(isOwn, own1, x1);
      x2 = xsimd::select(isOwn, own2, x2);
      d_ = xsimd::select(isOwn, Batch(0), d_);
    }
    for (int k = 0; k < 3; ++k) {
      rho_[k][0] = frame_.planar[k][0] - x1;
      rho_[k][1] = frame_.planar[k][1] - x2;
      r_[k] = xsimd::sqrt(
          xsimd::fma(rho_[k][0], rho_[k][0], xsimd::fma(rho_[k][1], rho_[k][1], d_ * d_)));
    }
    hatAtOrigin_[1] = x1 * frame_.gradient[1][0] + x2 * frame_.gradient[1][1];
    hatAtOrigin_[2] = x1 * frame_.gradient[2][0] + x2 * frame_.gradient[2][1];
    hatAtOrigin_[0] = 1.0 - hatAtOrigin_[1] - hatAtOrigin_[2];
    if (own_) {
      const auto isOwn = Batch::load_unaligned(own_->mask + lane_) > Batch(0.5);
      for (int k = 0; k < 3; ++k)
        hatAtOrigin_[k] = xsimd::select(isOwn, Batch::load_unaligned(own_->barycentric[k] + lane_),
                                        hatAtOrigin_[k]);
    }
  }

  void integrate() {
    angle_ = solidAngle();
    Batch one0 = -d_ * angle_, one1[2] = {Batch(0), Batch(0)}, hk0(0);
    for (int i = 0; i < 2; ++i) three1_[i] = five1_[i] = Batch(0);
    for (int c = 0; c < 3; ++c) three2_[c] = five2_[c] = Batch(0);
    for (int c = 0; c < 4; ++c) three3_[c] = five3_[c] = Batch(0);
    for (int e = 0; e < 3; ++e) {
      const int to = (e + 1) % 3;
      const double* n = frame_.outward[e];
      const double* t = frame_.tangent[e];
      const EdgeIntegrals edge(
          n[0] * rho_[e][0] + n[1] * rho_[e][1], d_, t[0] * rho_[e][0] + t[1] * rho_[e][1],
          t[0] * rho_[to][0] + t[1] * rho_[to][1], r_[e], r_[to], frame_.length[e]);
      one0 = xsimd::fma(edge.h, edge.j0, one0);
      hk0 = xsimd::fma(edge.h, edge.k0, hk0);
      for (int i = 0; i < 2; ++i) {
        one1[i] += n[i] * edge.length;
        three1_[i] -= n[i] * edge.j0;
        five1_[i] -= n[i] * edge.k0;
      }
      subtractEdge(edge.h, edge.j0, edge.j1, edge.j2, n, t, three2_, three3_);
      subtractEdge(edge.h, edge.k0, edge.k1, edge.k2, n, t, five2_, five3_);
    }
    three2_[0] += one0;
    three2_[2] += one0;
    three3_[0] += 2.0 * one1[0];
    three3_[3] += 2.0 * one1[1];
    five2_[0] = d_ * five2_[0] + angle_;
    five2_[1] = d_ * five2_[1];
    five2_[2] = d_ * five2_[2] + angle_;
    for (int c = 0; c < 4; ++c) five3_[c] = d_ * five3_[c];
    five3_[0] += 2.0 * d_ * three1_[0];
    five3_[3] += 2.0 * d_ * three1_[1];
    constexpr double third = 1.0 / 3.0;
    five0_ = third * (angle_ + d_ * hk0);
    for (int i = 0; i < 2; ++i) five1_[i] = third * five1_[i];
    for (int c = 0; c < 3; ++c) five2_[c] = third * five2_[c];
    for (int c = 0; c < 4; ++c) five3_[c] = third * five3_[c];
  }

  /// Subtracts n_i times the line integrals of rho_j and rho_j rho_k, with rho = h n + s t, from
  /// the components 11, 12, 22 and 111, 112, 122, 222 (index i chosen so that no other term appears
  /// in the mixed ones).
  static void subtractEdge(const Batch& h, const Batch& q0, const Batch& q1, const Batch& q2,
                           const double* n, const double* t, Batch* degree2, Batch* degree3) {
    const Batch hq0 = h * q0, hq1 = h * q1, hhq0 = h * hq0;
    const Batch line1 = n[0] * hq0 + t[0] * q1, line2 = n[1] * hq0 + t[1] * q1;
    degree2[0] -= n[0] * line1;
    degree2[1] -= n[0] * line2;
    degree2[2] -= n[1] * line2;
    const Batch line11 = n[0] * n[0] * hhq0 + 2 * n[0] * t[0] * hq1 + t[0] * t[0] * q2;
    const Batch line22 = n[1] * n[1] * hhq0 + 2 * n[1] * t[1] * hq1 + t[1] * t[1] * q2;
    degree3[0] -= n[0] * line11;
    degree3[1] -= n[1] * line11;
    degree3[2] -= n[0] * line22;
    degree3[3] -= n[1] * line22;
  }

  /// d times the integral of 1/r^3: the signed solid angle (van Oosterom & Strackee 1983).
  Batch solidAngle() const {
    const Batch dd = d_ * d_;
    Batch dots[3];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      dots[k] = xsimd::fma(rho_[k][0], rho_[next][0], xsimd::fma(rho_[k][1], rho_[next][1], dd));
    }
    const Batch denominator =
        r_[0] * r_[1] * r_[2] + dots[0] * r_[2] + dots[1] * r_[0] + dots[2] * r_[1];
    const Batch numerator = 2 * t_.area * d_;
    const Batch angle = 2.0 * xsimd::atan2(numerator, denominator);
    return xsimd::select(d_ == Batch(0), Batch(0), angle);
  }

  static Batch dot(const double* a, const Batch* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  /// Symmetric tensor from the local frame (11, 12, 1n, 22, 2n, nn) to global axes.
  void rotate(const Batch* local, Batch* global) const {
    static constexpr int index[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    Batch half[3][3];  // local tensor times the frame's rows
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        half[i][c] = local[index[i][0]] * frame_.axis1[c] + local[index[i][1]] * frame_.axis2[c] +
                     local[index[i][2]] * t_.normal[c];
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b)
        global[index[a][b]] =
            frame_.axis1[a] * half[0][b] + frame_.axis2[a] * half[1][b] + t_.normal[a] * half[2][b];
  }

  const bem::PanelTriangle& t_;
  const bem::TriangleFrame& frame_;
  const bem::OwnTriangle* own_;
  int lane_;
  Batch d_, rho_[3][2], r_[3], hatAtOrigin_[3];
  Batch angle_;                              // d I_3[1]
  Batch three1_[2], three2_[3], three3_[4];  // I_3 of degree 1, 2, 3
  Batch five1_[2];                           // I_5 of degree 1
  Batch five2_[3], five3_[4];                // d I_5 of degree 2, 3
  Batch five0_;                              // d^3 I_5[1]
};

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
