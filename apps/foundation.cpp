// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkElasticFoundation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr double kFarthest = 0.1;  // that a spring may be from its vertex, of the model's diagonal

struct Options {
  std::string input, output;
  double stiffness = 0, shear = -1;
  std::vector<double> springs;  // four each: place and stiffness
  std::vector<double> probes;   // three each
};

/// Adds springs at the vertices nearest to their places to those that the surface has.
void addSprings(vtkPolyData* surface, const std::vector<double>& springs) {
  if (springs.empty()) return;
  if (springs.size() % 4 != 0)
    throw std::invalid_argument("--spring takes three coordinates and a stiffness a spring");
  const char* const name = "SpringStiffness";
  if (surface->GetPointData()->HasArray(name))
    throw std::invalid_argument(
        "the model has springs of its own, in the array SpringStiffness: leave --spring out");
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(surface->GetNumberOfPoints());
  array->FillValue(0);
  for (std::size_t i = 0; i < springs.size(); i += 4) {
    const vtkIdType vertex = surface->FindPoint(const_cast<double*>(&springs[i]));
    if (vertex < 0)
      throw std::invalid_argument("--spring has no place: its coordinates are not finite");
    const double* at = surface->GetPoint(vertex);
    const double away =
        std::hypot(at[0] - springs[i], at[1] - springs[i + 1], at[2] - springs[i + 2]);
    if (!(away <= kFarthest * surface->GetLength()))
      throw std::invalid_argument("the --spring at " + vectorText(&springs[i]) + " is " +
                                  number(away, 3) + " m from the nearest vertex, of a model of " +
                                  number(surface->GetLength(), 3) +
                                  " m: are its coordinates in metres?");
    printRow("spring at vertex", std::to_string(vertex));
    array->SetValue(vertex, array->GetValue(vertex) + springs[i + 3]);
  }
  surface->GetPointData()->AddArray(array);
}

}  // namespace

void addFoundation(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "foundation", "Put a model on springs: an elastic foundation in place of its support");
  command
      ->add_option("input", options->input,
                   "A model from `palpate precompute`; where a support is to give way, made with "
                   "--support-columns")
      ->required();
  requireWritable(
      command->add_option("output", options->output, "The model on springs, .vtp")->required(),
      "models", ".vtp");
  command->add_option("--stiffness", options->stiffness,
                      "Of the foundation under fixed vertices, along the normal, Pa/m");
  command->add_option("--shear", options->shear, "Along the surface, Pa/m; by default the same");
  command
      ->add_option("--spring", options->springs,
                   "Springs to ground at the nearest vertex, the same in all directions, N/m")
      ->type_name("X Y Z K ...");
  command
      ->add_option("--probe", options->probes,
                   "Places inside whose displacement and stress are to be known; those that the "
                   "model was precomputed with stay known without")
      ->type_name("X Y Z ...");
  command->footer(
      "  palpate precompute kidney.vtp model.vtp --support-columns\n"
      "  palpate foundation model.vtp soft.vtp --stiffness 2e6 --shear 5e5");
  command->callback([options, command] {
    if (command->count("--stiffness") > 0 && !(options->stiffness > 0))
      throw std::invalid_argument("--stiffness must be above 0 Pa/m: leave it out for none");
    if (command->count("--shear") > 0 && !(options->shear >= 0))
      throw std::invalid_argument("--shear must be at least 0 Pa/m");
    if (command->count("--shear") > 0 && command->count("--stiffness") == 0)
      throw std::invalid_argument("--shear goes with --stiffness: give that, too");
    if (options->probes.size() % 3 != 0)
      throw std::invalid_argument("--probe takes three coordinates a place");
    const auto surface = readSurface(options->input);
    addSprings(surface, options->springs);
    vtkNew<vtkElasticFoundation> filter;
    filter->SetInputData(surface);
    filter->SetNormalStiffness(options->stiffness);
    filter->SetShearStiffness(options->shear);
    for (std::size_t i = 0; i < options->probes.size(); i += 3)
      filter->AddProbe(options->probes[i], options->probes[i + 1], options->probes[i + 2]);
    const auto model = run(filter);
    writeSurface(model, options->output);
    for (const std::string& source : fieldStrings(model, "GreensFunctionSource"))
      printRow("made by", source);
    printRow("reciprocity defect", number(fieldNumber(model, "ReciprocityDefect", -1), 3));
    const double rocking = fieldNumber(model, "RockingCompliance", -1);
    if (rocking >= 0) printRow("rocking compliance, rad/(N m)", number(rocking, 3));
    printWarnings(model);
  });
}

}  // namespace palpate::app
