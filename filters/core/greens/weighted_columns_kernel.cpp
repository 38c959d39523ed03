// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled once per instruction set; see weighted_columns.h.

#include "greens/weighted_columns.h"
#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {
namespace {

constexpr int kWidth = static_cast<int>(Batch::size);

template <int Count, class Scalar>
void addColumns(const Scalar* const* columns, const double* weights, int rowCount, double* out) {
  Batch weight[Count];
  for (int c = 0; c < Count; ++c) weight[c] = Batch(weights[c]);
  int i = 0;
  for (; i + kWidth <= rowCount; i += kWidth) {
    Batch sum = Batch::load_unaligned(out + i);
    for (int c = 0; c < Count; ++c) sum = xsimd::fma(weight[c], loadAsDouble(columns[c] + i), sum);
    sum.store_unaligned(out + i);
  }
  for (; i < rowCount; ++i)
    for (int c = 0; c < Count; ++c) out[i] += weights[c] * columns[c][i];
}

template <class Scalar>
void dispatchCount(const Scalar* const* columns, const double* weights, int count, int rowCount,
                   double* out) {
  switch (count) {
    case 6:
      return addColumns<6>(columns, weights, rowCount, out);
    case 5:
      return addColumns<5>(columns, weights, rowCount, out);
    case 4:
      return addColumns<4>(columns, weights, rowCount, out);
    case 3:
      return addColumns<3>(columns, weights, rowCount, out);
    case 2:
      return addColumns<2>(columns, weights, rowCount, out);
    case 1:
      return addColumns<1>(columns, weights, rowCount, out);
  }
}

}  // namespace

void addWeightedColumns(const double* const* columns, const double* weights, int count,
                        int rowCount, double* out) {
  dispatchCount(columns, weights, count, rowCount, out);
}
void addWeightedColumns(const float* const* columns, const double* weights, int count, int rowCount,
                        double* out) {
  dispatchCount(columns, weights, count, rowCount, out);
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
