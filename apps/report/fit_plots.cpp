// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/fit_plots.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/page_parts.h"
#include "report/plot.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr std::size_t kMost = 6000;  ///< marks of a plot
constexpr double kNormal = 1.96;     ///< standard deviations that hold 95 %
constexpr double kMark = 2.5, kOutlier = 4;
constexpr const char *kComponents[] = {"#4477aa", "#228833", "#ccbb44"}, *kWrong = "#cc3311",
                     *kGuide = "#55555e";
constexpr const char* kNames[] = {"along x", "along y", "along z"};

/// A component that was measured.
struct Component {
  int axis, probe;
  double measured, predicted, deviations;  ///< m, m, residual over its standard deviation
  bool isOutlier;
};

std::vector<Component> componentsOf(const MeasuredData& data) {
  std::vector<Component> all;
  for (const Reading& reading : data.readings)
    for (int axis = 0; axis < 3; ++axis) {
      const double measured = reading.measured[axis], residual = reading.residual[axis];
      if (std::isnan(measured) || std::isnan(residual)) continue;
      all.push_back({axis, reading.probe, measured, measured - residual,
                     reading.deviation[axis] > 0 ? residual / reading.deviation[axis] : 0,
                     reading.isOutlier});
    }
  return all;
}

/// Whether a mark is among those of a plot that has room for kMost.
bool isDrawn(std::size_t index, std::size_t count) {
  const std::size_t step = count / kMost + 1;
  return index % step == 0;
}

std::string shareText(std::size_t count) {
  const std::size_t step = count / kMost + 1;
  return step == 1 ? "" : " One in " + std::to_string(step) + " of the components is shown.";
}

Series marks(const std::string& name, const char* colour, double radius) {
  Series series{name, colour, {}, {}};
  series.radius = radius;
  return series;
}

/// Components as marks: a series an axis, and one of outliers, all of which are drawn, if there are
/// any.
/// @param placeOf  (x, y) of a component; called for each in turn.
/// @param all      empty before.
/// @return whether there are outliers.
template <class Place>
bool addMarks(const std::vector<Component>& components, const Place& placeOf,
              std::vector<Series>& all) {
  for (int axis = 0; axis < 3; ++axis) all.push_back(marks(kNames[axis], kComponents[axis], kMark));
  Series outliers = marks("outlier, left out", kWrong, kOutlier);
  for (std::size_t i = 0; i < components.size(); ++i) {
    const Component& c = components[i];
    const std::pair<double, double> place = placeOf(c);
    if (!c.isOutlier && !isDrawn(i, components.size())) continue;
    Series& series = c.isOutlier ? outliers : all[c.axis];
    series.x.push_back(place.first);
    series.y.push_back(place.second);
    if (c.isOutlier) series.isHollow.push_back(true);
  }
  if (outliers.x.empty()) return false;
  all.push_back(outliers);
  return true;
}

}  // namespace

std::string predictionPlot(const MeasuredData& data) {
  const std::vector<Component> components = componentsOf(data);
  double most = 0;
  for (const Component& c : components)
    most = std::max({most, std::abs(c.measured), std::abs(c.predicted)});
  const LengthUnit unit = unitFor(most);
  Plot plot;
  addMarks(
      components,
      [&](const Component& c) {
        return std::pair(unit.perMetre * c.measured, unit.perMetre * c.predicted);
      },
      plot.series);
  double low = 0, high = 0;
  for (const Series& series : plot.series)
    for (const auto* values : {&series.x, &series.y})
      for (double value : *values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  plot.series.push_back({"as measured", kGuide, {low, high}, {low, high}, Series::Style::Dashed});
  plot.xLabel = "measured displacement (" + unit.name + ")";
  plot.yLabel = "predicted displacement (" + unit.name + ")";
  plot.axes = Plot::Axes::Equal;
  plot.width = 700;
  plot.height = 540;
  plot.legendWidth = 170;
  return figure(inlineSvg(plot),
                "Displacements' components that the model predicts over those measured; an outlier "
                "is left out with all of its three." +
                    shareText(components.size()));
}

std::string residualPlot(const MeasuredData& data) {
  const std::vector<Component> components = componentsOf(data);
  double most = 4;
  std::vector<std::size_t> counts(std::max<std::size_t>(data.probes.size(), 1), 0), seen = counts;
  for (const Component& c : components) {
    if (!c.isOutlier) most = std::max(most, std::abs(c.deviations));
    ++counts[c.probe];
  }
  const double rim = 1.15 * most;
  Plot plot;
  const bool hasOutliers = addMarks(
      components,
      [&](const Component& c) {
        const double along = double(++seen[c.probe]) / (double(counts[c.probe]) + 1) - 0.5;
        return std::pair(c.probe + 1 + 0.8 * along, std::clamp(c.deviations, -rim, rim));
      },
      plot.series);
  const double last = double(counts.size()) + 0.5;
  for (double level : {kNormal, -kNormal})
    plot.series.push_back({level > 0 ? "95 % of noise" : "",
                           kGuide,
                           {0.5, last},
                           {level, level},
                           Series::Style::Dashed});
  for (const ProbeReading& probe : data.probes) plot.names.push_back(probe.name);
  if (plot.names.empty()) plot.names.push_back("all");
  plot.xLabel = data.probes.empty() ? "" : "probe";
  plot.yLabel = "residual (standard deviations)";
  plot.axes = Plot::Axes::Named;
  plot.width = 1000;
  plot.height = 400;
  plot.legendWidth = 170;
  const std::string beyond =
      hasOutliers ? " Outliers beyond " + number(rim, 2) + " stand at the rim." : "";
  return figure(inlineSvg(plot),
                "Residuals of components, measured less predicted, over their standard "
                "deviation, marker after marker." +
                    beyond + shareText(components.size()));
}

}  // namespace palpate::app
