// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/panel_integration.h"

#include "simd/dispatch.h"

namespace palpate {

PALPATE_DECLARE_KERNEL(void integratePanel(const bem::PanelTask&))

void bem::integratePanel(const PanelTask& task) {
  PALPATE_DISPATCH(integratePanel(task))
}

}  // namespace palpate
