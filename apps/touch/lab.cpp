// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <model_arrays.h>
#include <read_files.h>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <set>
#include <stdexcept>

#include "haptics/pressing_hand.h"
#include "haptics/stability_lab.h"
#include "haptics/touch_session.h"
#include "mesh/surface_point.h"
#include "picture/colour_map.h"
#include "picture/png.h"
#include "picture/virtual_display.h"
#include "progress_bar.h"
#include "touch/touch_window.h"

namespace palpate::app {
namespace {

constexpr double kUneven = 0.1;  ///< of the stiffness, from which on its variation is told

/// A curve of the plot: what depends on the rate alone.
struct Series {
  double damping;
  int delay;
  std::vector<ZWidthPoint> points;
};

std::vector<Series> seriesOf(const std::vector<ZWidthPoint>& points) {
  std::vector<Series> all;
  for (const ZWidthPoint& point : points) {
    auto same = std::find_if(all.begin(), all.end(), [&](const Series& series) {
      return series.damping == point.damping && series.delay == point.delay;
    });
    if (same == all.end()) same = all.insert(all.end(), {point.damping, point.delay, {}});
    same->points.push_back(point);
  }
  return all;
}

std::string label(const Series& series) {
  char text[64];
  std::snprintf(text, sizeof text, "b = %g N s/m, delay %d", series.damping, series.delay);
  return text;
}

/// Rate, largest stable stiffness, bound: columns of a series, as logarithms are drawn from.
vtkSmartPointer<vtkTable> tableOf(const Series& series) {
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> rate, stable, bound;
  rate->SetName("rate");
  stable->SetName(label(series).c_str());
  bound->SetName((label(series) + ", bound").c_str());
  for (const ZWidthPoint& point : series.points) {
    const bool isShown = point.largestStable > 0 && std::isfinite(point.largestStable);
    rate->InsertNextValue(point.rate);
    stable->InsertNextValue(isShown ? point.largestStable : std::nan(""));  // NaN is left out
    bound->InsertNextValue(point.passive);
  }
  table->AddColumn(rate);
  table->AddColumn(stable);
  table->AddColumn(bound);
  return table;
}

/// Labels at the rates that were tried, on a logarithmic axis.
void labelRates(vtkAxis* axis, const std::vector<ZWidthPoint>& points) {
  std::set<double> rates;
  for (const ZWidthPoint& point : points) rates.insert(point.rate);
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> labels;
  for (double rate : rates) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", rate);
    places->InsertNextValue(std::log10(rate));
    labels->InsertNextValue(text);
  }
  axis->SetCustomTickPositions(places, labels);
}

/// The model's own stiffness |K|, between two rates.
void drawLevel(vtkChartXY* chart, double own, double first, double last) {
  vtkNew<vtkTable> level;
  vtkNew<vtkDoubleArray> ends, stiffness;
  ends->SetName("rate");
  stiffness->SetName("the model's own");
  for (double rate : {first, last}) {
    ends->InsertNextValue(rate);
    stiffness->InsertNextValue(own);
  }
  level->AddColumn(ends);
  level->AddColumn(stiffness);
  vtkPlot* line = chart->AddPlot(vtkChart::LINE);
  line->SetInputData(level, 0, 1);
  line->SetColor(0.8, 0.1, 0.1);
  line->GetPen()->SetLineType(vtkPen::DASH_LINE);
}

void draw(const std::vector<ZWidthPoint>& points, double own, const std::string& path) {
  const VirtualDisplay display;
  vtkNew<vtkContextView> view;
  view->GetRenderer()->SetBackground(1, 1, 1);
  view->GetRenderWindow()->SetOffScreenRendering(1);
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(1000, 700);
  vtkNew<vtkChartXY> chart;
  view->GetScene()->AddItem(chart);
  chart->SetTitle(
      "largest stable stiffness |K| (marks) and the Colgate bound b > |K|T/2 + |K|Td (lines)");
  chart->SetShowLegend(true);
  chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::LEFT);
  chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  const std::vector<Series> all = seriesOf(points);
  double lowest = own, highest = own, first = points[0].rate, last = first;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const vtkSmartPointer<vtkTable> table = tableOf(all[i]);
    const std::size_t shade = all.size() > 1 ? 7 * i / (all.size() - 1) : 0;
    const double* colour = kViridis[shade];
    vtkPlot* marks = chart->AddPlot(vtkChart::POINTS);
    marks->SetInputData(table, 0, 1);
    vtkPlotPoints::SafeDownCast(marks)->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    vtkPlotPoints::SafeDownCast(marks)->SetMarkerSize(10);
    vtkPlot* line = chart->AddPlot(vtkChart::LINE);
    line->SetInputData(table, 0, 2);
    line->SetWidth(1.5F);
    line->SetLegendVisibility(false);
    for (vtkPlot* plot : {marks, line}) plot->SetColor(colour[0], colour[1], colour[2]);
    for (const ZWidthPoint& point : all[i].points) {
      for (const double k : {point.passive, point.largestStable}) {
        if (!(k > 0) || !std::isfinite(k)) continue;  // nothing stable, or everything
        lowest = std::min(lowest, k);
        highest = std::max(highest, k);
      }
      first = std::min(first, point.rate);
      last = std::max(last, point.rate);
    }
  }
  drawLevel(chart, own, first, last);
  const std::pair<int, const char*> axes[] = {{vtkAxis::BOTTOM, "rate of the servo loop, Hz"},
                                              {vtkAxis::LEFT, "stiffness |K|, N/m"}};
  for (const auto& [axis, title] : axes) {
    chart->GetAxis(axis)->SetTitle(title);
    chart->GetAxis(axis)->LogScaleOn();
    chart->GetAxis(axis)->SetBehavior(vtkAxis::FIXED);
  }
  chart->GetAxis(vtkAxis::BOTTOM)->SetUnscaledRange(first / 1.1, last * 1.1);
  labelRates(chart->GetAxis(vtkAxis::BOTTOM), points);
  chart->GetAxis(vtkAxis::LEFT)->SetUnscaledRange(lowest / 1.5, highest * 6);
  view->GetRenderWindow()->Render();
  writePng(view->GetRenderWindow(), path);
}

}  // namespace

