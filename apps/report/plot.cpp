// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <sstream>

#include "report/html.h"
#include "terminal.h"

namespace palpate::app::html {
namespace {

constexpr double kLeft = 84, kRight = 500, kTop = 20, kBottom = 330, kWidth = 720, kHeight = 390;

/// A logarithmic axis between two places of the drawing.
struct Axis {
  double low, high, from, to;
  double at(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
  /// 1, 2 and 5 times powers of ten.
  std::vector<double> ticks() const {
    std::vector<double> values;
    for (int power = std::floor(std::log10(low)); power <= std::ceil(std::log10(high)); ++power)
      for (double digit : {1., 2., 5.})
        if (const double value = digit * std::pow(10, power); value >= low && value <= high)
          values.push_back(value);
    return values;
  }
};

Axis axisOf(const std::vector<Series>& all, bool isX, double from, double to) {
  double low = 1e300, high = 0;
  for (const Series& series : all)
    for (double value : isX ? series.x : series.y) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return {low / 1.2, high * 1.2, from, to};
}

void drawAxes(std::ostream& out, const Axis& x, const Axis& y, const std::string& xLabel,
              const std::string& yLabel) {
  for (double value : x.ticks())
    out << "<line class=\"grid\" x1=\"" << x.at(value) << "\" x2=\"" << x.at(value) << "\" y1=\""
        << kTop << "\" y2=\"" << kBottom << "\"/><text x=\"" << x.at(value) << "\" y=\""
        << kBottom + 20 << "\" text-anchor=\"middle\">" << number(value) << "</text>\n";
  for (double value : y.ticks())
    out << "<line class=\"grid\" x1=\"" << kLeft << "\" x2=\"" << kRight << "\" y1=\""
        << y.at(value) << "\" y2=\"" << y.at(value) << "\"/><text x=\"" << kLeft - 8 << "\" y=\""
        << y.at(value) + 4 << "\" text-anchor=\"end\">" << number(value) << "</text>\n";
  out << "<rect x=\"" << kLeft << "\" y=\"" << kTop << "\" width=\"" << kRight - kLeft
      << "\" height=\"" << kBottom - kTop << "\" fill=\"none\" stroke=\"#22222a\"/>\n"
      << "<text x=\"" << (kLeft + kRight) / 2 << "\" y=\"" << kBottom + 46
      << "\" text-anchor=\"middle\">" << escaped(xLabel) << "</text>\n"
      << "<text transform=\"translate(18 " << (kTop + kBottom) / 2
      << ") rotate(-90)\" text-anchor=\"middle\">" << escaped(yLabel) << "</text>\n";
}

void drawSeries(std::ostream& out, const Series& series, const Axis& x, const Axis& y) {
  if (series.isLine) {
    out << "<polyline fill=\"none\" stroke-width=\"1.5\" stroke=\"" << series.colour
        << "\" points=\"";
    for (std::size_t i = 0; i < series.x.size(); ++i)
      out << x.at(series.x[i]) << "," << y.at(series.y[i]) << " ";
    out << "\"/>\n";
    return;
  }
  for (std::size_t i = 0; i < series.x.size(); ++i)
    out << "<circle r=\"5\" fill=\"" << series.colour << "\" cx=\"" << x.at(series.x[i])
        << "\" cy=\"" << y.at(series.y[i]) << "\"/>\n";
}

}  // namespace

std::string logarithmicPlot(const std::vector<Series>& all, const std::string& xLabel,
                            const std::string& yLabel) {
  const Axis x = axisOf(all, true, kLeft, kRight), y = axisOf(all, false, kBottom, kTop);
  std::ostringstream out;
  out << "<svg viewBox=\"0 0 " << kWidth << " " << kHeight << "\" width=\"" << kWidth
      << "\" role=\"img\" aria-label=\"" << escaped(yLabel) << " over " << escaped(xLabel)
      << "\">\n<style>svg text { font: 13px system-ui, sans-serif; fill: #22222a; } "
         ".grid { stroke: #e2e2e8; }</style>\n";
  drawAxes(out, x, y, xLabel, yLabel);
  double row = kTop + 10;
  for (const Series& series : all) {
    drawSeries(out, series, x, y);
    if (series.isLine)
      out << "<line x1=\"512\" x2=\"528\" y1=\"" << row << "\" y2=\"" << row
          << "\" stroke-width=\"1.5\" stroke=\"" << series.colour << "\"/>";
    else
      out << "<circle r=\"5\" cx=\"520\" cy=\"" << row << "\" fill=\"" << series.colour << "\"/>";
    out << "<text x=\"536\" y=\"" << row + 4 << "\">" << escaped(series.name) << "</text>\n";
    row += 24;
  }
  out << "</svg>\n";
  return out.str();
}

}  // namespace palpate::app::html
