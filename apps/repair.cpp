// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkElasticMeshRepair.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.h"
#include "terminal.h"

namespace palpate::app {

void addRepair(CLI::App& program) {
  struct Options {
    std::string input, output;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("repair", "Mend a surface so that it bounds elastic bodies");
  command->add_option("input", options->input, "A .vtp, .stl, .obj, .ply or .off file")->required();
  requireWritable(
      command->add_option("output", options->output, "The mended surface, .vtp")->required(),
      "models", ".vtp");
  command->footer(
      "Welds duplicate vertices, drops bad triangles, fills holes, removes self-intersections and\n"
      "turns triangles outwards. Each kind of change is printed; nothing is said of a sound "
      "surface.\n"
      "  palpate repair scan.stl scan.vtp");
  command->callback([options] {
    vtkNew<vtkElasticMeshRepair> filter;
    filter->SetInputData(readSurface(options->input));
    const auto mended = run(filter);
    writeSurface(mended, options->output);
    for (const std::string& change : fieldStrings(mended, "RepairChanges"))
      std::cout << change << "\n";
  });
}

}  // namespace palpate::app
