// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled once per instruction set; see panel_integration.h for what it computes.

#include "bem/closed_form_moments.h"
#include "bem/panel_integration.h"
#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {
namespace {

using bem::kLanes;
using bem::PanelRule;
using bem::PanelTask;
using bem::PanelTriangle;
constexpr int kWidth = static_cast<int>(Batch::size);

/// Kelvin's kernels from a panel's points to a quadrature point, in parts: with s = r / r^3 times
/// factorU and the lane's weight,
///   U_ij = r_i s_j + isotropicU [i = j],
///   T_ij = steep r_i s_j + isotropicT [i = j] + (s_i m_j - s_j m_i),  m along the normal.
struct KernelParts {
  Batch r[3], s[3], isotropicU, isotropicT, steep;
};

/// Where a panel's values of one vertex of a triangle go.
struct Blocks {
  double *h, *g;
};

/// How the lanes of a panel integrate a triangle: a 1 in one of the three for each lane. The choice
/// is one of point and triangle alone, so that results do not depend on how points are grouped.
struct LaneChoice {
  alignas(64) double far[kLanes], near[kLanes], closedForm[kLanes];
  bool anyFar = false, anyNear = false, anyClosedForm = false;
  bool agree() const { return anyFar + anyNear + anyClosedForm == 1; }
};

class PanelKernel {
 public:
  explicit PanelKernel(const PanelTask& task)
      : task_(task),
        nu_(task.poissonRatio),
        factorU_(1 / (16 * kPi * (1 - nu_))),
        factorT_(-1 / (8 * kPi * (1 - nu_))) {}

  /// @param mask  kLanes, 1 for the lanes that take part; nullptr for all.
  template <int Triples>
  void addByRule(const PanelTriangle& t, const PanelRule& rule, const double* mask) const {
    constexpr int count = pointCount(Triples);
    double y[count][3];
    placePoints<Triples>(t, rule, y);
    const HatSums<Triples> sums(rule);
    const double shear = (1 - 2 * nu_) * factorT_ / factorU_;
    const double skewNormal[3] = {-shear * t.normal[0], -shear * t.normal[1], -shear * t.normal[2]};
    // Lanes that take no part stand where the kernels are tame.
    const double aside[3] = {t.centroid[0] + 4 * t.radius * t.normal[0],
                             t.centroid[1] + 4 * t.radius * t.normal[1],
                             t.centroid[2] + 4 * t.radius * t.normal[2]};
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      if (mask && !anyOf(mask + lane)) continue;
      Batch px = Batch::load_unaligned(task_.x[0] + lane);
      Batch py = Batch::load_unaligned(task_.x[1] + lane);
      Batch pz = Batch::load_unaligned(task_.x[2] + lane);
      Batch factor(factorU_ * t.area);
      if (mask) {
        const Batch weight = Batch::load_unaligned(mask + lane);
        const auto taken = weight > Batch(0.5);
        px = xsimd::select(taken, px, Batch(aside[0]));
        py = xsimd::select(taken, py, Batch(aside[1]));
        pz = xsimd::select(taken, pz, Batch(aside[2]));
        factor = factor * weight;
      }
      const Batch height = t.normal[0] * (t.vertex[0][0] - px) +
                           t.normal[1] * (t.vertex[0][1] - py) +
                           t.normal[2] * (t.vertex[0][2] - pz);
      KernelParts parts[count];
      for (int q = 0; q < count; ++q)
        evaluate(y[q][0] - px, y[q][1] - py, y[q][2] - pz, height, factor, parts[q]);
      Batch s[3][3];  // [component][hat]
      for (int c = 0; c < 3; ++c) sums([&](int q) { return parts[q].s[c]; }, s[c]);
      Blocks blocks[3];
      for (int k = 0; k < 3; ++k) blocks[k] = blocksOf(t, k, lane);
      addOnDiagonal<Triples, 0>(sums, parts, blocks);
      addOnDiagonal<Triples, 1>(sums, parts, blocks);
      addOnDiagonal<Triples, 2>(sums, parts, blocks);
      addOffDiagonal<Triples, 0, 1>(sums, parts, skewNormal, s, blocks);
      addOffDiagonal<Triples, 0, 2>(sums, parts, skewNormal, s, blocks);
      addOffDiagonal<Triples, 1, 2>(sums, parts, skewNormal, s, blocks);
    }
  }

