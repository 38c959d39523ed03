// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkNew.h>
#include <vtkOriginalSurface.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "terminal.h"

namespace palpate::app {

void addOriginal(CLI::App& program) {
  struct Options {
    std::string input, output;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "original", "Results of a remeshed surface on the one that it was remeshed from");
  command
      ->add_option("input", options->input,
                   "What any command left of a model from `palpate precompute --edge-length` or "
                   "of a surface from `palpate remesh --keep-original`")
      ->required();
  requireWritable(
      command->add_option("output", options->output, "The original with the results, .vtp")
          ->required(),
      "models", ".vtp");
  command->footer(
      "  palpate precompute scan.vtp coarse.vtp --method fem --edge-length 0.01\n"
      "  palpate stiffness coarse.vtp stiffness.vtp --radius 0.02\n"
      "  palpate original stiffness.vtp shown.vtp");
  command->callback([options] {
    vtkNew<vtkOriginalSurface> filter;
    filter->SetInputData(readSurface(options->input));
    const auto surface = run(filter);
    writeSurface(surface, options->output);
    printRow("vertices", std::to_string(surface->GetNumberOfPoints()));
    printRow("triangles", std::to_string(surface->GetNumberOfCells()));
  });
}

}  // namespace palpate::app
