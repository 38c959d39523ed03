// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/panel_integration.h"

#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void integratePanel(const bem::PanelTask&))

PALPATE_DECLARE_KERNEL(void averageBlocks(const double*, const int*, long, int, double*, double*,
                                          double*))

PALPATE_DECLARE_KERNEL(void sumBlocks(const double*, long, const double*, double*))

void bem::averageBlocks(const double* weights, const int* places, long count, int components,
                        double* points, double* equations, double* sums) {
  PALPATE_DISPATCH(averageBlocks(weights, places, count, components, points, equations, sums))
}

void bem::integratePanel(const PanelTask& task) {
  PALPATE_DISPATCH(integratePanel(task))
}

void bem::sumBlocks(const double* h, long count, const double* positions, double* sums) {
  PALPATE_DISPATCH(sumBlocks(h, count, positions, sums))
}

}  // namespace palpate
