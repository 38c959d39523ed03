// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Rows and columns of the matrices below are padded with zeros to a multiple of this.
constexpr int kInversePadding = 8;

/// The size with its padding.
constexpr int padded(int size) {
  return (size + kInversePadding - 1) / kInversePadding * kInversePadding;
}

/// The two memory passes of an update of an explicit inverse by `count` <= 3 rows and columns.
/// Matrices are column-major with the given stride (a multiple of kInversePadding).

/// x = inverse * b,  y = inverse^T * c, reading the inverse once.
/// @param inverse    size by size.
/// @param b, c       size by count, padded with zeros.
/// @param x, y       size by count, overwritten.
void multiplyBothSides(const double* inverse, int size, int stride, const double* b,
                       const double* c, int count, double* x, double* y);

/// y = inverse^T * c alone, three columns.
/// @param c  size by 3, padded with zeros.
/// @param y  size by 3, overwritten.
void multiplyTransposed(const double* inverse, int size, int stride, const double* c, double* y);

/// inverse += x * y^T, reading and writing the inverse once.
void addOuterProduct(double* inverse, int size, int stride, const double* x, const double* y,
                     int count);

}  // namespace palpate
