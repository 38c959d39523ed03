// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSurfaceStiffness.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "commands.h"
#include "picture/picture.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output;
  MaskOptions mask;
  PictureOptions picture;
  bool rotational = false;
};

/// What the stiffness field holds at free vertices.
struct Field {
  explicit Field(vtkPolyData* surface) {
    vtkDataArray* norm = surface->GetPointData()->GetArray("StiffnessNorm");
    vtkDataArray* types = surface->GetPointData()->GetArray("BoundaryType");
    vtkDataArray* isLimited = surface->GetPointData()->GetArray("StiffnessLimited");
    vtkDataArray* held = surface->GetPointData()->GetArray("MaskSupportShare");
    vtkDataArray* beyond = surface->GetPointData()->GetArray("MaskBeyondShare");
    for (vtkIdType i = 0; i < norm->GetNumberOfTuples(); ++i) {
      if (types->GetComponent(i, 0) != 0) continue;
      const double value = norm->GetComponent(i, 0);
      if (std::isnan(value))
        ++missing;
      else
        norms.push_back(value);
      limited += isLimited->GetComponent(i, 0) != 0;
      cutAtSupport += held->GetComponent(i, 0) > kCut;
      cutElsewhere += beyond->GetComponent(i, 0) > kCut;
    }
  }
  std::vector<double> norms;
  int missing = 0, limited = 0;  ///< vertices without stiffness, and with that of the mask's mean
  int cutAtSupport = 0;          ///< masks a good part of which would have been on the support,
  int cutElsewhere = 0;          ///< or on other components or the far side of a wall
  static constexpr double kCut = 0.01;
};

/// The value that a fraction of the values is below.
double quantile(std::vector<double> values, double fraction) {
  const auto at = values.begin() + std::lround(fraction * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The middle nine tenths, and at least within 30 % of the median, so that even fields with and
/// without masks show their unevenness alike.
std::array<double, 2> commonRange(const std::vector<double>& values) {
  if (values.empty()) return {0, 1};
  const double median = quantile(values, 0.5);
  return {std::min(quantile(values, 0.05), 0.7 * median),
          std::max(quantile(values, 0.95), 1.3 * median)};
}

void printSpread(const Field& field) {
  const std::vector<double>& values = field.norms;
  double mean = 0, square = 0;
  for (double v : values) mean += v / values.size();
  for (double v : values) square += (v - mean) * (v - mean) / values.size();
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  printRow("free vertices", std::to_string(values.size() + field.missing));
  if (field.missing > 0) printRow("of these without stiffness", std::to_string(field.missing));
  if (field.limited > 0) printRow("limited by their mask's mean", std::to_string(field.limited));
  if (field.cutAtSupport > 0)
    printRow("masks cut off at the support", std::to_string(field.cutAtSupport));
  if (field.cutElsewhere > 0)
    printRow("masks cut off at gaps and walls", std::to_string(field.cutElsewhere));
  printRow("|K| smallest, N/m", number(*low));
  printRow("|K| mean, N/m", number(mean));
  printRow("|K| largest, N/m", number(*high));
  printRow("coefficient of variation", number(std::sqrt(square) / mean, 3));
}

void drawStiffness(vtkPolyData* surface, const Field& field, const PictureOptions& options,
                   const MaskOptions& mask) {
  Picture picture;
  picture.width = 800;
  picture.towardsViewer = options.towardsViewer(surface);
  const bool masked = mask.radius > 0 || mask.radiusEdges > 0;
  View view{surface,
            masked ? "stiffness under a " + mask.mask + " mask" : "single-vertex stiffness",
            "StiffnessNorm",
            "norm of K\n(N/m)",
            false,
            {}};
  if (options.range.empty()) {
    const auto [low, high] = commonRange(field.norms);
    view.range = {low, high};
    view.logarithmic = high > 10 * low;
  } else {
    view.range = {options.range[0], options.range[1]};
  }
  picture.views = {view};
  drawPicture(picture, options.path);
}

}  // namespace

void addStiffness(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "stiffness", "The stiffness that a point-like contact feels everywhere");
  command->add_option("input", options->input, "A model from `palpate precompute`")->required();
  requireWritable(
      command->add_option("output", options->output, "The model with its stiffness fields, .vtp"),
      "models", ".vtp");
  options->mask.addTo(*command);
  command->add_flag("--rotational", options->rotational,
                    "Write the stiffness against torques, too (RotationalStiffness, N m/rad)");
  options->picture.addTo(*command, "the norm of the stiffness");
  command->footer(
      "Without a mask the field shows the mesh as much as the material.\n"
      "  palpate stiffness model.vtp field.vtp --radius-edges 2 --image field.png");
  command->callback([options] {
    options->picture.requireSensible();
    vtkNew<vtkSurfaceStiffness> filter;
    filter->SetInputData(readSurface(options->input));
    options->mask.applyTo(filter);
    filter->SetRigidStiffness(options->mask.rigidStiffness);
    filter->SetMeasure(options->mask.measureNumber());
    filter->SetRotational(options->rotational);
    const auto surface = run(filter);
    const Field field(surface);
    if (!options->output.empty()) writeSurface(surface, options->output);
    if (!options->picture.path.empty())
      drawStiffness(surface, field, options->picture, options->mask);
    printSpread(field);
  });
}

}  // namespace palpate::app
