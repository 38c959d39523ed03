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

/// Kelvin's kernels up to their constant factors: U = factorU * u, T = factorT * (t + skew).
struct KernelValues {
  Batch u[6];     ///< xx, xy, xz, yy, yz, zz
  Batch t[6];     ///< symmetric part, likewise
  Batch skew[3];  ///< xy, xz, yz
};

/// Where a panel's values of one vertex of a triangle go, and which lanes take part.
struct Blocks {
  double *h, *g;
  Batch mask;  ///< 1 or 0
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
    constexpr bool hasCentroid = Triples == 2;
    constexpr int count = 3 * Triples + hasCentroid;
    double y[count][3];
    placePoints<Triples>(t, rule, y);
    const double skewNormal[3] = {-(1 - 2 * nu_) * t.normal[0], -(1 - 2 * nu_) * t.normal[1],
                                  -(1 - 2 * nu_) * t.normal[2]};
    // Lanes that take no part stand where the kernels are tame.
    const double aside[3] = {t.centroid[0] + 4 * t.radius * t.normal[0],
                             t.centroid[1] + 4 * t.radius * t.normal[1],
                             t.centroid[2] + 4 * t.radius * t.normal[2]};
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      if (mask && !anyOf(mask + lane)) continue;
      Batch px = Batch::load_unaligned(task_.x[0] + lane);
      Batch py = Batch::load_unaligned(task_.x[1] + lane);
      Batch pz = Batch::load_unaligned(task_.x[2] + lane);
      if (mask) {
        const auto taken = Batch::load_unaligned(mask + lane) > Batch(0.5);
        px = xsimd::select(taken, px, Batch(aside[0]));
        py = xsimd::select(taken, py, Batch(aside[1]));
        pz = xsimd::select(taken, pz, Batch(aside[2]));
      }
      const Batch height = t.normal[0] * (t.vertex[0][0] - px) +
                           t.normal[1] * (t.vertex[0][1] - py) +
                           t.normal[2] * (t.vertex[0][2] - pz);
      KernelValues values[count];
      for (int q = 0; q < count; ++q)
        evaluate(y[q][0] - px, y[q][1] - py, y[q][2] - pz, height, skewNormal, values[q]);
      Blocks blocks[3];
      for (int k = 0; k < 3; ++k) blocks[k] = blocksOf(t, k, lane, mask);
      addSums<Triples>(rule, values, t.area, blocks);
    }
  }

  void addInClosedForm(const PanelTriangle& t, const bem::OwnTriangle* own,
                       const double* mask) const {
    const double shear = 1 - 2 * nu_;
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      if (mask && !anyOf(mask + lane)) continue;
      const ClosedFormMoments moments(task_, t, own, lane);
      for (int k = 0; k < 3; ++k) {
        const Moments m = moments.ofHat(k);
        KernelValues v;
        const Batch isotropicU = (3 - 4 * nu_) * (m.one[0] + m.one[3] + m.one[5]);
        const Batch isotropicT = shear * (m.five[0] + m.five[3] + m.five[5]);
        for (int c = 0; c < 6; ++c) {
          const bool diagonal = c == 0 || c == 3 || c == 5;
          v.u[c] = diagonal ? m.one[c] + isotropicU : m.one[c];
          v.t[c] = diagonal ? xsimd::fma(Batch(3), m.five[c], isotropicT) : 3.0 * m.five[c];
        }
        v.skew[0] = -shear * (m.three[0] * t.normal[1] - m.three[1] * t.normal[0]);
        v.skew[1] = -shear * (m.three[0] * t.normal[2] - m.three[2] * t.normal[0]);
        v.skew[2] = -shear * (m.three[1] * t.normal[2] - m.three[2] * t.normal[1]);
        const Blocks blocks = blocksOf(t, k, lane, mask);
        for (int c = 0; c < 6; ++c) addU(blocks, c, 1, v.u[c]);
        for (int c = 0; c < 6; ++c) addT(blocks, c, 1, v.t[c], v.skew);
      }
    }
  }

 private:
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
  void evaluate(const Batch& rx, const Batch& ry, const Batch& rz, const Batch& height,
                const double* skewNormal, KernelValues& v) const {
    const Batch r2 = xsimd::fma(rx, rx, xsimd::fma(ry, ry, rz * rz));
    const Batch inverse = inverseSquareRoot(r2);
    const Batch inverse2 = inverse * inverse, inverse3 = inverse2 * inverse;
    const Batch sx = rx * inverse3, sy = ry * inverse3, sz = rz * inverse3;
    const Batch m[6] = {rx * sx, rx * sy, rx * sz, ry * sy, ry * sz, rz * sz};
    const Batch isotropicU = (3 - 4 * nu_) * inverse;
    v.u[0] = m[0] + isotropicU;
    v.u[1] = m[1];
    v.u[2] = m[2];
    v.u[3] = m[3] + isotropicU;
    v.u[4] = m[4];
    v.u[5] = m[5] + isotropicU;
    const Batch steep = (3.0 * height) * inverse2;
    const Batch isotropicT = ((1 - 2 * nu_) * height) * inverse3;
    v.t[0] = xsimd::fma(steep, m[0], isotropicT);
    v.t[1] = steep * m[1];
    v.t[2] = steep * m[2];
    v.t[3] = xsimd::fma(steep, m[3], isotropicT);
    v.t[4] = steep * m[4];
    v.t[5] = xsimd::fma(steep, m[5], isotropicT);
    v.skew[0] = xsimd::fms(sx, Batch(skewNormal[1]), sy * skewNormal[0]);
    v.skew[1] = xsimd::fms(sx, Batch(skewNormal[2]), sz * skewNormal[0]);
    v.skew[2] = xsimd::fms(sy, Batch(skewNormal[2]), sz * skewNormal[1]);
  }

  /// Weights the values with the hat functions. On a triple (a, b, b) the sum over its points of
  /// weight * hat_k * value is weight * (b * (sum of values) + (a - b) * value_k).
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
    template <class Get>
    void operator()(const KernelValues* values, const Get& get, Batch* sum) const {
      Batch base = common[0] * (get(values[0]) + get(values[1]) + get(values[2]));
      if constexpr (Triples == 2) {
        base = xsimd::fma(Batch(common[1]), get(values[3]) + get(values[4]) + get(values[5]), base);
        base = xsimd::fma(Batch(centroid), get(values[6]), base);
      }
      for (int k = 0; k < 3; ++k) {
        sum[k] = xsimd::fma(Batch(extra[0]), get(values[k]), base);
        if constexpr (Triples == 2)
          sum[k] = xsimd::fma(Batch(extra[1]), get(values[3 + k]), sum[k]);
      }
    }
  };

  template <int Triples>
  void addSums(const PanelRule& rule, const KernelValues* values, double area,
               const Blocks* blocks) const {
    const HatSums<Triples> sums(rule);
    Batch sum[3], skew[3][3];
    for (int c = 0; c < 6; ++c) {
      sums(
          values, [&](const KernelValues& v) { return v.u[c]; }, sum);
      for (int k = 0; k < 3; ++k) addU(blocks[k], c, area, sum[k]);
    }
    for (int c = 0; c < 3; ++c) {
      sums(
          values, [&](const KernelValues& v) { return v.skew[c]; }, sum);
      for (int k = 0; k < 3; ++k) skew[k][c] = sum[k];
    }
    for (int c = 0; c < 6; ++c) {
      sums(
          values, [&](const KernelValues& v) { return v.t[c]; }, sum);
      for (int k = 0; k < 3; ++k) addT(blocks[k], c, area, sum[k], skew[k]);
    }
  }

  Blocks blocksOf(const PanelTriangle& t, int k, int lane, const double* mask) const {
    return {task_.h + 9 * kLanes * static_cast<long>(t.vertexIndex[k]) + lane,
            task_.g + 6 * kLanes * static_cast<long>(t.tractionNode[k]) + lane,
            mask ? Batch::load_unaligned(mask + lane) : Batch(1)};
  }
  static bool anyOf(const double* mask) {
    double sum = 0;
    for (int i = 0; i < kWidth; ++i) sum += mask[i];
    return sum > 0;
  }

  static void accumulate(double* block, int component, const Batch& factor, const Batch& value) {
    double* target = block + component * kLanes;
    xsimd::fma(factor, value, Batch::load_unaligned(target)).store_unaligned(target);
  }
  void addU(const Blocks& blocks, int c, double area, const Batch& value) const {
    accumulate(blocks.g, c, factorU_ * area * blocks.mask, value);
  }
  /// Component c of the symmetric part, with the skew part where it is off the diagonal.
  void addT(const Blocks& blocks, int c, double area, const Batch& symmetric,
            const Batch* skew) const {
    static constexpr int upper[6] = {0, 1, 2, 4, 5, 8}, lower[6] = {0, 3, 6, 4, 7, 8};
    static constexpr int skewOf[6] = {-1, 0, 1, -1, 2, -1};
    const Batch factor = factorT_ * area * blocks.mask;
    if (skewOf[c] < 0) {
      accumulate(blocks.h, upper[c], factor, symmetric);
    } else {
      accumulate(blocks.h, upper[c], factor, symmetric + skew[skewOf[c]]);
      accumulate(blocks.h, lower[c], factor, symmetric - skew[skewOf[c]]);
    }
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

void averagePoints(const double* weights, long count, bool first, double* points,
                   double* equations) {
  constexpr int batches = kLanes / kWidth;
  Batch weight[kLanes][batches];
  for (int p = 0; p < kLanes; ++p)
    for (int b = 0; b < batches; ++b)
      weight[p][b] = Batch::load_unaligned(weights + p * kLanes + b * kWidth);
  for (long c = 0; c < count; ++c) {
    double* source = points + c * kLanes;
    double* target = equations + c * kLanes;
    for (int b = 0; b < batches; ++b) {
      Batch sum = first ? Batch(0) : Batch::load_unaligned(target + b * kWidth);
      for (int p = 0; p < kLanes; ++p) sum = xsimd::fma(weight[p][b], Batch(source[p]), sum);
      sum.store_unaligned(target + b * kWidth);
    }
    for (int b = 0; b < batches; ++b) Batch(0).store_unaligned(source + b * kWidth);
  }
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
