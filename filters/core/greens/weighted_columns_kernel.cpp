// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled once per instruction set; see weighted_columns.h.

#include "greens/weighted_columns.h"
#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {
namespace {

constexpr int kWidth = static_cast<int>(Batch::size);
constexpr int kUnroll = 2;           ///< independent sums, to hide the latency of a multiply-add
constexpr int kPrefetchBytes = 512;  ///< from the second-level cache to the first

/// Rows from one on, in whole steps up to an end. @return the first that is left.
template <bool Prefetches, int Count, class Scalar>
int addRows(const Scalar* const* columns, const Batch (&weight)[Count], int i, int end,
            double* out) {
  constexpr int step = kUnroll * kWidth;
  for (; i + step <= end; i += step) {
    Batch sum[kUnroll];
    for (int u = 0; u < kUnroll; ++u) sum[u] = Batch::load_unaligned(out + i + u * kWidth);
    for (int c = 0; c < Count; ++c) {
      const Scalar* column = columns[c] + i;
      for (unsigned byte = 0; Prefetches && byte < step * sizeof(Scalar); byte += 64)
        prefetch(reinterpret_cast<const char*>(column) + kPrefetchBytes + byte);
      for (int u = 0; u < kUnroll; ++u)
        sum[u] = xsimd::fma(weight[c], loadAsDouble(column + u * kWidth), sum[u]);
    }
    for (int u = 0; u < kUnroll; ++u) sum[u].store_unaligned(out + i + u * kWidth);
  }
  return i;
}

template <int Count, class Scalar>
void addColumns(const Scalar* const* columns, const double* weights, int rowCount, double* out) {
  Batch weight[Count];
  for (int c = 0; c < Count; ++c) weight[c] = Batch(weights[c]);
  // What lies beyond the rows is not asked for: of short columns that would be a good part.
  const int last = rowCount - kPrefetchBytes / static_cast<int>(sizeof(Scalar));
  int i = addRows<true>(columns, weight, 0, last, out);
  i = addRows<false>(columns, weight, i, rowCount, out);
  for (; i < rowCount; ++i)
    for (int c = 0; c < Count; ++c) out[i] += weights[c] * columns[c][i];
}

/// As many columns at a time as there are, in the steps that nodes of three columns make.
template <class Scalar>
void addInGroups(const Scalar* const* columns, const double* weights, int count, int rowCount,
                 double* out) {
  int c = 0;
  for (; c + 12 <= count; c += 12) addColumns<12>(columns + c, weights + c, rowCount, out);
  for (; c + 6 <= count; c += 6) addColumns<6>(columns + c, weights + c, rowCount, out);
  for (; c + 3 <= count; c += 3) addColumns<3>(columns + c, weights + c, rowCount, out);
  for (; c < count; ++c) addColumns<1>(columns + c, weights + c, rowCount, out);
}

}  // namespace

void addWeightedColumns(const double* const* columns, const double* weights, int count,
                        int rowCount, double* out) {
  addInGroups(columns, weights, count, rowCount, out);
}
void addWeightedColumns(const float* const* columns, const double* weights, int count, int rowCount,
                        double* out) {
  addInGroups(columns, weights, count, rowCount, out);
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