  void addInClosedForm(const PanelTriangle& t, const bem::OwnTriangle* own,
                       const double* mask) const {
    const double shear = 1 - 2 * nu_;
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      if (mask && !anyOf(mask + lane)) continue;
      const Batch weight = mask ? Batch::load_unaligned(mask + lane) : Batch(1);
      const Batch forU = factorU_ * weight, forT = factorT_ * weight;
      const ClosedFormMoments moments(task_, t, own, lane);
      for (int k = 0; k < 3; ++k) {
        const Moments m = moments.ofHat(k);
        const Batch isotropicU = (3 - 4 * nu_) * (m.one[0] + m.one[3] + m.one[5]);
        const Batch isotropicT = shear * (m.five[0] + m.five[3] + m.five[5]);
        const Blocks blocks = blocksOf(t, k, lane);
        int c = 0;
        for (int i = 0; i < 3; ++i)
          for (int j = i; j < 3; ++j, ++c) {
            const Batch steep = 3.0 * m.five[c];
            if (i == j) {
              accumulate(blocks.g, c, forU * (m.one[c] + isotropicU));
              accumulate(blocks.h, 4 * i, forT * (steep + isotropicT));
            } else {
              const Batch skew = shear * (m.three[j] * t.normal[i] - m.three[i] * t.normal[j]);
              accumulate(blocks.g, c, forU * m.one[c]);
              accumulate(blocks.h, 3 * i + j, forT * (steep + skew));
              accumulate(blocks.h, 3 * j + i, forT * (steep - skew));
            }
          }
      }
    }
  }

 private:
  /// Of a rule of one triple, or of two and the centroid.
  static constexpr int pointCount(int triples) { return triples == 2 ? 7 : 3; }

  template <int Triples>
  static void placePoints(const PanelTriangle& t, const PanelRule& rule, double (*y)[3]) {
    for (int c = 0; c < 3; ++c) {
      for (int triple = 0; triple < Triples; ++triple) {
        // (1 - 2 b) x_k + b (x_l + x_m) = b * (3 centroid) + (1 - 3 b) x_k
        const double b = (1 - rule.near[triple]) / 2;
        for (int k = 0; k < 3; ++k)
          y[3 * triple + k][c] = 3 * b * t.centroid[c] + (1 - 3 * b) * t.vertex[k][c];
      }
      if (Triples == 2) y[6][c] = t.centroid[c];
    }
  }

  /// @param r       from the collocation points to a quadrature point.
  /// @param height  n . r.
  /// @param factor  factorU times area and the lanes' weight.
  void evaluate(const Batch& rx, const Batch& ry, const Batch& rz, const Batch& height,
                const Batch& factor, KernelParts& parts) const {
    const double ratio = factorT_ / factorU_;
    const Batch r2 = xsimd::fma(rx, rx, xsimd::fma(ry, ry, rz * rz));
    const Batch inverse = inverseSquareRoot(r2);
    const Batch inverse2 = inverse * inverse, weighted = factor * inverse;
    const Batch weighted3 = weighted * inverse2, slope = height * inverse2;
    parts.r[0] = rx;
    parts.r[1] = ry;
    parts.r[2] = rz;
    parts.s[0] = rx * weighted3;
    parts.s[1] = ry * weighted3;
    parts.s[2] = rz * weighted3;
    parts.isotropicU = (3 - 4 * nu_) * weighted;
    parts.isotropicT = ((1 - 2 * nu_) * ratio) * (slope * weighted);
    parts.steep = (3 * ratio) * slope;
  }

  /// Weights values at a rule's points with the hat functions. On a triple (a, b, b) the sum over
  /// its points of weight * hat_k * value is weight * (b * (sum of values) + (a - b) * value_k).
  template <int Triples>
  struct HatSums {
    double common[Triples], extra[Triples], centroid;
    explicit HatSums(const PanelRule& rule) : centroid(rule.centroidWeight / 3) {
      for (int i = 0; i < Triples; ++i) {
        const double b = (1 - rule.near[i]) / 2;
        common[i] = rule.weight[i] * b;
        extra[i] = rule.weight[i] * (rule.near[i] - b);
      }
    }
    /// @param valueAt  the value at point q of the rule.
    template <class ValueAt>
    void operator()(const ValueAt& valueAt, Batch* sum) const {
      Batch value[pointCount(Triples)];
      for (int q = 0; q < pointCount(Triples); ++q) value[q] = valueAt(q);
      Batch base = common[0] * (value[0] + value[1] + value[2]);
      if constexpr (Triples == 2) {
        base = xsimd::fma(Batch(common[1]), value[3] + value[4] + value[5], base);
        base = xsimd::fma(Batch(centroid), value[6], base);
      }
      for (int k = 0; k < 3; ++k) {
        sum[k] = xsimd::fma(Batch(extra[0]), value[k], base);
        if constexpr (Triples == 2) sum[k] = xsimd::fma(Batch(extra[1]), value[3 + k], sum[k]);
      }
    }
  };

  template <int Triples, int I>
  static void addOnDiagonal(const HatSums<Triples>& sums, const KernelParts* parts,
                            const Blocks* blocks) {
    constexpr int packed[3] = {0, 3, 5};
    Batch u[3], t[3];
    sums([&](int q) { return xsimd::fma(parts[q].r[I], parts[q].s[I], parts[q].isotropicU); }, u);
    sums(
        [&](int q) {
          return xsimd::fma(parts[q].steep, parts[q].r[I] * parts[q].s[I], parts[q].isotropicT);
        },
        t);
    for (int k = 0; k < 3; ++k) {
      accumulate(blocks[k].g, packed[I], u[k]);
      accumulate(blocks[k].h, 4 * I, t[k]);
    }
  }

  template <int Triples, int I, int J>
  static void addOffDiagonal(const HatSums<Triples>& sums, const KernelParts* parts,
                             const double* skewNormal, const Batch (*s)[3], const Blocks* blocks) {
    constexpr int packed = I == 0 ? J : 4;
    Batch u[3], t[3];
    sums([&](int q) { return parts[q].r[I] * parts[q].s[J]; }, u);
    sums([&](int q) { return parts[q].steep * (parts[q].r[I] * parts[q].s[J]); }, t);
    for (int k = 0; k < 3; ++k) {
      const Batch skew = xsimd::fms(s[I][k], Batch(skewNormal[J]), s[J][k] * skewNormal[I]);
      accumulate(blocks[k].g, packed, u[k]);
      accumulate(blocks[k].h, 3 * I + J, t[k] + skew);
      accumulate(blocks[k].h, 3 * J + I, t[k] - skew);
    }
  }

  Blocks blocksOf(const PanelTriangle& t, int k, int lane) const {
    return {task_.h + 9 * kLanes * static_cast<long>(t.vertexIndex[k]) + lane,
            task_.g + 6 * kLanes * static_cast<long>(t.tractionNode[k]) + lane};
  }
  static bool anyOf(const double* mask) {
    double sum = 0;
    for (int i = 0; i < kWidth; ++i) sum += mask[i];
    return sum > 0;
  }

  static void accumulate(double* block, int component, const Batch& value) {
    double* target = block + component * kLanes;
    (Batch::load_unaligned(target) + value).store_unaligned(target);
  }

  const PanelTask& task_;
  double nu_, factorU_, factorT_;
};

