// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSurfaceRefinement.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "subdivision_option.h"
#include "terminal.h"

namespace palpate::app {

void addRefine(CLI::App& program) {
  struct Options {
    std::string input, output, subdivision = "loop";
    int levels = 1, layers = 0;
    double limitShare = 0;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("refine", "Subdivide a surface");
  command->add_option("input", options->input, "A closed triangle surface")->required();
  requireWritable(
      command->add_option("output", options->output, "The finer surface, .vtp")->required(),
      "models", ".vtp");
  command->add_option("--levels", options->levels, "How often every triangle is split in four")
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  addSubdivision(*command, options->subdivision);
  command
      ->add_option("--limit-share", options->limitShare,
                   "How far vertices are moved to the smooth surface that Loop's subdivision tends "
                   "to; with 0.5 the mesh encloses as much")
      ->check(CLI::Range(0., 1.))
      ->capture_default_str();
  command
      ->add_option("--support-layers", options->layers,
                   "Layers of triangles along the rim of the support, each a quarter as wide")
      ->check(CLI::Range(0, 9))
      ->capture_default_str();
  command->footer(
      "A new vertex is fixed if both ends of its edge are.\n"
      "  palpate refine data/kidney.vtp kidney.vtp --levels 2");
  command->callback([options] {
    vtkNew<vtkSurfaceRefinement> filter;
    filter->SetInputData(readSurface(options->input));
    filter->SetNumberOfLevels(options->levels);
    filter->SetSupportLayers(options->layers);
    filter->SetLimitShare(options->limitShare);
    filter->SetSubdivision(static_cast<int>(subdivisionNamed(options->subdivision)));
    const auto fine = run(filter);
    writeSurface(fine, options->output);
    printRow("vertices", std::to_string(fine->GetNumberOfPoints()));
    printRow("triangles", std::to_string(fine->GetNumberOfCells()));
  });
}

}  // namespace palpate::app
