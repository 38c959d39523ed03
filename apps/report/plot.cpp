// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/plot.h"

#include <algorithm>
#include <cmath>

#include "terminal.h"

namespace palpate::app {
namespace {

constexpr const char *kInk = "#22222a", *kGrid = "#e2e2e8";
constexpr double kRing = 8, kLegendMark = 4;
constexpr double kManyDecades = 3;  ///< beyond, ticks are powers of ten alone
constexpr double kNote = 11, kNoteLetter = 6.5;
constexpr double kLetter = 8;  ///< width of a label's letter, pixels

/// An axis between two places of the drawing.
struct Axis {
  double low, high, from, to;
  bool isLogarithmic;
  double at(double value) const {
    const double share =
        isLogarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return from + (to - from) * share;
  }
  std::vector<double> ticks() const {
    const std::vector<double> decimal = isLogarithmic ? decimalTicks() : std::vector<double>();
    return decimal.size() < 2 ? evenTicks() : decimal;  // within less than a decade
  }
  /// What it has a place for.
  bool shows(double value) const { return std::isfinite(value) && (!isLogarithmic || value > 0); }

 private:
  /// 1, 2 and 5 times powers of ten; fewer where there would be too many.
  std::vector<double> decimalTicks() const {
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
  /// Some six, a round number apart.
  std::vector<double> evenTicks() const {
    const double wished = (high - low) / 6, power = std::pow(10, std::floor(std::log10(wished)));
    const double digit = wished / power;
    const double step = power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
    std::vector<double> values;
    for (double count = std::ceil(low / step); count * step <= high; ++count)
      values.push_back(count == 0 ? 0 : count * step);
    return values;
  }
};

/// Over what is shown.
Axis axisOver(const std::vector<const std::vector<double>*>& all, bool isLogarithmic, double from,
              double to) {
  Axis axis{1e300, -1e300, from, to, isLogarithmic};
  for (const std::vector<double>* values : all)
    for (double value : *values) {
      if (!axis.shows(value)) continue;
      axis.low = std::min(axis.low, value);
      axis.high = std::max(axis.high, value);
    }
  if (axis.high < axis.low) axis.low = axis.high = 1;
  if (isLogarithmic) {
    const double margin = std::max(1.2, std::pow(axis.high / axis.low, 0.05));
    axis.low /= margin;
    axis.high *= margin;
    return axis;
  }
  const double span = axis.high - axis.low,
               margin = span > 0 ? 0.05 * span : std::max(std::abs(axis.low), 1e-12);
  axis.low -= margin;
  axis.high += margin;
  return axis;
}

std::vector<const std::vector<double>*> valuesOf(const Plot& plot, bool isX) {
  std::vector<const std::vector<double>*> all;
  for (const Series& series : plot.series) {
    const bool hasEqualAxes = plot.axes == Plot::Axes::Equal;
    if (isX || hasEqualAxes) all.push_back(&series.x);
    if (!isX || hasEqualAxes) all.push_back(&series.y);
  }
  return all;
}

Axis xAxisOf(const Plot& plot, double from, double to) {
  if (plot.axes == Plot::Axes::Named)
    return {0.5, static_cast<double>(plot.names.size()) + 0.5, from, to, false};
  return axisOver(valuesOf(plot, true), plot.axes == Plot::Axes::Logarithmic, from, to);
}

Axis yAxisOf(const Plot& plot, double from, double to) {
  return axisOver(valuesOf(plot, false), plot.axes == Plot::Axes::Logarithmic, from, to);
}

/// Names at their numbers; some are left out where all would not fit.
void addNames(Drawing& drawing, const Axis& x, double y, const std::vector<std::string>& names) {
  std::size_t longest = 1;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  const double each = std::abs(x.to - x.from) / static_cast<double>(names.size());
  const auto step = static_cast<std::size_t>(
      std::ceil((kLetter * static_cast<double>(longest) + kLetter) / each));
  for (std::size_t i = 0; i < names.size(); i += step)
    drawing.labels.push_back(
        {x.at(static_cast<double>(i) + 1), y + 20, names[i], Drawing::Anchor::Middle});
}

void addAxes(Drawing& drawing, const Axis& x, const Axis& y, const Plot& plot) {
  using Anchor = Drawing::Anchor;
  const bool isNamed = plot.axes == Plot::Axes::Named;
  if (isNamed) addNames(drawing, x, y.from, plot.names);
  for (double value : isNamed ? std::vector<double>() : x.ticks()) {
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
  return {x, y, series.radius, series.colour, !series.isHollow.empty() && series.isHollow[i]};
}

bool hasLine(const Series& series) {
  return series.style == Series::Style::Line || series.style == Series::Style::Joined ||
         series.style == Series::Style::Dashed;
}

bool hasMarks(const Series& series) {
  return series.style != Series::Style::Line && series.style != Series::Style::Dashed;
}

/// Whether a note covers no other.
bool hasRoom(const Drawing& drawing, const Drawing::Label& note) {
  const auto middleOf = [](const Drawing::Label& label) {
    const double half = 0.5 * kNoteLetter * static_cast<double>(label.text.size());
    return label.x + (label.anchor == Drawing::Anchor::End ? -half : half);
  };
  return std::none_of(drawing.labels.begin(), drawing.labels.end(), [&](const auto& other) {
    const double letters = static_cast<double>(note.text.size() + other.text.size());
    return other.size == kNote && std::abs(other.y - note.y) < kNote &&
           std::abs(middleOf(other) - middleOf(note)) < 0.5 * kNoteLetter * letters;
  });
}

bool isAllHollow(const Series& series) {
  return std::all_of(series.isHollow.begin(), series.isHollow.end(), [](bool is) { return is; });
}

void addSeries(Drawing& drawing, const Series& series, const Axis& x, const Axis& y) {
  const bool isDashed = series.style == Series::Style::Dashed;
  Drawing::Line line{{}, series.colour, 1.5, isDashed};
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!x.shows(series.x[i]) || !y.shows(series.y[i])) continue;
    const double px = x.at(series.x[i]), py = y.at(series.y[i]);
    line.points.push_back({px, py});
    if (hasMarks(series)) drawing.marks.push_back(markOf(series, i, px, py));
    if (series.notes.empty()) continue;
    const bool isAtEdge = px > x.to - 50;
    const Drawing::Label note{px + (isAtEdge ? -9 : 9), py - 7, series.notes[i],
                              isAtEdge ? Drawing::Anchor::End : Drawing::Anchor::Start, kNote};
    if (hasRoom(drawing, note)) drawing.labels.push_back(note);
  }
  if (hasLine(series)) drawing.lines.push_back(line);
}

}  // namespace

void addPlot(Drawing& drawing, const Plot& plot, double left, double top) {
  const Axis x = xAxisOf(plot, left + 84, left + plot.width - plot.legendWidth);
  const Axis y = yAxisOf(plot, top + plot.height - 60, top + 34);
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
      drawing.marks.back().radius = std::max(drawing.marks.back().radius, kLegendMark);
      drawing.marks.back().isHollow = drawing.marks.back().isHollow && isAllHollow(series);
    }
    drawing.labels.push_back({x.to + 40, row + 4, series.name});
    row += 22;
  }
}

std::string inlineSvg(const Plot& plot) {
  Drawing drawing;
  drawing.width = plot.width;
  drawing.height = plot.height;
  addPlot(drawing, plot, 0, 0);
  return svgOf(drawing, plot.yLabel + " over " + plot.xLabel, false);
}

}  // namespace palpate::app