/// @param near2, far2  squares of the rules' smallest distances, in triangle radii.
LaneChoice chooseRules(const PanelTask& task, const PanelTriangle& t, double near2, double far2) {
  LaneChoice choice;
  const Batch near(near2 * t.radius * t.radius), far(far2 * t.radius * t.radius);
  const Batch one(1), zero(0);
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    const Batch dx = Batch::load_unaligned(task.x[0] + lane) - t.centroid[0];
    const Batch dy = Batch::load_unaligned(task.x[1] + lane) - t.centroid[1];
    const Batch dz = Batch::load_unaligned(task.x[2] + lane) - t.centroid[2];
    const Batch distance2 = xsimd::fma(dx, dx, xsimd::fma(dy, dy, dz * dz));
    const auto isFar = distance2 >= far, isClose = distance2 < near;
    xsimd::select(isFar, one, zero).store_unaligned(choice.far + lane);
    xsimd::select(isClose, one, zero).store_unaligned(choice.closedForm + lane);
    xsimd::select(isFar || isClose, zero, one).store_unaligned(choice.near + lane);
    choice.anyFar |= xsimd::any(isFar);
    choice.anyClosedForm |= xsimd::any(isClose);
    choice.anyNear |= !xsimd::all(isFar || isClose);
  }
  return choice;
}

}  // namespace

