// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled once per instruction set; see inverse_updates.h.

#include "contact/inverse_updates.h"
#include "simd/simd.h"

namespace palpate::PALPATE_SIMD_NAMESPACE {
namespace {

constexpr int kWidth = static_cast<int>(Batch::size);

/// Group columns of the inverse share one pass over x and c.
template <int Group, int Count>
void multiplyColumns(const double* columns, int rows, int stride, const double* b, const double* c,
                     double* x, double* y) {
  Batch weight[Group][Count], sum[Group][Count];
  for (int g = 0; g < Group; ++g)
    for (int k = 0; k < Count; ++k) {
      weight[g][k] = Batch(b[k * stride + g]);
      sum[g][k] = Batch(0);
    }
  for (int i = 0; i < rows; i += kWidth) {
    Batch entry[Group];
    for (int g = 0; g < Group; ++g) entry[g] = Batch::load_unaligned(columns + g * stride + i);
    for (int k = 0; k < Count; ++k) {
      const Batch left = Batch::load_unaligned(c + k * stride + i);
      Batch result = Batch::load_unaligned(x + k * stride + i);
      for (int g = 0; g < Group; ++g) {
        result = xsimd::fma(entry[g], weight[g][k], result);
        sum[g][k] = xsimd::fma(entry[g], left, sum[g][k]);
      }
      result.store_unaligned(x + k * stride + i);
    }
  }
  for (int g = 0; g < Group; ++g)
    for (int k = 0; k < Count; ++k) y[k * stride + g] = xsimd::hadd(sum[g][k]);
}

/// The second of these products alone.
template <int Group, int Count>
void projectOnColumns(const double* columns, int rows, int stride, const double* c, double* y) {
  Batch sum[Group][Count];
  for (int g = 0; g < Group; ++g)
    for (int k = 0; k < Count; ++k) sum[g][k] = Batch(0);
  for (int i = 0; i < rows; i += kWidth) {
    Batch entry[Group];
    for (int g = 0; g < Group; ++g) entry[g] = Batch::load_unaligned(columns + g * stride + i);
    for (int k = 0; k < Count; ++k) {
      const Batch left = Batch::load_unaligned(c + k * stride + i);
      for (int g = 0; g < Group; ++g) sum[g][k] = xsimd::fma(entry[g], left, sum[g][k]);
    }
  }
  for (int g = 0; g < Group; ++g)
    for (int k = 0; k < Count; ++k) y[k * stride + g] = xsimd::hadd(sum[g][k]);
}

template <int Group, int Count>
void addToColumns(double* columns, int rows, int stride, const double* x, const double* y) {
  Batch weight[Group][Count];
  for (int g = 0; g < Group; ++g)
    for (int k = 0; k < Count; ++k) weight[g][k] = Batch(y[k * stride + g]);
  for (int i = 0; i < rows; i += kWidth) {
    Batch left[Count];
    for (int k = 0; k < Count; ++k) left[k] = Batch::load_unaligned(x + k * stride + i);
    for (int g = 0; g < Group; ++g) {
      Batch entry = Batch::load_unaligned(columns + g * stride + i);
      for (int k = 0; k < Count; ++k) entry = xsimd::fma(left[k], weight[g][k], entry);
      entry.store_unaligned(columns + g * stride + i);
    }
  }
}

int paddedRows(int size) {
  return (size + kInversePadding - 1) / kInversePadding * kInversePadding;
}

template <int Count>
void multiply(const double* inverse, int size, int stride, const double* b, const double* c,
              double* x, double* y) {
  const int rows = paddedRows(size);
  for (int k = 0; k < Count; ++k)
    for (int i = 0; i < rows; ++i) x[k * stride + i] = 0;
  int j = 0;
  for (; j + 4 <= size; j += 4)
    multiplyColumns<4, Count>(inverse + j * long(stride), rows, stride, b + j, c, x, y + j);
  for (; j < size; ++j)
    multiplyColumns<1, Count>(inverse + j * long(stride), rows, stride, b + j, c, x, y + j);
}

template <int Count>
void add(double* inverse, int size, int stride, const double* x, const double* y) {
  const int rows = paddedRows(size);
  int j = 0;
  for (; j + 4 <= size; j += 4)
    addToColumns<4, Count>(inverse + j * long(stride), rows, stride, x, y + j);
  for (; j < size; ++j) addToColumns<1, Count>(inverse + j * long(stride), rows, stride, x, y + j);
}

}  // namespace

void multiplyBothSides(const double* inverse, int size, int stride, const double* b,
                       const double* c, int count, double* x, double* y) {
  switch (count) {
    case 3:
      return multiply<3>(inverse, size, stride, b, c, x, y);
    case 2:
      return multiply<2>(inverse, size, stride, b, c, x, y);
    case 1:
      return multiply<1>(inverse, size, stride, b, c, x, y);
  }
}

void multiplyTransposed(const double* inverse, int size, int stride, const double* c, double* y) {
  const int rows = paddedRows(size);
  int j = 0;
  for (; j + 4 <= size; j += 4)
    projectOnColumns<4, 3>(inverse + j * long(stride), rows, stride, c, y + j);
  for (; j < size; ++j) projectOnColumns<1, 3>(inverse + j * long(stride), rows, stride, c, y + j);
}

void addOuterProduct(double* inverse, int size, int stride, const double* x, const double* y,
                     int count) {
  switch (count) {
    case 3:
      return add<3>(inverse, size, stride, x, y);
    case 2:
      return add<2>(inverse, size, stride, x, y);
    case 1:
      return add<1>(inverse, size, stride, x, y);
  }
}

}  // namespace palpate::PALPATE_SIMD_NAMESPACE
