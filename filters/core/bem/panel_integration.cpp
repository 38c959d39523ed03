// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/panel_integration.h"

#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void integratePanel(const bem::PanelTask&))

PALPATE_DECLARE_KERNEL(void averagePoints(const bem::PointShare*, int, long, double*))

void bem::averagePoints(const PointShare* shares, int shareCount, long rows, double* equations) {
  PALPATE_DISPATCH(averagePoints(shares, shareCount, rows, equations))
}

void bem::integratePanel(const PanelTask& task) {
  PALPATE_DISPATCH(integratePanel(task))
}

}  // namespace palpate
