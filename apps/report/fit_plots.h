// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "report/measured_data.h"

/// Plots of how a model fits a table, as inline SVG. Of very many values a part is shown, and
/// said to be.
namespace palpate::app {

/// Predicted over measured components.
std::string predictionPlot(const MeasuredData& data);

/// Residuals over their standard deviations, by probe.
std::string residualPlot(const MeasuredData& data);

}  // namespace palpate::app
