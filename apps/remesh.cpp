// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkIsotropicRemeshing.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "terminal.h"

namespace palpate::app {

void addRemesh(CLI::App& program) {
  struct Options {
    std::string input, output;
    double edgeLength = 0, smoothAngle = 30;
    int iterations = 3;
    bool keepOriginal = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("remesh", "Another mesh of a surface, with edges of about one length");
  command->add_option("input", options->input, "A closed triangle surface")->required();
  requireWritable(
      command->add_option("output", options->output, "The other mesh, .vtp")->required(), "models",
      ".vtp");
  command
      ->add_option("--edge-length", options->edgeLength,
                   "Wanted length; by default the surface's mean edge")
      ->check(CLI::PositiveNumber);
  command->add_option("--iterations", options->iterations, "How often the mesh is worked over")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option(
          "--smooth-angle", options->smoothAngle,
          "Edges sharper than this are kept, degrees, unless the surface has a SmoothPatch")
      ->check(CLI::Range(0., 180.))
      ->capture_default_str();
  command->add_flag("--keep-original", options->keepOriginal,
                    "Keep the input's mesh, and how it lies on the other, for `palpate original`");
  command->footer(
      "The rims of the support and of smooth patches keep their place.\n"
      "  palpate remesh scan.vtp even.vtp --edge-length 0.004");
  command->callback([options] {
    vtkNew<vtkIsotropicRemeshing> filter;
    filter->SetInputData(readSurface(options->input));
    filter->SetEdgeLength(options->edgeLength);
    filter->SetNumberOfIterations(options->iterations);
    filter->SetSmoothAngle(options->smoothAngle);
    filter->SetKeepOriginal(options->keepOriginal);
    const auto surface = run(filter);
    writeSurface(surface, options->output);
    printRow("vertices", std::to_string(surface->GetNumberOfPoints()));
    printRow("triangles", std::to_string(surface->GetNumberOfCells()));
  });
}

}  // namespace palpate::app
