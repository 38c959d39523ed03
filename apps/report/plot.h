// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "report/drawing.h"

namespace palpate::app {

/// Points of a law over sizes, on logarithmic axes.
struct Series {
  enum class Style {
    Marks,
    Line,    ///< joined, without marks
    Joined,  ///< marks, and a line through them
    Dashed,  ///< a line that stands for no points
    Rings,   ///< around marks of other series
  };
  std::string name, colour;
  std::vector<double> x, y;  ///< above 0
  Style style = Style::Marks;
  std::vector<bool> isHollow = {};      ///< marks that are; empty: none
  std::vector<std::string> notes = {};  ///< beside the marks; empty: none
};

/// A plot with its legend on the right.
struct LogarithmicPlot {
  std::string title, xLabel, yLabel;
  std::vector<Series> series;
  double width = 720, height = 390, legendWidth = 220;
};

/// @param left, top  of the plot's place.
void addPlot(Drawing& drawing, const LogarithmicPlot& plot, double left, double top);

/// One plot as inline SVG.
std::string inlineSvg(const LogarithmicPlot& plot);

}  // namespace palpate::app
