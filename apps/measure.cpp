// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <measurement_arrays.h>
#include <read_files.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRigSimulation.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "commands.h"
#include "file_kinds.h"
#include "finite_check.h"
#include "identification/measurement_file.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output;
  int probes = 5, markers = 50, seed = 1;
  double radius = 0, force = 0, tilt = 45, noise = 0.01, outliers = 0, missing = 0, yield = 0;
  bool withDeviations = false;
  double placeNoise = 0;
  std::vector<double> rotation{0, 0, 0}, translation{0, 0, 0};
};

void addOptions(CLI::App& command, Options& o) {
  command
      .add_option("input", o.input,
                  "A model, the body on the rig: of another mesh or method than what will be "
                  "identified")
      ->required();
  CLI::Option* output =
      command.add_option("output", o.output, "The table of measurements, .csv or .vtp")->required();
  requireWritable(output, "measurements", "");
  output->check(CLI::Validator(
      [](const std::string& name) -> std::string {
        const std::string ending = endingOf(name);
        return ending == ".csv" || ending == ".vtp"
                   ? ""
                   : "measurements are written as .csv or .vtp: choose a name that ends so, not " +
                         name;
      },
      ""));
  command.add_option("--probes", o.probes, "How many press")->capture_default_str();
  command.add_option("--markers", o.markers, "How many are seen under each")->capture_default_str();
  command.add_option("--radius", o.radius, "Of a probe's tip, m; by default two mean edges")
      ->check(isFinite());
  command
      .add_option("--force", o.force,
                  "N; by default so that the largest displacement is 1 % of the diagonal")
      ->check(isFinite());
  command.add_option("--tilt", o.tilt, "Largest angle of forces from the normal, degrees")
      ->check(isFinite())
      ->capture_default_str();
  command.add_option("--noise", o.noise, "Standard deviation, over the largest displacement")
      ->check(isFinite())
      ->capture_default_str();
  command.add_flag("--with-deviations", o.withDeviations, "The table tells it");
  command
      .add_option("--place-noise", o.placeNoise,
                  "Standard deviation of places as the table tells them, m")
      ->check(isFinite())
      ->capture_default_str();
  command.add_option("--outliers", o.outliers, "Share of displacements that are wrong")
      ->check(isFinite())
      ->capture_default_str();
  command.add_option("--missing", o.missing, "Share of displacements that are not seen")
      ->check(isFinite())
      ->capture_default_str();
  command.add_option("--rotation", o.rotation, "Of the rig's frame, a vector of degrees")
      ->expected(3)
      ->check(isFinite());
  command.add_option("--translation", o.translation, "Of the rig's frame, m")
      ->expected(3)
      ->check(isFinite());
  command
      .add_option("--yield-length", o.yield,
                  "Young's modulus over the stiffness per area of the support, m; 0: firm")
      ->check(isFinite());
  command.add_option("--seed", o.seed, "Of all that is random")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command.footer(
      "  palpate precompute kidney_fine.vtp body.vtp --method fem --young 8e3 --poisson 0.4\n"
      "  palpate measure body.vtp rig.csv --probes 5 --markers 50 --noise 0.01\n"
      "  palpate identify kidney.vtp model.vtp --measurements rig.csv");
}

void set(vtkRigSimulation* rig, const Options& o) {
  rig->SetNumberOfProbes(o.probes);
  rig->SetNumberOfMarkers(o.markers);
  rig->SetRadius(o.radius);
  rig->SetForce(o.force);
  rig->SetTilt(o.tilt);
  rig->SetNoise(o.noise);
  rig->SetWithDeviations(o.withDeviations);
  rig->SetPlaceNoise(o.placeNoise);
  rig->SetOutliers(o.outliers);
  rig->SetMissing(o.missing);
  rig->SetRotation(o.rotation.data());
  rig->SetTranslation(o.translation.data());
  rig->SetSupportYieldLength(o.yield);
  rig->SetSeed(o.seed);
}

/// @throws std::invalid_argument where the measurements would take the place of the model.
void requireAnotherFile(const Options& o) {
  std::error_code unknown;  // as there is no such output yet
  if (std::filesystem::equivalent(o.input, o.output, unknown))
    throw std::invalid_argument(o.output +
                                " is the model itself, which the measurements would replace: "
                                "choose another name for them");
}

}  // namespace

void addMeasure(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "measure", "Make the displacements that a rig would measure on a model");
  addOptions(*command, *options);
  command->callback([options] {
    requireAnotherFile(*options);
    vtkNew<vtkRigSimulation> rig;
    set(rig, *options);
    rig->SetInputData(readSurface(options->input));
    const auto table = run(rig);
    const Measurements measurements = convert::measurementsOf(table);
    if (endingOf(options->output) == ".vtp")
      writeSurface(table, options->output);
    else
      writeMeasurementFile(options->output, measurements);
    printRow("probes", std::to_string(measurements.probes.size()));
    printRow("displacements", std::to_string(measurements.displacements.size()));
    printRow("force, N", number(measurements.probes.front().force.norm()));
  });
}

}  // namespace palpate::app
