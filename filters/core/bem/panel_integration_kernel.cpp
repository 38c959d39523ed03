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

/// Adds node k's contribution, from the moments of its hat function, to the blocks of H and G.
struct BlockWriter {
  double nu, displacementFactor, tractionFactor;

  explicit BlockWriter(double poissonRatio)
      : nu(poissonRatio),
        displacementFactor(1 / (16 * kPi * (1 - poissonRatio))),
        tractionFactor(-1 / (8 * kPi * (1 - poissonRatio))) {}

  void add(const Moments& m, const double* normal, double area, double* h, double* g) const {
    const double cu = displacementFactor * area, ct = tractionFactor * area;
    const Batch isotropicU = ((3 - 4 * nu) * cu) * (m.one[0] + m.one[3] + m.one[5]);
    accumulate(g, 0, xsimd::fma(Batch(cu), m.one[0], isotropicU));
    accumulate(g, 1, cu * m.one[1]);
    accumulate(g, 2, cu * m.one[2]);
    accumulate(g, 3, xsimd::fma(Batch(cu), m.one[3], isotropicU));
    accumulate(g, 4, cu * m.one[4]);
    accumulate(g, 5, xsimd::fma(Batch(cu), m.one[5], isotropicU));

    const double shear = (1 - 2 * nu) * ct;
    const Batch isotropicT = shear * (m.five[0] + m.five[3] + m.five[5]);
    const double c3 = 3 * ct;
    // -(r_i n_j - r_j n_i), upper triangle; `shear` carries the sign of the leading minus.
    const Batch xy = -shear * (m.three[0] * normal[1] - m.three[1] * normal[0]);
    const Batch xz = -shear * (m.three[0] * normal[2] - m.three[2] * normal[0]);
    const Batch yz = -shear * (m.three[1] * normal[2] - m.three[2] * normal[1]);
    accumulate(h, 0, xsimd::fma(Batch(c3), m.five[0], isotropicT));
    accumulate(h, 1, xsimd::fma(Batch(c3), m.five[1], xy));
    accumulate(h, 2, xsimd::fma(Batch(c3), m.five[2], xz));
    accumulate(h, 3, xsimd::fms(Batch(c3), m.five[1], xy));
    accumulate(h, 4, xsimd::fma(Batch(c3), m.five[3], isotropicT));
    accumulate(h, 5, xsimd::fma(Batch(c3), m.five[4], yz));
    accumulate(h, 6, xsimd::fms(Batch(c3), m.five[2], xz));
    accumulate(h, 7, xsimd::fms(Batch(c3), m.five[4], yz));
    accumulate(h, 8, xsimd::fma(Batch(c3), m.five[5], isotropicT));
  }

 private:
  static void accumulate(double* block, int component, const Batch& value) {
    double* target = block + component * kLanes;
    (Batch::load_unaligned(target) + value).store_unaligned(target);
  }
};

/// The fifteen kernel values at one quadrature point: r r/r^3, r/r^3, r r/r^5.
struct KernelValues {
  Batch value[15];
};

