// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>

#include "commands.h"
#include "report/stiffness_study.h"
#include "terminal.h"
#include "whole_file.h"

namespace palpate::app {
namespace {

void printStudy(const StiffnessStudy& study) {
  printRow("mask radius", number(study.radius));
  printRow("smoothing length", number(study.smoothingLength));
  for (const MeshStudy& mesh : study.meshes) {
    const auto both = [&](const char* measure) {
      return number(fieldComponent(mesh.bare, measure, 1), 3) + "  " +
             number(fieldComponent(mesh.masked, measure, 1), 3);
    };
    printRow("mesh", mesh.name + ", " + std::to_string(mesh.bare->GetNumberOfPoints()) +
                         " vertices (single, masked)");
    printRow("  correlation with area", both("ArtifactAreaCorrelation"));
    printRow("  variation", both("ArtifactVariation"));
    printRow("  largest jump", both("ArtifactLargestJump"));
  }
  for (const PointSample& point : study.points)
    printRow("|K| at the point, " + point.name, number(point.single) + "  " + number(point.masked));
  if (!study.hasLaw) return;
  printRow("exponent of 1/h", number(study.law.exponent, 3));
  printRow("R^2 of b + c/h", number(study.law.fit, 4));
}

void writeText(const std::string& path, const std::string& text) {
  writeWholeFile(path, [&](std::ostream& file) { file << text; });
}

void addOptions(CLI::App& command, StudyOptions& o, std::string& report) {
  command
      .add_option("inputs", o.inputs,
                  "Models of one object from `palpate precompute`, or one surface with support and "
                  "material and --levels")
      ->required();
  requireWritable(
      command.add_option("--report", report, "The page, .html; its tables go beside it as .csv"),
      "reports", ".html");
  command.add_option("--levels", o.levels, "Loop levels of the surface, 1 as it is")
      ->check(CLI::Range(1, 9));
  command
      .add_option("--table-levels", o.tableLevels,
                  "Further levels at the point alone (table 1): fewer Green's functions")
      ->check(CLI::Range(1, 9));
  command
      .add_option("--edge-lengths", o.edgeLengths,
                  "Also remesh the finest level to edges of these lengths")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--at", o.point,
                  "The point of the tables and pulls; by default where the support is farthest")
      ->expected(3);
  command
      .add_option("--smoothing", o.smoothingLength,
                  "Smoothing length; by default a tenth of the coarsest mesh's diagonal")
      ->check(CLI::PositiveNumber);
  command.add_option("--precision", o.precision, "double, mixed or float, of models made here")
      ->check(CLI::IsMember({"double", "mixed", "float"}))
      ->capture_default_str();
  o.mask.addTo(command);
}

}  // namespace

void addArtifacts(CLI::App& program) {
  struct Options {
    StudyOptions study;
    std::string report;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "artifacts", "Where the mesh, and not the material, makes a surface feel soft");
  addOptions(*command, options->study, options->report);
  command->footer(
      "The mask is the same for all meshes: by default its radius is a mean edge of the coarsest,\n"
      "two of a single mesh; --radius-edges counts in edges of the coarsest.\n"
      "  palpate artifacts data/kidney.vtp --levels 2 3 4 --report kidney.html\n"
      "  palpate artifacts scan.vtp decimated.vtp --radius 0.01 --report scans.html");
  command->callback([options] {
    const StiffnessStudy study = studyStiffness(options->study);
    if (!options->report.empty()) {
      const std::string page = studyPage(study, options->study);
      writeText(std::filesystem::path(options->report).replace_extension(".csv").string(),
                studyCsv(study));
      writeText(options->report, page);
    }
    printStudy(study);
  });
}

}  // namespace palpate::app