void integratePanel(const PanelTask& task) {
  const PanelKernel kernel(task);
  const double near2 = task.nearRule.smallestDistance * task.nearRule.smallestDistance;
  const double far2 = task.farRule.smallestDistance * task.farRule.smallestDistance;
  for (int f = 0; f < task.triangleCount; ++f) {
    const PanelTriangle& t = task.triangles[f];
    const LaneChoice choice = chooseRules(task, t, near2, far2);
    const bool all = choice.agree();
    if (choice.anyFar) kernel.addByRule<1>(t, task.farRule, all ? nullptr : choice.far);
    if (choice.anyNear) kernel.addByRule<2>(t, task.nearRule, all ? nullptr : choice.near);
    if (choice.anyClosedForm) {
      kernel.addInClosedForm(t, task.ownIndex[f] < 0 ? nullptr : task.own + task.ownIndex[f],
                             all ? nullptr : choice.closedForm);
      if (task.closedFormCount) ++*task.closedFormCount;
    }
  }
}

void averageBlocks(const double* weights, const int* places, long count, int components,
                   double* points, double* equations, double* sums) {
  constexpr int batches = kLanes / kWidth;
  Batch weight[kLanes][batches];
  for (int p = 0; p < kLanes; ++p)
    for (int b = 0; b < batches; ++b)
      weight[p][b] = Batch::load_unaligned(weights + p * kLanes + b * kWidth);
  for (long block = 0; block < count; ++block)
    for (int c = 0; c < components; ++c) {
      double* source = points + (components * block + c) * kLanes;
      double* target = equations + (components * static_cast<long>(places[block]) + c) * kLanes;
      for (int b = 0; b < batches; ++b) {
        Batch even = Batch::load_unaligned(target + b * kWidth), odd(0);
        for (int p = 0; p < kLanes; p += 2) {
          even = xsimd::fma(weight[p][b], Batch(source[p]), even);
          odd = xsimd::fma(weight[p + 1][b], Batch(source[p + 1]), odd);
        }
        (even + odd).store_unaligned(target + b * kWidth);
      }
      for (int b = 0; b < batches; ++b) {
        double* sum = sums + c * kLanes + b * kWidth;
        (Batch::load_unaligned(sum) + Batch::load_unaligned(source + b * kWidth))
            .store_unaligned(sum);
        Batch(0).store_unaligned(source + b * kWidth);
      }
    }
}

void sumBlocks(const double* h, long count, const double* positions, double* sums) {
  for (int row = 0; row < 3; ++row)
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const long start = 3 * row * kLanes + lane;
      Batch sum[4][3];
      for (auto& moment : sum)
        for (Batch& component : moment) component = Batch(0);
      for (long v = 0; v < count; ++v)
        for (int j = 0; j < 3; ++j) {
          const Batch value = Batch::load_unaligned(h + (9 * v + j) * kLanes + start);
          sum[0][j] += value;
          for (int c = 0; c < 3; ++c)
            sum[1 + c][j] = xsimd::fma(value, Batch(positions[3 * v + c]), sum[1 + c][j]);
        }
      for (int m = 0; m < 4; ++m)
        for (int j = 0; j < 3; ++j) sum[m][j].store_unaligned(sums + (9 * m + j) * kLanes + start);
    }
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
