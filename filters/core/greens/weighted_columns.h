// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Columns that addWeightedColumns streams at a time: enough to hide the sum's own traffic, few
/// enough for the prefetchers.
constexpr int kColumnGroup = 12;

/// out[i] += sum over c of weights[c] * columns[c][i], the deformation sum of [JP01] table 3.
/// @param columns  count pointers to rowCount values, best kColumnGroup of them.
/// @param out      rowCount doubles.
void addWeightedColumns(const double* const* columns, const double* weights, int count,
                        int rowCount, double* out);
void addWeightedColumns(const float* const* columns, const double* weights, int count, int rowCount,
                        double* out);

}  // namespace palpate