void runLab(const TouchOptions& options) {
  if (options.model.empty())
    throw std::invalid_argument("the lab presses one model: give its file instead of a scene");
  const auto surface = readSurface(options.model);
  warnOfUnits(surface);
  const convert::ServedModel served = convert::servedModelOf(surface);
  const SceneBody body{served.greens, served.mesh};
  Scene scene;
  scene.models.emplace_back();
  scene.tools.emplace_back();
  scene.devices.emplace_back();
  scene.effects.deformation = DeformationRows::None;
  scene.effects.friction = 1;  // so that the press stays where it is
  if (!options.maskShape.empty()) scene.effects.maskShape = maskShapeFromName(options.maskShape);
  scene.effects.maskRadius = std::max(0.0, options.maskRadius);
  scene.effects.maskRadiusEdges = options.maskRadius >= 0 ? 0 : 2;
  scene.effects.stiffnessLimit = std::max(0.0, options.stiffnessLimit);
  const TouchSession session(scene, {body});

  LabSettings settings;
  const Eigen::Vector3d wanted =
      options.at.empty() ? Eigen::Vector3d(body.mesh->points().col(farthestFreeVertex(body)))
                         : Eigen::Vector3d(options.at.data());
  const SurfacePoint point = nearestSurfacePoint(*body.mesh, wanted);
  settings.place = placeOf(*body.mesh, point);
  settings.direction = -body.mesh->triangleNormals().col(point.triangle);
  settings.depth = options.depth > 0 ? options.depth : body.mesh->diagonal() / 100;
  if (settings.depth > body.mesh->diagonal())
    throw std::invalid_argument("--depth is more than the model's length: are both in metres?");
  const StabilityLab lab(*session.model(), settings);
  if (lab.variation() > kUneven)
    std::cerr << "palpate: warning: the stiffness varies by " << std::lround(100 * lab.variation())
              << " % along the tool's way, where it slips over faces of another stiffness: what is "
                 "stable may be far below the bound; `palpate refine` makes the mesh finer\n";
  const auto orElse = [](const auto& given, auto standard) {
    return given.empty() ? decltype(given)(standard) : given;
  };
  const std::vector<double> rates =
      orElse(options.rates, std::vector<double>{250, 500, 1000, 2000, 4000});
  const std::vector<double> dampings = orElse(options.dampings, std::vector<double>{0.1, 0.5, 2});
  const std::vector<int> delays = orElse(options.delays, std::vector<int>{0, 1});
  const Progress progress([&](double fraction, const char* stage) {
    requireUninterrupted(options);
    return drawProgress(fraction, stage);
  });
  const std::vector<ZWidthPoint> points =
      zWidth(*session.model(), settings, rates, dampings, delays, progress);
  endProgressBar();

  std::printf("pressed at %.6g %.6g %.6g, %.4g deep: |K| %.4g N/m, along the press %.4g N/m\n",
              settings.place.x(), settings.place.y(), settings.place.z(), settings.depth,
              lab.stiffness(), lab.pressStiffness());
  std::printf("%10s %12s %8s %16s %16s\n", "rate, Hz", "b, N s/m", "delay", "stable |K|, N/m",
              "bound, N/m");
  for (const ZWidthPoint& p : points)
    std::printf("%10g %12g %8d %16.5g %16.5g\n", p.rate, p.damping, p.delay, p.largestStable,
                p.passive);
  std::fflush(stdout);
  if (!options.image.empty()) draw(points, lab.stiffness(), options.image);
}

}  // namespace palpate::app
