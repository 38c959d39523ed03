// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "report/drawing.h"

namespace palpate::app {

/// Points that belong together.
struct Series {
  enum class Style {
    Marks,
    Line,    ///< joined, without marks
    Joined,  ///< marks, and a line through them
    Dashed,  ///< a line that stands for no points
    Rings,   ///< around marks of other series
  };
  std::string name, colour;
  std::vector<double> x, y;  ///< above 0 on logarithmic axes
  Style style = Style::Marks;
  std::vector<bool> isHollow = {};      ///< marks that are; empty: none
  std::vector<std::string> notes = {};  ///< beside the marks; empty: none
  double radius = 5;                    ///< of the marks
};

/// A plot with its legend on the right.
struct Plot {
  enum class Axes {
    Logarithmic,
    Linear,
    Equal,  ///< linear, both over one range
    Named,  ///< linear upwards; along x names stand at 1, 2 ...
  };
  std::string title, xLabel, yLabel;
  std::vector<Series> series;
  double width = 720, height = 390, legendWidth = 220;
  Axes axes = Axes::Logarithmic;
  std::vector<std::string> names = {};
};

/// @param left, top  of the plot's place.
void addPlot(Drawing& drawing, const Plot& plot, double left, double top);

/// One plot as inline SVG.
std::string inlineSvg(const Plot& plot);

}  // namespace palpate::app
