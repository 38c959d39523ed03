// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkBodyForce.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "picture/picture.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output;
  std::vector<double> acceleration = {0, 0, -9.81};
  double density = 0;
  PictureOptions picture;
};

/// The longest displacement and where it is.
void printSag(vtkPolyData* hung) {
  vtkDataArray* displacement = hung->GetPointData()->GetArray("Displacement");
  vtkIdType most = 0;
  double longest = -1;
  for (vtkIdType i = 0; i < displacement->GetNumberOfTuples(); ++i) {
    const double* u = displacement->GetTuple(i);
    const double square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    if (square > longest) {
      longest = square;
      most = i;
    }
  }
  printRow("sags most at", vectorText(hung->GetPoint(most)));
  printRow("by", vectorText(displacement->GetTuple(most)));
}

void drawSag(vtkPolyData* hung, const PictureOptions& options) {
  Picture picture;
  picture.towardsViewer = options.towardsViewer(hung);
  View before{hung, "without weight (support in blue)", "", "", false, {}};
  View after{hung, "under its weight", "Displacement", "displacement\n(m)", true, {}};
  if (options.range.size() == 2) after.range = {options.range[0], options.range[1]};
  picture.views = {before, after};
  drawPicture(picture, options.path);
}

}  // namespace

void addGravity(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "gravity", "How a model hangs under its weight, or deforms as it is accelerated");
  command->add_option("input", options->input, "A model from `palpate precompute`")->required();
  requireWritable(
      command->add_option("output", options->output, "The model with displacements, .vtp"),
      "models", ".vtp");
  command->add_option("--density", options->density,
                      "In the mean, kg/m^3; by default that of the volume mesh's cells");
  command
      ->add_option("--acceleration", options->acceleration,
                   "Of gravity, m/s^2; a body that is accelerated itself feels the opposite")
      ->expected(3)
      ->capture_default_str();
  options->picture.addTo(*command, "the surface without and under its weight");
  command->footer("  palpate gravity model.vtp hung.vtp --density 1050 --image hung.png");
  command->callback([options, command] {
    options->picture.requireSensible();
    if (command->count("--density") > 0 && !(options->density > 0))
      throw std::invalid_argument("--density must be a positive number of kg/m^3");
    vtkNew<vtkBodyForce> filter;
    filter->SetInputData(readSurface(options->input));
    filter->SetAcceleration(options->acceleration.data());
    filter->SetDensity(options->density);
    const auto hung = run(filter);
    if (!options->output.empty()) writeSurface(hung, options->output);
    if (!options->picture.path.empty()) drawSag(hung, options->picture);
    printSag(hung);
    printValidity(hung, "the body is too soft or too heavy for it");
  });
}

}  // namespace palpate::app
