// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/inverse_updates.h"

#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void multiplyBothSides(const double*, int, int, const double*, const double*,
                                              int, double*, double*))
PALPATE_DECLARE_KERNEL(void multiplyTransposed(const double*, int, int, const double*, double*))
PALPATE_DECLARE_KERNEL(void addOuterProduct(double*, int, int, const double*, const double*, int))

void multiplyBothSides(const double* inverse, int size, int stride, const double* b,
                       const double* c, int count, double* x, double* y) {
  PALPATE_DISPATCH(multiplyBothSides(inverse, size, stride, b, c, count, x, y))
}

void multiplyTransposed(const double* inverse, int size, int stride, const double* c, double* y) {
  PALPATE_DISPATCH(multiplyTransposed(inverse, size, stride, c, y))
}
void addOuterProduct(double* inverse, int size, int stride, const double* x, const double* y,
                     int count) {
  PALPATE_DISPATCH(addOuterProduct(inverse, size, stride, x, y, count))
}

}  // namespace palpate
