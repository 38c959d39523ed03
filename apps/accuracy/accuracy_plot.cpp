// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <cmath>

#include "accuracy/accuracy_study.h"
#include "report/plot.h"

namespace palpate::app {
namespace {

constexpr double kPlotWidth = 700, kPlotHeight = 470, kLegendWidth = 230;
constexpr const char *kInk = "#22222a", *kUncertain = "#a0a0aa";
/// Told apart by most eyes (P. Tol's bright and vibrant schemes).
const char* const kColours[] = {"#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee",
                                "#aa3377", "#ee7733", "#009988", "#332288", "#cc3311",
                                "#999933", "#bbbbbb", "#882255", "#44aa99"};

/// Whether the trials of a series follow one another, so that a line through them means something.
bool isSequence(const TrialResult& result) {
  const std::string& knob = result.trial.knob;
  return knob != "storage" && knob != "columns" && knob != "rows" && knob != "loss";
}

/// What stands beside a mark.
std::string noteOf(const AccuracyStudy& study, const TrialResult& result) {
  if (result.trial.knob == "level") return std::to_string(result.vertices);
  const bool isNamed = study.isIdentification && result.trial.knob != "interpolation" &&
                       result.trial.knob != "elements";
  return isNamed ? result.trial.value : "";
}

/// The series of one stage, each with a colour of its own.
std::vector<Series> seriesOf(const AccuracyStudy& study, bool isPrecompute) {
  std::vector<Series> all;
  for (const TrialResult& result : study.results) {
    const std::string& name = result.trial.series;
    if (result.trial.isPrecompute != isPrecompute || !(result.error > 0)) continue;
    auto found =
        std::find_if(all.begin(), all.end(), [&](const Series& s) { return s.name == name; });
    if (found == all.end()) {
      const std::size_t shift = isPrecompute ? 0 : 6;  // knobs of two plots are not one
      const char* colour = kColours[(all.size() + shift) % (sizeof kColours / sizeof *kColours)];
      found = all.insert(all.end(), {name, colour, {}, {}});
      found->style = isSequence(result) ? Series::Style::Joined : Series::Style::Marks;
    }
    const double time = result.time().median;
    const bool isKnown = std::count(found->x.begin(), found->x.end(), time) > 0;
    if (isKnown) continue;  // the base belongs to several knobs
    found->x.push_back(time);
    found->y.push_back(100 * result.error);
    found->isHollow.push_back(result.isBelowCertainty());
    found->notes.push_back(noteOf(study, result));
  }
  return all;
}

/// What is said of the whole plot: the front, and what the reference is certain of.
void addMarks(std::vector<Series>& all, const AccuracyStudy& study, bool isPrecompute) {
  Series front{"not beaten in both (Pareto)", kInk, {}, {}, Series::Style::Rings};
  double least = 1e300, most = 0;
  for (const TrialResult& result : study.results) {
    if (result.trial.isPrecompute != isPrecompute || !(result.error > 0)) continue;
    least = std::min(least, result.time().median);
    most = std::max(most, result.time().median);
    if (!result.isOnFront) continue;
    front.x.push_back(result.time().median);
    front.y.push_back(100 * result.error);
  }
  if (!front.x.empty()) all.push_back(front);
  if (study.uncertainty > 0 && most > 0)
    all.push_back({"the reference's uncertainty",
                   kUncertain,
                   {least, most},
                   {100 * study.uncertainty, 100 * study.uncertainty},
                   Series::Style::Dashed});
}

std::string titleOf(const AccuracyStudy& study, bool isPrecompute) {
  return study.isIdentification ? "identification" : isPrecompute ? "precomputation" : "one query";
}

std::string timeOf(const AccuracyStudy& study, bool isPrecompute) {
  return study.isIdentification ? "seconds to identify"
         : isPrecompute         ? "seconds to precompute"
                                : "seconds a query";
}

Drawing drawingOf(const AccuracyStudy& study) {
  Drawing drawing;
  drawing.height = kPlotHeight;
  for (bool isPrecompute : {true, false}) {
    Plot plot{titleOf(study, isPrecompute),
              timeOf(study, isPrecompute) + (study.clock == "cpu" ? " (processor)" : ""),
              "error (%)",
              seriesOf(study, isPrecompute),
              kPlotWidth,
              kPlotHeight,
              kLegendWidth};
    if (plot.series.empty()) continue;
    addMarks(plot.series, study, isPrecompute);
    addPlot(drawing, plot, drawing.width, 0);
    drawing.width += kPlotWidth;
  }
  drawing.width = std::max(drawing.width, kPlotWidth);
  return drawing;
}

std::string descriptionOf(const AccuracyStudy& study) {
  return study.body + " by " + study.method + ": error against time, against " + study.reference;
}

}  // namespace

std::string accuracySvg(const AccuracyStudy& study, bool isFile) {
  return svgOf(drawingOf(study), descriptionOf(study), isFile);
}

void drawAccuracy(const AccuracyStudy& study, const std::string& path) {
  drawDrawing(drawingOf(study), path);
}

}  // namespace palpate::app
