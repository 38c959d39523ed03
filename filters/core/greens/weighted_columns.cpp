// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/weighted_columns.h"

#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void addWeightedColumns(const double* const*, const double*, int, int,
                                               double*))
PALPATE_DECLARE_KERNEL(void addWeightedColumns(const float* const*, const double*, int, int,
                                               double*))

void addWeightedColumns(const double* const* columns, const double* weights, int count,
                        int rowCount, double* out) {
  PALPATE_DISPATCH(addWeightedColumns(columns, weights, count, rowCount, out))
}
void addWeightedColumns(const float* const* columns, const double* weights, int count, int rowCount,
                        double* out) {
  PALPATE_DISPATCH(addWeightedColumns(columns, weights, count, rowCount, out))
}

}  // namespace palpate