template <int Count>
void addByRule(const PanelTask& task, const PanelTriangle& t, const PanelRule& rule,
               const BlockWriter& writer) {
  double y[Count][3];
  for (int q = 0; q < Count; ++q)
    for (int c = 0; c < 3; ++c)
      y[q][c] = rule.barycentric[q][0] * t.vertex[0][c] + rule.barycentric[q][1] * t.vertex[1][c] +
                rule.barycentric[q][2] * t.vertex[2][c];

  for (int lane = 0; lane < kLanes; lane += kWidth) {
    const Batch px = Batch::load_unaligned(task.x[0] + lane);
    const Batch py = Batch::load_unaligned(task.x[1] + lane);
    const Batch pz = Batch::load_unaligned(task.x[2] + lane);
    KernelValues values[Count];
    for (int q = 0; q < Count; ++q) {
      const Batch rx = y[q][0] - px, ry = y[q][1] - py, rz = y[q][2] - pz;
      const Batch r2 = xsimd::fma(rx, rx, xsimd::fma(ry, ry, rz * rz));
      const Batch inverse = inverseSquareRoot(r2);
      const Batch inverse2 = inverse * inverse, inverse3 = inverse2 * inverse;
      Batch* v = values[q].value;
      v[6] = rx * inverse3;
      v[7] = ry * inverse3;
      v[8] = rz * inverse3;
      v[0] = rx * v[6];
      v[1] = rx * v[7];
      v[2] = rx * v[8];
      v[3] = ry * v[7];
      v[4] = ry * v[8];
      v[5] = rz * v[8];
      for (int c = 0; c < 6; ++c) v[9 + c] = v[c] * inverse2;
    }
    const Batch height = t.normal[0] * (t.vertex[0][0] - px) + t.normal[1] * (t.vertex[0][1] - py) +
                         t.normal[2] * (t.vertex[0][2] - pz);
    for (int k = 0; k < 3; ++k) {
      Batch sum[15];
      for (int c = 0; c < 15; ++c) {
        sum[c] = rule.weightedHat[k][0] * values[0].value[c];
        for (int q = 1; q < Count; ++q)
          sum[c] = xsimd::fma(Batch(rule.weightedHat[k][q]), values[q].value[c], sum[c]);
      }
      Moments m;
      for (int c = 0; c < 6; ++c) m.one[c] = sum[c];
      for (int c = 0; c < 3; ++c) m.three[c] = sum[6 + c];
      for (int c = 0; c < 6; ++c) m.five[c] = height * sum[9 + c];
      writer.add(m, t.normal, t.area, task.h + 9 * kLanes * t.vertexIndex[k] + lane,
                 task.g + 6 * kLanes * t.tractionNode[k] + lane);
    }
  }
}

void addInClosedForm(const PanelTask& task, const PanelTriangle& t, const bem::OwnTriangle* own,
                     const BlockWriter& writer) {
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    const ClosedFormMoments moments(task, t, own, lane);
    for (int k = 0; k < 3; ++k) {
      const Moments m = moments.ofHat(k);
      writer.add(m, t.normal, 1, task.h + 9 * kLanes * t.vertexIndex[k] + lane,
                 task.g + 6 * kLanes * t.tractionNode[k] + lane);
    }
  }
}

/// Square of the distance from a triangle's centroid to the nearest point of the panel.
double nearestSquared(const PanelTask& task, const PanelTriangle& t) {
  Batch nearest(1e300);
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    const Batch dx = Batch::load_unaligned(task.x[0] + lane) - t.centroid[0];
    const Batch dy = Batch::load_unaligned(task.x[1] + lane) - t.centroid[1];
    const Batch dz = Batch::load_unaligned(task.x[2] + lane) - t.centroid[2];
    nearest = xsimd::min(nearest, xsimd::fma(dx, dx, xsimd::fma(dy, dy, dz * dz)));
  }
  double values[kWidth];
  nearest.store_unaligned(values);
  double smallest = values[0];
  for (int i = 1; i < kWidth; ++i) smallest = values[i] < smallest ? values[i] : smallest;
  return smallest;
}

}  // namespace

void integratePanel(const PanelTask& task) {
  const BlockWriter writer(task.poissonRatio);
  for (int f = 0; f < task.triangleCount; ++f) {
    const PanelTriangle& t = task.triangles[f];
    const double distance2 = nearestSquared(task, t);
    const auto isAccurate = [&](const PanelRule& rule) {
      const double wanted = rule.smallestDistance * t.radius;
      return distance2 >= wanted * wanted;
    };
    if (isAccurate(task.rules[2])) {
      addByRule<3>(task, t, task.rules[2], writer);
    } else if (isAccurate(task.rules[1])) {
      addByRule<7>(task, t, task.rules[1], writer);
    } else if (isAccurate(task.rules[0])) {
      addByRule<16>(task, t, task.rules[0], writer);
    } else {
      addInClosedForm(task, t, task.ownIndex[f] < 0 ? nullptr : task.own + task.ownIndex[f],
                      writer);
      ++*task.closedFormCount;
    }
  }
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
