// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/panel_integration.h"

#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void integratePanel(const bem::PanelTask&))

PALPATE_DECLARE_KERNEL(void averagePoints(const double*, long, bool, double*, double*))

void bem::averagePoints(const double* weights, long count, bool first, double* points,
                        double* equations) {
  PALPATE_DISPATCH(averagePoints(weights, count, first, points, equations))
}

void bem::integratePanel(const PanelTask& task) {
  PALPATE_DISPATCH(integratePanel(task))
}

}  // namespace palpate
