// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/plot.h"

#include <algorithm>
#include <cmath>

#include "terminal.h"

namespace palpate::app {
namespace {

constexpr const char *kInk = "#22222a", *kGrid = "#e2e2e8";
constexpr double kMark = 5, kRing = 8;
constexpr double kManyDecades = 3;  ///< beyond, ticks are powers of ten alone

/// A logarithmic axis between two places of the drawing.
struct Axis {
  double low, high, from, to;
  double at(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
  /// 1, 2 and 5 times powers of ten; fewer where there would be too many.
  std::vector<double> ticks() const {
    const double decades = std::log10(high / low);
    const int step = static_cast<int>(std::ceil(decades / 9));
    std::vector<double> values;
    for (int power = static_cast<int>(std::floor(std::log10(low)));
         power <= std::ceil(std::log10(high)); ++power)
      for (double digit : {1., 2., 5.}) {
        if (decades > kManyDecades && (digit > 1 || power % step != 0)) continue;
        if (const double value = digit * std::pow(10, power); value >= low && value <= high)
          values.push_back(value);
      }
    return values;
  }
};

/// What a logarithm has a place for.
bool isShown(double value) {
  return value > 0 && std::isfinite(value);
}

/// Over what is shown.
Axis axisOf(const std::vector<Series>& all, bool isX, double from, double to) {
  double low = 1e300, high = 0;
  for (const Series& series : all)
    for (double value : isX ? series.x : series.y) {
      if (!isShown(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(high > 0)) low = high = 1;
  const double margin = std::max(1.2, std::pow(high / low, 0.05));
  return {low / margin, high * margin, from, to};
}

void addAxes(Drawing& drawing, const Axis& x, const Axis& y, const LogarithmicPlot& plot) {
  using Anchor = Drawing::Anchor;
  for (double value : x.ticks()) {
    drawing.lines.push_back({{{x.at(value), y.from}, {x.at(value), y.to}}, kGrid});
    drawing.labels.push_back({x.at(value), y.from + 20, number(value), Anchor::Middle});
  }
  for (double value : y.ticks()) {
    drawing.lines.push_back({{{x.from, y.at(value)}, {x.to, y.at(value)}}, kGrid});
    drawing.labels.push_back({x.from - 8, y.at(value) + 4, number(value), Anchor::End});
  }
  drawing.lines.push_back(
      {{{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}, {x.from, y.from}}, kInk});
  const double middle = (x.from + x.to) / 2;
  drawing.labels.push_back({middle, y.from + 44, plot.xLabel, Anchor::Middle});
  drawing.labels.push_back(
      {x.from - 64, (y.from + y.to) / 2, plot.yLabel, Anchor::Middle, 13, true});
  if (!plot.title.empty())
    drawing.labels.push_back({middle, y.to - 12, plot.title, Anchor::Middle, 15});
}

Drawing::Mark markOf(const Series& series, std::size_t i, double x, double y) {
  if (series.style == Series::Style::Rings) return {x, y, kRing, series.colour, true};
  return {x, y, kMark, series.colour, !series.isHollow.empty() && series.isHollow[i]};
}

bool hasLine(const Series& series) {
  return series.style == Series::Style::Line || series.style == Series::Style::Joined ||
         series.style == Series::Style::Dashed;
}

bool hasMarks(const Series& series) {
  return series.style != Series::Style::Line && series.style != Series::Style::Dashed;
}

void addSeries(Drawing& drawing, const Series& series, const Axis& x, const Axis& y) {
  const bool isDashed = series.style == Series::Style::Dashed;
  Drawing::Line line{{}, series.colour, 1.5, isDashed};
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!isShown(series.x[i]) || !isShown(series.y[i])) continue;
    const double px = x.at(series.x[i]), py = y.at(series.y[i]);
    line.points.push_back({px, py});
    if (hasMarks(series)) drawing.marks.push_back(markOf(series, i, px, py));
    if (series.notes.empty()) continue;
    const bool isAtEdge = px > x.to - 50;
    drawing.labels.push_back({px + (isAtEdge ? -9 : 9), py - 7, series.notes[i],
                              isAtEdge ? Drawing::Anchor::End : Drawing::Anchor::Start, 11});
  }
  if (hasLine(series)) drawing.lines.push_back(line);
}

}  // namespace

void addPlot(Drawing& drawing, const LogarithmicPlot& plot, double left, double top) {
  const Axis x = axisOf(plot.series, true, left + 84, left + plot.width - plot.legendWidth);
  const Axis y = axisOf(plot.series, false, top + plot.height - 60, top + 34);
  addAxes(drawing, x, y, plot);
  double row = y.to + 10;
  for (const Series& series : plot.series) {
    addSeries(drawing, series, x, y);
    if (series.name.empty()) continue;
    if (hasLine(series))
      drawing.lines.push_back({{{x.to + 12, row}, {x.to + 32, row}},
                               series.colour,
                               1.5,
                               series.style == Series::Style::Dashed});
    if (hasMarks(series)) {
      drawing.marks.push_back(markOf(series, 0, x.to + 22, row));
      if (!series.isHollow.empty()) drawing.marks.back().isHollow = false;
    }
    drawing.labels.push_back({x.to + 40, row + 4, series.name});
    row += 22;
  }
}

std::string inlineSvg(const LogarithmicPlot& plot) {
  Drawing drawing;
  drawing.width = plot.width;
  drawing.height = plot.height;
  addPlot(drawing, plot, 0, 0);
  return svgOf(drawing, plot.yLabel + " over " + plot.xLabel, false);
}

}  // namespace palpate::app
